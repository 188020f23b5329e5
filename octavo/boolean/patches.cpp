// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include <octavo/boolean/about_edge.hpp>
#include <octavo/boolean/patches.hpp>
#include <octavo/exact/plane.hpp>
#include <octavo/mesh/disjoint_sets.hpp>

namespace octavo::boolean {
namespace {

/// For each point, the corners at it, as 4 · triangle + k.
struct CornerTable {
    std::vector<std::uint32_t> begin, corners;
};

CornerTable corners_by_point(const Complex& complex, std::size_t points) {
    CornerTable table;
    table.begin.assign(points + 1, 0);
    for (std::uint32_t triangle = 0; triangle < complex.size(); ++triangle)
        if (complex.exists(triangle))
            for (const PointId point : complex.corners(triangle)) ++table.begin[point + 1];
    for (std::size_t point = 0; point < points; ++point) table.begin[point + 1] += table.begin[point];
    table.corners.resize(table.begin[points]);
    for (std::uint32_t triangle = 0; triangle < complex.size(); ++triangle) {
        if (!complex.exists(triangle)) continue;
        const mesh::Triangle& corners = complex.corners(triangle);
        for (std::uint32_t k = 0; k < 3; ++k) table.corners[table.begin[corners[k]]++] = 4 * triangle + k;
    }
    for (std::size_t point = points; point > 0; --point) table.begin[point] = table.begin[point - 1];
    table.begin[0] = 0;
    return table;
}

/// A triangle at a vertex, as its opposite edge; or one of its sides at the vertex.
struct Spoke {
    PointId other;
    std::uint32_t triangle;
    bool leaves;  ///< the triangle runs from the vertex to `other`
};

class PatchSearch {
  public:
    PatchSearch(const Complex& complex, const PointTable& points)
        : complex_(complex), points_(points), sets_(complex.size()) {}

    Result<Patches> run(const Context& context) {
        const CornerTable table = corners_by_point(complex_, points_.size());
        patches_.is_plain.assign(points_.size(), 0);
        for (PointId point = 0; point < points_.size(); ++point) {
            const std::uint32_t begin = table.begin[point], end = table.begin[point + 1];
            if (begin == end) continue;
            patches_.is_plain[point] = join_fan({table.corners.data() + begin, end - begin});
        }
        if (context.cancelled()) return Context::cancelled_error();
        for (PointId point = 0; point < points_.size(); ++point) {
            const std::uint32_t begin = table.begin[point], end = table.begin[point + 1];
            if (begin != end && !patches_.is_plain[point])
                visit_edges(point, {table.corners.data() + begin, end - begin});
        }
        if (!open_.empty()) return open_error();
        number_patches();
        for (Junction& junction : patches_.junctions) sort_around(junction);
        return std::move(patches_);
    }

  private:
    /// Whether the corners form one closed fan of equal triangles; joins them if so.
    bool join_fan(std::span<const std::uint32_t> corners) {
        const std::size_t count = corners.size();
        if (count < 3) return false;
        fan_.resize(count);
        for (std::size_t i = 0; i < count; ++i) {
            const mesh::Triangle& t = complex_.corners(corners[i] / 4);
            const std::uint32_t k = corners[i] % 4;
            fan_[i] = {t[(k + 1) % 3], t[(k + 2) % 3]};
        }
        const TransitionId transition = complex_.transition(corners[0] / 4);
        for (const std::uint32_t corner : corners)
            if (complex_.transition(corner / 4) != transition) return false;
        if (!is_single_cycle()) return false;
        for (const std::uint32_t corner : corners) sets_.unite(corners[0] / 4, corner / 4);
        return true;
    }

    bool is_single_cycle() {
        const std::size_t count = fan_.size();
        if (count > 32) {
            // Sorted by start, a fan is a permutation that each search follows in logarithmic time.
            std::sort(fan_.begin(), fan_.end());
            std::size_t at = 0;
            for (std::size_t step = 1; step <= count; ++step) {
                const auto next = std::lower_bound(fan_.begin(), fan_.end(),
                                                   std::pair<PointId, PointId>{fan_[at].second, 0});
                if (next == fan_.end() || next->first != fan_[at].second) return false;
                if (next + 1 != fan_.end() && (next + 1)->first == next->first) return false;
                at = static_cast<std::size_t>(next - fan_.begin());
                if (at == 0) return step == count;
            }
            return false;
        }
        std::size_t at = 0;
        for (std::size_t step = 1; step <= count; ++step) {
            std::size_t next = count;
            for (std::size_t i = 0; i < count; ++i) {
                if (fan_[i].first != fan_[at].second) continue;
                if (next != count) return false;
                next = i;
            }
            if (next == count) return false;
            at = next;
            if (at == 0) return step == count;
        }
        return false;
    }

