// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/base/check.hpp>
#include <octavo/classic/facet_lanes.hpp>
#include <octavo/classic/octant_overlap.hpp>

// Vector types are passed in registers only where the machine has them; every such function here is inlined.

namespace octavo::classic {
namespace {

__extension__ using Wide = __int128;
using Flags = LaneFlags;

static_assert(2 * exact::coordinate_bits + 1 <= 53, "edge functions of lattice points are exact doubles");

inline Lanes all(double value) { return Lanes{value, value, value, value}; }
inline Lanes maximum(Lanes a, Lanes b) { return a > b ? a : b; }
inline Lanes magnitude(Lanes a) { return maximum(a, -a); }

/// Clears from `open` the quadrants that an edge of the projected triangles separates. `sense` is +1 where the
/// projection runs counter-clockwise and −1 elsewhere. A triangle that projects to a segment has edges of both
/// directions, so its line is tested from both sides; an edge that projects to a point separates nothing.
template <Touch touch>
inline void cut_quadrants(const FacetLanes& corners, std::size_t first, std::size_t second, Lanes sense,
                          double half, std::array<Flags, 4>& open) {
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& a = corners.position[i];
        const auto& b = corners.position[(i + 1) % 3];
        // E(u, v) = U u + V v + E(0, 0), positive to the left of the edge.
        const Lanes edge_u = (a[second] - b[second]) * sense, edge_v = (b[first] - a[first]) * sense;
        const Lanes at_low = (a[first] * b[second] - b[first] * a[second]) * sense;
        const Lanes step_u = edge_u * all(half), step_v = edge_v * all(half);
        // The greatest value in the first quadrant; the others lie whole steps further.
        const Lanes e00 = at_low + maximum(step_u, all(0)) + maximum(step_v, all(0));
        const Lanes e10 = e00 + step_u, e01 = e00 + step_v, e11 = e10 + step_v;
        // Separated iff greatest ≤ limit: values are integers, so −½ stands for "< 0".
        Lanes limit;
        if constexpr (touch == Touch::interior)
            limit = ((edge_u == all(0)) & (edge_v == all(0))) ? all(-0.5) : all(0);
        else
            limit = ((edge_u > all(0)) | (edge_v > all(0))) ? all(0) : all(-0.5);
        open[0] &= e00 > limit;
        open[1] &= e10 > limit;
        open[2] &= e01 > limit;
        open[3] &= e11 > limit;
    }
}

/// The octants that the plane of one facet meets, by 128-bit integers.
OctantSet plane_octants(const Facet& facet, const octree::Cell& cell, Touch touch) {
    const Normal n = normal_of(facet);
    const std::int64_t half = cell.side() / 2;
    OctantSet octants = 0;
    for (int octant = 0; octant < 8; ++octant) {
        const exact::Point low = cell.child(octant).low;
        Wide least = 0, greatest = 0;
        bool any_positive = false, any_negative = false;
        for (int axis = 0; axis < 3; ++axis) {
            const std::size_t k = static_cast<std::size_t>(axis);
            const Wide at_low = Wide{n[axis]} * (low[axis] - facet.corner[0][k]), step = Wide{n[axis]} * half;
            least += at_low + std::min(step, Wide{0});
            greatest += at_low + std::max(step, Wide{0});
            any_positive = any_positive || n[axis] > 0;
            any_negative = any_negative || n[axis] < 0;
        }
        const bool closed = touch == Touch::half_open;
        const bool reaches_up = greatest > 0 || (greatest == 0 && closed && !any_positive);
        const bool reaches_down = least < 0 || (least == 0 && closed && !any_negative);
        if (reaches_up && reaches_down) octants = static_cast<OctantSet>(octants | 1 << octant);
    }
    return octants;
}

/// The plane's octants by doubles; lanes in `undecided` have an octant that the filter could not decide.
struct PlaneOctants {
    std::array<Flags, 8> meets;
    Flags undecided;
};

inline PlaneOctants filter_planes(const FacetLanes& corners, const std::array<Lanes, 3>& n, double half) {
    const auto& a = corners.position[0];
    const std::array<Lanes, 3> size{magnitude(n[0]), magnitude(n[1]), magnitude(n[2])};
    const Lanes value = -(n[0] * a[0] + n[1] * a[1] + n[2] * a[2]);
    // |C| < R, with C twice the value at an octant's centre and R the sum of |n| times its side. At most seven
    // roundings of terms that `bulk` bounds, 2^-53 each, doubled for C: 2^-48 has room to spare.
    const Lanes radius = (size[0] + size[1] + size[2]) * all(half);
    const Lanes bulk = size[0] * magnitude(a[0]) + size[1] * magnitude(a[1]) + size[2] * magnitude(a[2]);
    const Lanes error = (bulk + all(4) * radius) * all(0x1p-48);
    const Lanes surely = radius - error, surely_not = radius + error;
    const Lanes step_x = n[0] * all(2 * half), step_y = n[1] * all(2 * half), step_z = n[2] * all(2 * half);
    const Lanes centre = all(2) * value + (n[0] + n[1] + n[2]) * all(half);
    PlaneOctants result;
    result.undecided = Flags{};
    for (std::size_t octant = 0; octant < 8; ++octant) {
        Lanes c = centre;
        if (octant & 1) c += step_x;
        if (octant & 2) c += step_y;
        if (octant & 4) c += step_z;
        c = magnitude(c);
        result.meets[octant] = c < surely;
        result.undecided |= (c >= surely) & (c <= surely_not);
    }
    return result;
}

template <Touch touch>
std::array<OctantSet, 4> touched(const std::array<const Facet*, 4>& facets, const octree::Cell& cell) {
    const double half = cell.side() / 2;
    const FacetLanes corners = gather(facets, {cell.low.x, cell.low.y, cell.low.z});
    const auto& [a, b, c] = corners.position;
    const std::array<Lanes, 3> u{b[0] - a[0], b[1] - a[1], b[2] - a[2]},
        v{c[0] - a[0], c[1] - a[1], c[2] - a[2]};
    const std::array<Lanes, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                 u[0] * v[1] - u[1] * v[0]};

