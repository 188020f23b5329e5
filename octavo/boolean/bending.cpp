// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/bending.hpp>
#include <octavo/boolean/coincident_facets.hpp>
#include <octavo/boolean/flush_sheet.hpp>
#include <octavo/boolean/overlay.hpp>
#include <octavo/boolean/point_index.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/mesh/disjoint_sets.hpp>

namespace octavo::boolean {

using exact::Point;

double distance(Point a, Point b) {
    return length(
        Vec3{static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y), static_cast<double>(b.z - a.z)});
}

namespace {

/// Facets that are gone, for the report.
void note_removed(const Soup& soup, std::uint32_t facet, FlushReport& report) {
    ++report.removed_facets;
    if (report.first_removed.size() < 8) report.first_removed.push_back(soup.source(facet));
}

/// Points that were added, by place.
class NearIndex {
  public:
    explicit NearIndex(double tolerance) : tolerance_(tolerance) {}

    /// One that is not farther away than the tolerance; no_index when there is none.
    std::uint32_t find(Point point, std::span<const Point> points) const {
        for (int i = 0; i < 27; ++i) {
            Cell cell = cell_of(point);
            cell[0] += i % 3 - 1, cell[1] += i / 3 % 3 - 1, cell[2] += i / 9 - 1;
            const auto [begin, end] = ids_.equal_range(cell);
            for (auto at = begin; at != end; ++at)
                if (distance(points[at->second], point) <= tolerance_) return at->second;
        }
        return no_index;
    }
    void add(Point point, std::uint32_t id) { ids_.emplace(cell_of(point), id); }

  private:
    using Cell = std::array<std::int64_t, 3>;
    Cell cell_of(Point point) const {
        const double side = std::max(1.0, tolerance_);
        return {std::llrint(std::floor(point.x / side)), std::llrint(std::floor(point.y / side)),
                std::llrint(std::floor(point.z / side))};
    }
    double tolerance_;
    std::multimap<Cell, std::uint32_t> ids_;
};

/// One round of bending edges and facets.
class Bending {
  public:
    Bending(Soup& soup, const NearContacts& near, double tolerance, const LeftAlone& left_alone,
            FlushReport& report)
        : soup_(soup), near_(near), tolerance_(tolerance), report_(report), linked_(0), sheets_(0) {
        list_edges();
        find_users();
        find_sheets();
        find_active(left_alone);
    }

    bool is_active(std::uint32_t facet) { return active_[linked_.find(facet)] != 0; }

    bool run(const Context& context) {
        list_near_vertices();
        name_crossings();
        sort_chains();
        return !context.cancelled() && subdivide(context);
    }

  private:
    /// An edge that something is near: the facets at it, and what it is bent through.
    struct Chain {
        std::vector<std::uint32_t> facets, vertices;
    };

    Chain* chain(Edge edge) {
        const auto place = std::lower_bound(edges_.begin(), edges_.end(), edge);
        return place != edges_.end() && *place == edge
                   ? &chains_[static_cast<std::size_t>(place - edges_.begin())]
                   : nullptr;
    }
    Edge edge(std::uint32_t facet, std::size_t k) const {
        return {soup_.facets[facet][k], soup_.facets[facet][(k + 1) % 3]};
    }

    void list_edges() {
        for (const NearContacts::OnEdge& on : near_.on_edge) edges_.push_back(on.edge);
        for (const NearContacts::Crossing& crossing : near_.crossings)
            edges_.push_back(crossing.first), edges_.push_back(crossing.second);
        std::sort(edges_.begin(), edges_.end());
        edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
        chains_.resize(edges_.size());
    }

    void find_users() {
        std::vector<char> has_edge(soup_.points.size(), 0);
        for (const Edge& edge : edges_) has_edge[edge.low] = 1;
        for (std::uint32_t facet = 0; facet < soup_.facets.size(); ++facet)
            for (std::size_t k = 0; k < 3; ++k) {
                const Edge side = edge(facet, k);
                if (!has_edge[side.low]) continue;
                if (Chain* const users = chain(side)) users->facets.push_back(facet);
            }
    }