    /// Joins across or records the edges from `point` to higher points that are not plain either; fans have
    /// joined all others.
    void visit_edges(PointId point, std::span<const std::uint32_t> corners) {
        spokes_.clear();
        for (const std::uint32_t corner : corners) {
            const mesh::Triangle& t = complex_.corners(corner / 4);
            const std::uint32_t k = corner % 4;
            const PointId next = t[(k + 1) % 3], last = t[(k + 2) % 3];
            if (next > point && !patches_.is_plain[next]) spokes_.push_back({next, corner / 4, true});
            if (last > point && !patches_.is_plain[last]) spokes_.push_back({last, corner / 4, false});
        }
        std::sort(spokes_.begin(), spokes_.end(), [](const Spoke& a, const Spoke& b) {
            return a.other != b.other ? a.other < b.other : a.triangle < b.triangle;
        });
        for (std::size_t i = 0, end; i < spokes_.size(); i = end) {
            for (end = i + 1; end < spokes_.size() && spokes_[end].other == spokes_[i].other;) ++end;
            visit_edge(point, {spokes_.data() + i, end - i});
        }
    }

    void visit_edge(PointId low, std::span<const Spoke> sides) {
        if (sides.size() == 2 && sides[0].leaves != sides[1].leaves &&
            complex_.transition(sides[0].triangle) == complex_.transition(sides[1].triangle)) {
            sets_.unite(sides[0].triangle, sides[1].triangle);
            return;
        }
        sum_.clear();
        for (const Spoke& side : sides)
            sum_.add(complex_.transitions.of(complex_.transition(side.triangle)), side.leaves ? 1 : -1);
        if (!sum_.normalised().empty()) {
            for (const Spoke& side : sides) open_.push_back(complex_.facet(side.triangle));
            return;
        }
        Junction junction{low, sides[0].other, static_cast<std::uint32_t>(patches_.around.size()), 0};
        for (const Spoke& side : sides) patches_.around.push_back(2 * side.triangle + (side.leaves ? 1 : 0));
        junction.end = static_cast<std::uint32_t>(patches_.around.size());
        patches_.junctions.push_back(junction);
    }

    Error open_error() {
        std::sort(open_.begin(), open_.end());
        open_.erase(std::unique(open_.begin(), open_.end()), open_.end());
        const mesh::Source first = complex_.soup->source(open_[0]);
        Error error{ErrorCode::not_a_solid, "", {}};
        std::size_t in_operand = 0;
        for (const std::uint32_t facet : open_) {
            const mesh::Source source = complex_.soup->source(facet);
            if (source.operand != first.operand) continue;
            ++in_operand;
            if (error.place.faces.size() < 8) error.place.faces.push_back(source.face);
        }
        error.sentence = "operand " + std::to_string(first.operand) +
                         " is not closed or not consistently oriented: at " + std::to_string(in_operand) +
                         " of its facets an edge has no partner that runs the other way";
        return error;
    }

    void number_patches() {
        patches_.of_triangle.assign(complex_.size(), no_index);
        for (std::uint32_t triangle = 0; triangle < complex_.size(); ++triangle) {
            if (!complex_.exists(triangle)) continue;
            const std::uint32_t root = sets_.find(triangle);
            patches_.of_triangle[triangle] = root == triangle ? patches_.count++ : patches_.of_triangle[root];
        }
    }

    exact::Plane plane_of(std::uint32_t triangle) const {
        const Soup& soup = *complex_.soup;
        const mesh::Triangle& corner = soup.facets[complex_.facet(triangle)];
        return exact::Plane::through(soup.points[corner[0]], soup.points[corner[1]], soup.points[corner[2]]);
    }

    /// Sorts the triangles about the edge and equates the regions between neighbours.
    void sort_around(const Junction& junction) {
        turned_.clear();
        for (std::uint32_t at = junction.begin; at < junction.end; ++at) {
            const std::uint32_t entry = patches_.around[at];
            turned_.push_back(turned(plane_of(entry / 2), entry % 2 != 0, entry));
        }
        sort_about_edge(points_, junction.low, junction.high, turned_);
        for (std::size_t k = 0; k < turned_.size(); ++k)
            patches_.around[junction.begin + k] = turned_[k].entry;
        for (std::size_t k = 0; k < turned_.size(); ++k) {
            const std::uint32_t entry = turned_[k].entry, next = turned_[(k + 1) % turned_.size()].entry;
            // A triangle that runs upward has its front after it, one that runs downward its back.
            const PatchSide after = 2 * patches_.of_triangle[entry / 2] + (entry % 2 ? 0 : 1);
            const PatchSide before = 2 * patches_.of_triangle[next / 2] + (next % 2 ? 1 : 0);
            patches_.same_region.push_back({after, before});
        }
    }

    const Complex& complex_;
    const PointTable& points_;
    mesh::DisjointSets sets_;
    Patches patches_;
    TransitionSum sum_;
    std::vector<std::pair<PointId, PointId>> fan_;
    std::vector<Spoke> spokes_;
    std::vector<AboutEdge> turned_;
    std::vector<std::uint32_t> open_;
};

}  // namespace

Result<Patches> find_patches(const Complex& complex, const PointTable& points, const Context& context) {
    return PatchSearch(complex, points).run(context);
}

}  // namespace octavo::boolean