    const Flags none = Flags{}, every = ~none;
    std::array<Flags, 4> yz{every, every, every, every}, xz = yz, xy = yz;
    // The projection along y onto (x, z) has the other orientation than the normal's component.
    const auto sense = [](Lanes component) { return component >= all(0) ? all(1) : all(-1); };
    cut_quadrants<touch>(corners, 1, 2, sense(n[0]), half, yz);
    cut_quadrants<touch>(corners, 0, 2, sense(-n[1]), half, xz);
    cut_quadrants<touch>(corners, 0, 1, sense(n[2]), half, xy);

    const PlaneOctants plane = filter_planes(corners, n, half);
    // A plane across one axis is that axis of the bounds; it would be undecided whenever it lies in a wall.
    const Flags across = (((n[0] == all(0)) & (n[1] == all(0))) | ((n[1] == all(0)) & (n[2] == all(0))) |
                          ((n[0] == all(0)) & (n[2] == all(0))));
    const Flags undecided = plane.undecided & ~across;
    Flags edges = none, planes = none;
    for (std::size_t octant = 0; octant < 8; ++octant) {
        const std::int64_t bit = std::int64_t{1} << octant;
        const Flags bits{bit, bit, bit, bit};
        edges |= yz[octant >> 1] & xz[(octant & 1) | (octant >> 1 & 2)] & xy[octant & 3] & bits;
        planes |= (plane.meets[octant] | across) & bits;
    }
    std::array<OctantSet, 4> result;
    for (std::size_t lane = 0; lane < 4; ++lane) {
        OctantSet meets = static_cast<OctantSet>(planes[lane]);
        if (undecided[lane]) meets = plane_octants(*facets[lane], cell, touch);
        result[lane] = static_cast<OctantSet>(edges[lane]) & meets;
    }
    return result;
}

}  // namespace

std::array<OctantSet, 4> touched_octants(const std::array<const Facet*, 4>& facets, const octree::Cell& cell,
                                         Touch touch) {
    std::array<const Facet*, 4> lanes = facets;
    for (const Facet*& facet : lanes)
        if (!facet) facet = lanes[0];
    return touch == Touch::interior ? touched<Touch::interior>(lanes, cell)
                                    : touched<Touch::half_open>(lanes, cell);
}

bool touches(const Facet& facet, const octree::Cell& cell, Touch touch) {
    const auto separates = [&](Wide x, Wide y, Wide z) {
        if (x == 0 && y == 0 && z == 0) return false;
        const exact::Point low = cell.low, high = cell.high();
        Wide facet_least = 0, facet_greatest = 0, cell_least = 0, cell_greatest = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const auto& p = facet.corner[i];
            const Wide value = x * p[0] + y * p[1] + z * p[2];
            facet_least = i == 0 ? value : std::min(facet_least, value);
            facet_greatest = i == 0 ? value : std::max(facet_greatest, value);
        }
        bool least_on_high = false, greatest_on_high = false;
        const Wide axis[3] = {x, y, z};
        for (int k = 0; k < 3; ++k) {
            cell_least += axis[k] * (axis[k] < 0 ? high[k] : low[k]);
            cell_greatest += axis[k] * (axis[k] > 0 ? high[k] : low[k]);
            least_on_high = least_on_high || axis[k] < 0;
            greatest_on_high = greatest_on_high || axis[k] > 0;
        }
        const bool open = touch == Touch::interior;
        return facet_least > cell_greatest || (facet_least == cell_greatest && (open || greatest_on_high)) ||
               facet_greatest < cell_least || (facet_greatest == cell_least && (open || least_on_high));
    };
    const Normal n = normal_of(facet);
    if (separates(1, 0, 0) || separates(0, 1, 0) || separates(0, 0, 1) || separates(n.x, n.y, n.z))
        return false;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& p = facet.corner[i];
        const auto& q = facet.corner[(i + 1) % 3];
        const Wide dx = q[0] - p[0], dy = q[1] - p[1], dz = q[2] - p[2];
        if (separates(0, -dz, dy) || separates(dz, 0, -dx) || separates(-dy, dx, 0)) return false;
    }
    return true;
}

}  // namespace octavo::classic
