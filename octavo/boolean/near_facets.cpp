// SPDX-License-Identifier: Apache-2.0
#include <atomic>
#include <numeric>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/chunk_offsets.hpp>
#include <octavo/boolean/lanes.hpp>
#include <octavo/boolean/near_facets.hpp>

namespace octavo::boolean {
namespace {

/// Boxes are larger by this many lattice units: mending takes points to numbers beside theirs.
std::int32_t room_for_mending(const Soup& soup, const RoundedPoints& rounded) {
    return static_cast<std::int32_t>(std::ceil(2 * rounding_bound(soup.lattice, rounded.numbers())));
}

/// The lattice cell that holds a point, by its low corner.
exact::Point below(const RoundedPoints& rounded, PointId id) {
    const RoundedPoints::Point at = rounded[id];
    const auto cell = [&](std::size_t axis) {
        return static_cast<std::int32_t>(at[axis] >> RoundedPoints::fraction_bits);
    };
    return {cell(0), cell(1), cell(2)};
}

/// Groups of more triangles than this get a tree.
constexpr std::uint32_t large_group = 64;

}  // namespace

NearFacets::NearFacets(const Surface& surface, const Soup& soup, std::span<const Pair> near,
                       const RoundedPoints& rounded, const Context& context)
    : moved_(2 * placing_bound(soup.lattice, rounded.numbers()) + 0x1p-24) {
    NearPairs found = find_near_pairs(surface, soup, near, rounded, context);
    pairs_ = std::move(found.pairs);
    fill_groups(surface, soup, rounded, found.first_of, found.next, context);
}

void NearFacets::fill_groups(const Surface& surface, const Soup& soup, const RoundedPoints& rounded,
                             std::span<const std::uint32_t> first_of, std::span<const std::uint32_t> next,
                             const Context& context) {
    find_groups(soup, first_of, next, context);
    if (context.cancelled()) return forget();
    const std::int32_t mending = room_for_mending(soup, rounded);
    triangles_.resize(groups_.empty() ? 0 : groups_.back().end);
    shapes_.resize(triangles_.size());
    parallel_chunks(context, groups_.size(), 1 << 10, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Group& group = groups_[i];
            const auto [p, q, r] = soup.facets[group.facet];
            const exact::Plane plane = exact::Plane::through(soup.points[p], soup.points[q], soup.points[r]);
            const int axis = plane.dominant_axis();
            const double turn = exact::sign_of(plane.normal(axis)) == exact::Sign::positive ? 1 : -1;
            std::uint32_t triangle = first_of[group.facet];
            for (std::uint32_t at = group.begin; at < group.end; ++at, triangle = next[triangle]) {
                triangles_[at] = triangle;
                shapes_[at] = shape_of(surface.triangles[triangle], rounded, mending, axis,
                                       surface.facets[triangle].reversed ? -turn : turn);
            }
        }
    });
    plant_trees(surface, rounded, mending, context);
}

void NearFacets::forget() {
    pairs_.clear();
    groups_.clear();
}

void NearFacets::find_groups(const Soup& soup, std::span<const std::uint32_t> first_of,
                             std::span<const std::uint32_t> next, const Context& context) {
    if (pairs_.empty()) return;
    constexpr std::size_t grain = 1 << 12;
    std::vector<char> is_in_pair(soup.facets.size(), 0);
    const auto mark = [&](std::uint32_t facet) {
        std::atomic_ref(is_in_pair[facet]).store(1, std::memory_order_relaxed);
    };
    parallel_chunks(context, pairs_.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) mark(pairs_[i].first), mark(pairs_[i].second);
    });
    const std::vector<std::size_t> offset =
        chunk_offsets(context, is_in_pair.size(), grain, [&](std::size_t begin, std::size_t end) {
            return static_cast<std::size_t>(
                std::count(is_in_pair.data() + begin, is_in_pair.data() + end, 1));
        });
    groups_.resize(offset.back());
    parallel_chunks(context, is_in_pair.size(), grain, [&](std::size_t begin, std::size_t end) {
        std::size_t at = offset[begin / grain];
        for (auto facet = static_cast<std::uint32_t>(begin); facet < end; ++facet) {
            if (!is_in_pair[facet]) continue;
            std::uint32_t size = 0;
            for (std::uint32_t i = first_of[facet]; i != no_index; i = next[i]) ++size;
            groups_[at++] = {facet, 0, size, no_index};
        }
    });
    if (context.cancelled()) return;
    std::uint32_t sum = 0;
    for (Group& group : groups_) group.begin = std::exchange(sum, sum + group.end), group.end = sum;
}

void NearFacets::plant_trees(const Surface& surface, const RoundedPoints& rounded, std::int32_t mending,
                             const Context& context) {
    std::vector<std::uint32_t> large;
    for (std::uint32_t i = 0; i < groups_.size(); ++i)
        if (groups_[i].size() > large_group)
            groups_[i].tree = static_cast<std::uint32_t>(large.size()), large.push_back(i);
    if (large.empty()) return;
    Soup corners;  // of the triangles
    corners.points.resize(3 * triangles_.size());
    corners.facets.resize(triangles_.size());
    parallel_chunks(context, triangles_.size(), 1 << 12, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const auto first = static_cast<std::uint32_t>(3 * i);
            for (std::uint32_t k = 0; k < 3; ++k)
                corners.points[first + k] = below(rounded, surface.triangles[triangles_[i]][k]);
            corners.facets[i] = {first, first + 1, first + 2};
        }
    });
    trees_.resize(large.size());
    parallel_chunks(context, large.size(), 1, [&](std::size_t i, std::size_t) {
        const Group& group = groups_[large[i]];
        std::vector<std::uint32_t> positions(group.size());
        std::iota(positions.begin(), positions.end(), group.begin);
        trees_[i] = BoxTree(corners, std::move(positions), mending, context);
    });
}

NearFacets::Shape NearFacets::shape_of(const mesh::Triangle& t, const RoundedPoints& rounded,
                                       std::int32_t mending, int axis, double turn) {
    Shape shape;
    const exact::Point a = below(rounded, t[0]), b = below(rounded, t[1]), c = below(rounded, t[2]);
    shape.low = {std::min({a.x, b.x, c.x}) - mending, std::min({a.y, b.y, c.y}) - mending,
                 std::min({a.z, b.z, c.z}) - mending};
    shape.high = {std::max({a.x, b.x, c.x}) + mending, std::max({a.y, b.y, c.y}) + mending,
                  std::max({a.z, b.z, c.z}) + mending};
    for (std::size_t k = 0; k < 5; ++k) {
        const Vec3 at = lattice_place(rounded, t[k % 3]);
        for (std::size_t each = 0; each < 3; ++each) shape.at[each][k] = at[each];
        shape.ids[k] = static_cast<std::int32_t>(t[k % 3]);
    }
    shape.axis = axis;
    shape.turn = turn;
    return shape;
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