    /// Facets that lie on each other are one sheet; facets that must change together are linked.
    void find_sheets() {
        linked_ = sheets_ = mesh::DisjointSets(soup_.facets.size());
        for (const Chain& users : chains_)
            for (const std::uint32_t facet : users.facets) linked_.unite(users.facets[0], facet);
        for (const NearContacts::Crossing& crossing : near_.crossings)
            linked_.unite(chain(crossing.first)->facets[0], chain(crossing.second)->facets[0]);
        for (const NearContacts::Faces& faces : near_.faces) {
            if (!lie_on_each_other(soup_, faces.first, faces.second, tolerance_)) continue;
            sheets_.unite(faces.first, faces.second);
            linked_.unite(faces.first, faces.second);
        }
    }

    /// What only touches exactly is left to the arrangement, unless something linked to it moves.
    void find_active(const LeftAlone& left_alone) {
        active_.assign(soup_.facets.size(), 0);
        const auto activate = [&](std::uint32_t facet) { active_[linked_.find(facet)] = 1; };
        for (const NearContacts::OnEdge& on : near_.on_edge)
            if (!on.exact) activate(chain(on.edge)->facets[0]);
        for (const NearContacts::Crossing& crossing : near_.crossings)
            if (!crossing.exact) activate(chain(crossing.first)->facets[0]);
        for (const NearContacts::OnFacet& on : near_.on_facet)
            if (!on.exact) activate(on.facet);
        if (left_alone.empty()) return;
        for (std::uint32_t facet = 0; facet < soup_.facets.size(); ++facet)
            if (left_alone[soup_.origin[facet]]) active_[linked_.find(facet)] = 0;
    }

    /// Crossings become vertices: one for all that are near each other, and none where a vertex is near both edges.
    void name_crossings() {
        PointIndex known;
        const auto old = soup_.points;
        NearIndex added(tolerance_);
        for (const NearContacts::Crossing& crossing : near_.crossings) {
            Chain &first = *chain(crossing.first), &second = *chain(crossing.second);
            if (!is_active(first.facets[0]) || meet_in_vertex(first, second)) continue;
            known.prepare(old);
            std::uint32_t vertex = known.find(crossing.middle, old);
            if (vertex == no_index) vertex = added.find(crossing.middle, soup_.points);
            if (vertex == no_index) {
                vertex = static_cast<std::uint32_t>(soup_.points.size());
                soup_.points.push_back(crossing.middle);
                added.add(crossing.middle, vertex);
                ++report_.added_vertices;
            }
            report_.largest_move = std::max(
                report_.largest_move, 0.5 * tolerance_ + distance(crossing.middle, soup_.points[vertex]));
            for (const Edge& edge : {crossing.first, crossing.second})
                if (vertex != edge.low && vertex != edge.high) chain(edge)->vertices.push_back(vertex);
        }
    }

    static bool meet_in_vertex(const Chain& first, const Chain& second) {
        return std::any_of(first.vertices.begin(), first.vertices.end(), [&](std::uint32_t vertex) {
            return std::find(second.vertices.begin(), second.vertices.end(), vertex) != second.vertices.end();
        });
    }

    void list_near_vertices() {
        for (const NearContacts::OnEdge& on : near_.on_edge) {
            chain(on.edge)->vertices.push_back(on.vertex);
            if (!on.exact) note_move(on.edge, on.vertex);
        }
    }

