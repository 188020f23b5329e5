// SPDX-License-Identifier: Apache-2.0
#include <octavo/base/parallel.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/boolean/lanes.hpp>
#include <octavo/boolean/near_facets.hpp>

namespace octavo::boolean {
namespace {

using Pair = NearFacets::Pair;

Vec3 lattice_place(const RoundedPoints& rounded, PointId id) {
    const RoundedPoints::Point at = rounded[id];
    constexpr double scale = 1.0 / static_cast<double>(std::int64_t{1} << RoundedPoints::fraction_bits);
    return {static_cast<double>(at[0]) * scale, static_cast<double>(at[1]) * scale,
            static_cast<double>(at[2]) * scale};
}

/// How far the segment from `from` to `to` stays away from `point`.
double distance(Vec3 point, Vec3 from, Vec3 to) {
    const Vec3 edge = to - from, offset = point - from;
    const double square = dot(edge, edge);
    const double along = square > 0 ? std::clamp(dot(offset, edge) / square, 0.0, 1.0) : 0.0;
    return length(offset - along * edge);
}

/// Collects pairs of facets.
class PairSearch {
  public:
    PairSearch(const Surface& surface, const Soup& soup, const RoundedPoints& rounded, const Context& context)
        : surface_(surface), soup_(soup), rounded_(rounded), context_(context), merged_(surface.merged) {
        const double units = 4 * placing_bound(soup.lattice, rounded.numbers()) * exact::universe_side;
        tight_distance_ = units / contact_reach(soup.lattice, rounded.numbers()) + 1;
        std::sort(merged_.begin(), merged_.end());
        chain();
    }

    std::vector<Pair> run(std::span<const Pair> near) {
        if (!any_moved_ || context_.cancelled()) return {};
        for (const auto& [first, second] : near) add(first, second);
        for (std::uint32_t facet = 0; facet < moved_.size(); ++facet)
            if (moved_[facet] && next_[first_of_[facet]] != no_index) pairs_.push_back({facet, facet});
        // A facet may have pieces in polygons of different names.
        for (const auto& [facet, name] : merged_) add(facet, facet);
        gather();
        for (std::size_t i = 0; i + 1 < begin_.size(); ++i)
            about_corner({incident_.data() + begin_[i], begin_[i + 1] - begin_[i]});
        std::sort(pairs_.begin(), pairs_.end());
        pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
        return std::move(pairs_);
    }

    std::span<const std::uint32_t> first_of() const { return first_of_; }
    std::span<const std::uint32_t> next() const { return next_; }

  private:
    static constexpr std::size_t grain = 1 << 15;

    /// A facet of the soup at a corner; its triangles may go by the names of several facets.
    struct Incident {
        std::uint32_t facet;
        std::uint32_t corner : 2;
        std::uint32_t moved : 1;
    };

    /// The triangles of each facet, linked.
    void chain() {
        first_of_.resize(soup_.facets.size());
        next_.resize(surface_.triangles.size());
        moved_.assign(soup_.facets.size(), 0);
        parallel_chunks(context_, first_of_.size(), grain, [&](std::size_t begin, std::size_t end) {
            std::fill(first_of_.data() + begin, first_of_.data() + end, no_index);
        });
        const std::size_t whole = surface_.first_piece();
        parallel_chunks(context_, whole, grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                first_of_[surface_.facets[i].soup_facet] = static_cast<std::uint32_t>(i);
                next_[i] = no_index;
            }
        });
        for (auto i = static_cast<std::uint32_t>(surface_.triangles.size()); i-- > whole;) {
            const std::uint32_t facet = surface_.facets[i].soup_facet;
            next_[i] = first_of_[facet];
            first_of_[facet] = i;
            note_moved(i);
        }
        if (rounded_.moves_vertices())
            for (std::uint32_t i = 0; i < whole; ++i) note_moved(i);
    }
    void note_moved(std::uint32_t triangle) {
        for (const PointId corner : surface_.triangles[triangle])
            if (rounded_.is_moved(corner))
                moved_[surface_.facets[triangle].soup_facet] = 1, any_moved_ = true;
    }

    /// Calls `visit(facet)` for the names under which the triangles of a facet are found.
    template <class Visit>
    void for_each_name(std::uint32_t facet, const Visit& visit) const {
        if (first_of_[facet] != no_index) visit(facet);
        for (auto at = std::lower_bound(merged_.begin(), merged_.end(), Pair{facet, 0});
             at != merged_.end() && at->first == facet; ++at)
            if (at->second != facet) visit(at->second);
    }

    void add(std::uint32_t first, std::uint32_t second) {
        for_each_name(first, [&](std::uint32_t a) {
            for_each_name(second, [&](std::uint32_t b) {
                if (a != b && (moved_[a] || moved_[b])) pairs_.push_back(std::minmax(a, b));
            });
        });
    }

    /// The facets about each corner of a facet with moved points.
    void gather() {
        std::vector<char> has_moved = moved_, has_parts(soup_.facets.size(), 0);
        for (const auto& [facet, name] : merged_) {
            has_parts[facet] = 1;
            has_moved[facet] = static_cast<char>(has_moved[facet] | moved_[name]);
        }
        std::vector<std::uint32_t> number(soup_.points.size(), no_index);
        std::uint32_t corners = 0;
        for (std::uint32_t facet = 0; facet < soup_.facets.size(); ++facet)
            if (has_moved[facet])
                for (const std::uint32_t corner : soup_.facets[facet])
                    if (number[corner] == no_index) number[corner] = corners++;
        struct Found {
            std::uint32_t corner;
            Incident incident;
        };
        std::vector<std::vector<Found>> found(soup_.facets.size() / grain + 1);
        parallel_chunks(context_, soup_.facets.size(), grain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                if (first_of_[i] == no_index && !has_parts[i]) continue;
                for (std::uint32_t k = 0; k < 3; ++k) {
                    const std::uint32_t corner = number[soup_.facets[i][k]];
                    if (corner == no_index) continue;
                    const auto facet = static_cast<std::uint32_t>(i);
                    found[begin / grain].push_back({corner, {facet, k, has_moved[i] != 0}});
                }
            }
        });
        begin_.assign(corners + 1, 0);
        for (const std::vector<Found>& part : found)
            for (const Found& each : part) ++begin_[each.corner + 1];
        for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
        incident_.resize(begin_.back());
        std::vector<std::uint32_t> place(begin_.begin(), begin_.end() - 1);
        for (const std::vector<Found>& part : found)
            for (const Found& each : part) incident_[place[each.corner]++] = each.incident;
    }

    void about_corner(std::span<const Incident> facets) {
        std::vector<std::pair<std::uint32_t, std::uint32_t>>
            ends;  // of edges from here, with the facet's position
        for (std::uint32_t i = 0; i < facets.size(); ++i)
            for (std::uint32_t k = 1; k < 3; ++k)
                ends.push_back({soup_.facets[facets[i].facet][(facets[i].corner + k) % 3], i});
        std::sort(ends.begin(), ends.end());
        const auto add_two = [&](std::uint32_t i, std::uint32_t k) {
            if (facets[i].moved || facets[k].moved) add(facets[i].facet, facets[k].facet);
        };
        for (std::size_t i = 0; i < ends.size(); ++i)
            for (std::size_t k = i + 1; k < ends.size() && ends[k].first == ends[i].first; ++k)
                add_two(ends[i].second, ends[k].second);
        for (std::uint32_t i = 0; i < facets.size(); ++i)
            if (is_tight(facets[i]))
                for (std::uint32_t k = 0; k < facets.size(); ++k)
                    if (k != i) add_two(i, k);
    }

    /// Whether an edge of the facet's triangles that does not end in the corner comes near it. Large polygons are
    /// said to be, unseen.
    bool is_tight(const Incident& incident) const {
        constexpr int most = 64;
        const PointId corner = soup_.facets[incident.facet][incident.corner];
        const Vec3 at = lattice_place(rounded_, corner);
        int seen = 0;
        bool tight = false;
        for_each_name(incident.facet, [&](std::uint32_t name) {
            for (std::uint32_t i = first_of_[name]; i != no_index && !tight; i = next_[i]) {
                const mesh::Triangle& t = surface_.triangles[i];
                for (std::size_t k = 0; k < 3 && !tight; ++k) {
                    const PointId from = t[k], to = t[(k + 1) % 3];
                    if (from == corner || to == corner) continue;
                    tight = distance(at, lattice_place(rounded_, from), lattice_place(rounded_, to)) <
                            tight_distance_;
                }
                tight = tight || ++seen > most;
            }
        });
        return tight;
    }

    const Surface& surface_;
    const Soup& soup_;
    const RoundedPoints& rounded_;
    const Context& context_;
    std::vector<Pair> merged_;
    double tight_distance_ = 0;
    bool any_moved_ = false;
    UninitialisedVector<std::uint32_t> first_of_,
        next_;                          ///< triangle of a facet, and the next one after a triangle
    std::vector<char> moved_;           ///< per facet: its triangles have moved corners
    std::vector<std::uint32_t> begin_;  ///< into `incident_`, per corner
    std::vector<Incident> incident_;
    std::vector<Pair> pairs_;
};

/// Boxes are larger by this many lattice units: mending takes points to numbers beside theirs.
std::int32_t room_for_mending(const Soup& soup, const RoundedPoints& rounded) {
    return static_cast<std::int32_t>(std::ceil(2 * rounding_bound(soup.lattice, rounded.numbers())));
}

/// Groups of more triangles than this get a tree.
constexpr std::uint32_t large_group = 64;

}  // namespace

NearFacets::NearFacets(const Surface& surface, const Soup& soup, std::span<const Pair> near,
                       const RoundedPoints& rounded, const Context& context)
    : moved_(2 * placing_bound(soup.lattice, rounded.numbers()) + 0x1p-24) {
    PairSearch search(surface, soup, rounded, context);
    pairs_ = search.run(near);
    fill_groups(surface, soup, rounded, search.first_of(), search.next(), context);
}