    /// Sorted from the low to the high end.
    void sort_chains() {
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            if (!is_active(chains_[i].facets[0])) {
                chains_[i].vertices.clear();
                continue;
            }
            const Point low = soup_.points[edges_[i].low], high = soup_.points[edges_[i].high];
            const auto along = [&](std::uint32_t vertex) {
                double sum = 0;
                for (int axis = 0; axis < 3; ++axis)
                    sum += static_cast<double>(high[axis] - low[axis]) *
                           (soup_.points[vertex][axis] - low[axis]);
                return sum;
            };
            std::vector<std::uint32_t>& list = chains_[i].vertices;
            std::sort(list.begin(), list.end(), [&](std::uint32_t a, std::uint32_t b) {
                const double at = along(a), other = along(b);
                return at != other ? at < other : a < b;
            });
            list.erase(std::unique(list.begin(), list.end()), list.end());
            report_.bent_edges += !list.empty();
        }
    }

    void note_move(const Edge& edge, std::uint32_t vertex) {
        const Point a = soup_.points[edge.low], b = soup_.points[edge.high], p = soup_.points[vertex];
        const double side = distance(a, b);
        const exact::Plane plane = exact::Plane::through(a, b, p);
        double square = 0;
        for (int axis = 0; axis < 3; ++axis)
            square += static_cast<double>(plane.normal(axis)) * static_cast<double>(plane.normal(axis));
        report_.largest_move = std::max(report_.largest_move, std::sqrt(square) / side);
    }

    /// The facets that change, by sheet.
    std::vector<std::vector<BentFacet>> bent_facets() {
        std::map<std::uint32_t, std::vector<BentFacet>> by_sheet;
        std::vector<std::uint32_t> changed;
        for (const Chain& users : chains_)
            if (!users.vertices.empty())
                changed.insert(changed.end(), users.facets.begin(), users.facets.end());
        for (const NearContacts::OnFacet& on : near_.on_facet)
            if (is_active(on.facet)) changed.push_back(on.facet);
        for (const NearContacts::Faces& faces : near_.faces)
            for (const std::uint32_t facet : {faces.first, faces.second})
                if (is_active(facet) && sheets_.find(faces.first) == sheets_.find(faces.second))
                    changed.push_back(facet);
        std::sort(changed.begin(), changed.end());
        changed.erase(std::unique(changed.begin(), changed.end()), changed.end());
        for (const std::uint32_t facet : changed) by_sheet[sheets_.find(facet)].push_back(bent(facet));
        std::vector<std::vector<BentFacet>> sheets;
        for (auto& [root, facets] : by_sheet) sheets.push_back(std::move(facets));
        return sheets;
    }