void NearFacets::fill_groups(const Surface& surface, const Soup& soup, const RoundedPoints& rounded,
                             std::span<const std::uint32_t> first_of, std::span<const std::uint32_t> next,
                             const Context& context) {
    const std::int32_t mending = room_for_mending(soup, rounded);
    std::vector<std::uint32_t> facets;
    for (const auto& [first, second] : pairs_) facets.insert(facets.end(), {first, second});
    std::sort(facets.begin(), facets.end());
    facets.erase(std::unique(facets.begin(), facets.end()), facets.end());
    const auto below = [&](PointId id) {
        const RoundedPoints::Point at = rounded[id];
        const auto cell = [&](std::size_t axis) {
            return static_cast<std::int32_t>(at[axis] >> RoundedPoints::fraction_bits);
        };
        return exact::Point{cell(0), cell(1), cell(2)};
    };
    Soup corners;  // of the triangles in large groups
    for (const std::uint32_t facet : facets) {
        const auto begin = static_cast<std::uint32_t>(triangles_.size());
        const auto [p, q, r] = soup.facets[facet];
        const exact::Plane plane = exact::Plane::through(soup.points[p], soup.points[q], soup.points[r]);
        const int axis = plane.dominant_axis();
        const double turn = exact::sign_of(plane.normal(axis)) == exact::Sign::positive ? 1 : -1;
        for (std::uint32_t i = first_of[facet]; i != no_index; i = next[i]) {
            const mesh::Triangle& t = surface.triangles[i];
            const exact::Point a = below(t[0]), b = below(t[1]), c = below(t[2]);
            triangles_.push_back(i);
            const exact::Point low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}),
                                   std::min({a.z, b.z, c.z})},
                high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})};
            Shape& shape = shapes_.emplace_back();
            shape.low = {low.x - mending, low.y - mending, low.z - mending};
            shape.high = {high.x + mending, high.y + mending, high.z + mending};
            for (std::size_t k = 0; k < 5; ++k) {
                const Vec3 at = lattice_place(rounded, t[k % 3]);
                for (std::size_t each = 0; each < 3; ++each) shape.at[each][k] = at[each];
                shape.ids[k] = static_cast<std::int32_t>(t[k % 3]);
            }
            shape.axis = axis;
            shape.turn = surface.facets[i].reversed ? -turn : turn;
        }
        groups_.push_back({facet, begin, static_cast<std::uint32_t>(triangles_.size()), no_index});
    }
    const bool any_large = std::any_of(groups_.begin(), groups_.end(),
                                       [](const Group& group) { return group.size() > large_group; });
    if (!any_large) return;
    for (const std::uint32_t triangle : triangles_) {
        const auto first = static_cast<std::uint32_t>(corners.points.size());
        for (const PointId corner : surface.triangles[triangle]) corners.points.push_back(below(corner));
        corners.facets.push_back({first, first + 1, first + 2});
    }
    for (Group& group : groups_) {
        if (group.size() <= large_group) continue;
        std::vector<std::uint32_t> positions(group.size());
        for (std::uint32_t i = 0; i < positions.size(); ++i) positions[i] = group.begin + i;
        group.tree = static_cast<std::uint32_t>(trees_.size());
        trees_.emplace_back(corners, std::move(positions), mending, context);
    }
}

bool NearFacets::parts(const Shape& a, const Shape& b) const {
    // Products of differences of 27 bits; these and two sums may round, each by less than 8.
    const double rest = 2 * moved_ * moved_ + 32;
    static_assert(exact::coordinate_bits == 26);
    const int i = (a.axis + 1) % 3, j = (a.axis + 2) % 3;
    const auto load = [](const auto* from, auto lanes) {
        std::memcpy(&lanes, from, sizeof lanes);
        return lanes;
    };
    const auto magnitude = [](const Reals& value) { return value < 0 ? -value : value; };
    // A lane is an edge; the last one is the first again.
    const Reals u = load(a.at[i], Reals{}), v = load(a.at[j], Reals{});
    const Reals x = (load(a.at[i] + 1, Reals{}) - u) * a.turn, y = (load(a.at[j] + 1, Reals{}) - v) * a.turn;
    const Reals room = moved_ * (magnitude(x) + magnitude(y)) + rest;
    const Words from = load(a.ids, Words{}), to = load(a.ids + 1, Words{});
    unsigned parting = 0xf;
    for (int corner = 0; corner < 3 && parting; ++corner) {
        const Reals p = b.at[i][corner] - u, q = b.at[j][corner] - v;
        const auto outside = x * q - y * p + moved_ * (magnitude(p) + magnitude(q)) < -room;
        const auto ends = __builtin_convertvector((from == b.ids[corner]) | (to == b.ids[corner]), Flags);
        parting &= bits(outside) | bits(ends);
    }
    return parting != 0;
}

}  // namespace octavo::boolean