    BentFacet bent(std::uint32_t facet) {
        BentFacet result{facet, {}, {}};
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t from = soup_.facets[facet][k];
            result.border.push_back(from);
            const Chain* const along = chain(edge(facet, k));
            if (!along) continue;
            if (from == edge(facet, k).low)
                result.border.insert(result.border.end(), along->vertices.begin(), along->vertices.end());
            else
                result.border.insert(result.border.end(), along->vertices.rbegin(), along->vertices.rend());
        }
        const auto [first, last] = std::equal_range(
            near_.on_facet.begin(), near_.on_facet.end(), NearContacts::OnFacet{facet, 0, false},
            [](const NearContacts::OnFacet& a, const NearContacts::OnFacet& b) { return a.facet < b.facet; });
        for (auto on = first; on != last; ++on) result.inner.push_back(on->vertex);
        return result;
    }

    bool subdivide(const Context& context) {
        const std::vector<std::vector<BentFacet>> sheets = bent_facets();
        if (sheets.empty()) return false;
        const PointTable points(soup_);
        std::vector<std::vector<std::vector<mesh::Triangle>>> triangles(sheets.size());
        std::vector<std::size_t> folded(sheets.size(), 0);
        parallel_chunks(context, sheets.size(), 16, [&](std::size_t begin, std::size_t end) {
            Subdivision subdivision(points);
            for (std::size_t i = begin; i < end; ++i)
                folded[i] = subdivide_sheet(sheets[i], subdivision, triangles[i]);
        });
        std::map<std::uint32_t, std::vector<mesh::Triangle>> replaced;
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            report_.folded_facets += folded[i];
            if (sheets[i].size() > 1 && folded[i] == 0) report_.joined_facets += sheets[i].size();
            for (std::size_t k = 0; k < sheets[i].size(); ++k) {
                report_.bent_facets += !sheets[i][k].inner.empty();
                replaced[sheets[i][k].facet] = std::move(triangles[i][k]);
            }
        }
        replace_facets(std::move(replaced), soup_, report_, context);
        return true;
    }

    /// Together if possible, else one by one, else by border alone. The number of facets left to themselves.
    std::size_t subdivide_sheet(const std::vector<BentFacet>& facets, Subdivision& subdivision,
                                std::vector<std::vector<mesh::Triangle>>& triangles) const {
        const double flatness = 3 * tolerance_;
        std::vector<const BentFacet*> all;
        for (const BentFacet& facet : facets) all.push_back(&facet);
        triangles.assign(facets.size(), {});
        if (subdivide_together(all, soup_, flatness, subdivision, triangles)) return 0;
        std::size_t folded = facets.size() > 1 ? facets.size() : 0;
        for (std::size_t i = 0; i < facets.size(); ++i) {
            triangles[i].clear();
            if (subdivide_together({&all[i], 1}, soup_, flatness, subdivision, {&triangles[i], 1})) continue;
            triangles[i] = fan(facets[i]);
            if (facets.size() == 1 && !facets[i].inner.empty()) folded = 1;
        }
        return folded;
    }

    Soup& soup_;
    const NearContacts& near_;
    double tolerance_;
    FlushReport& report_;
    std::vector<Edge> edges_;  ///< sorted
    std::vector<Chain> chains_;
    mesh::DisjointSets linked_, sheets_;
    std::vector<char> active_;
};

}  // namespace

void replace_facets(std::map<std::uint32_t, std::vector<mesh::Triangle>> replaced, Soup& soup,
                    FlushReport& report, const Context& context) {
    UninitialisedVector<mesh::Triangle> facets;
    UninitialisedVector<TransitionId> transition;
    UninitialisedVector<std::uint32_t> origin;
    const auto add = [&](const mesh::Triangle& corners, std::uint32_t facet) {
        if (exact::collinear(soup.points[corners[0]], soup.points[corners[1]], soup.points[corners[2]]))
            return false;
        facets.push_back(corners);
        transition.push_back(soup.transition[facet]);
        origin.push_back(soup.origin[facet]);
        return true;
    };
    auto next = replaced.begin();
    for (std::uint32_t facet = 0; facet < soup.facets.size(); ++facet) {
        bool any = false;
        if (next != replaced.end() && next->first == facet) {
            for (const mesh::Triangle& triangle : next->second) any = add(triangle, facet) || any;
            ++next;
        } else {
            any = add(soup.facets[facet], facet);
        }
        if (!any) note_removed(soup, facet, report);
    }
    soup.facets.swap(facets), soup.transition.swap(transition), soup.origin.swap(origin);
    const std::size_t before = soup.facets.size();
    merge_coincident(soup, context);
    report.removed_facets += before - soup.facets.size();
}

bool bend(Soup& soup, const NearContacts& near, double tolerance, const LeftAlone& left_alone,
          FlushReport& report, const Context& context) {
    return Bending(soup, near, tolerance, left_alone, report).run(context);
}

std::vector<std::uint32_t> facets_to_bend(Soup& soup, const NearContacts& near, double tolerance,
                                          const LeftAlone& left_alone) {
    FlushReport not_told;
    Bending bending(soup, near, tolerance, left_alone, not_told);
    std::vector<std::uint32_t> facets;
    for (std::uint32_t facet = 0; facet < soup.facets.size(); ++facet)
        if (bending.is_active(facet)) facets.push_back(facet);
    return facets;
}

}  // namespace octavo::boolean
