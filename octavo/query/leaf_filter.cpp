// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/classic/facet_lanes.hpp>
#include <octavo/query/leaf_filter.hpp>

namespace octavo::query {
namespace {

using classic::FacetCorners;
using classic::FacetLanes;
using classic::LaneFlags;
using classic::Lanes;

/// What three edge functions say for certain about a projected facet and a point.
struct Inclusion {
    LaneFlags in, out;
};

inline Inclusion inclusion(const std::array<Lanes, 3>& u, const std::array<Lanes, 3>& v, const Lanes& error) {
    const Lanes e0 = u[0] * v[1] - u[1] * v[0], e1 = u[1] * v[2] - u[2] * v[1],
                e2 = u[2] * v[0] - u[0] * v[2];
    const Lanes minus = -error;
    const LaneFlags above0 = e0 > error, above1 = e1 > error, above2 = e2 > error;
    const LaneFlags below0 = e0 < minus, below1 = e1 < minus, below2 = e2 < minus;
    return {(above0 & above1 & above2) | (below0 & below1 & below2),
            (above0 | above1 | above2) & (below0 | below1 | below2)};
}

/// On which side of its plane each facet certainly has a point.
struct Sides {
    LaneFlags above, below;
};
inline Sides sides_of(const Lanes& value, const Lanes& error) { return {value > error, value < -error}; }

struct Count {
    LaneFlags change{};  ///< minus the change of the winding number
    LaneFlags doubt{};
};

inline void count_step(const Inclusion& inside, const Sides& from, const Sides& to, Count& count) {
    const LaneFlags entering = from.above & to.below, leaving = from.below & to.above;
    const LaneFlags same = (from.above & to.above) | (from.below & to.below);
    count.change += inside.in & (entering - leaving);
    count.doubt |= ~(inside.out | same | (inside.in & (entering | leaving)));
}

inline Count count_path(const FacetLanes& facets, double extent, const std::array<double, 3>& offset) {
    std::array<Lanes, 3> x, y, z, x_to, y_to;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        x[corner] = facets.position[corner][0];
        y[corner] = facets.position[corner][1];
        z[corner] = facets.position[corner][2];
        x_to[corner] = x[corner] - offset[0];
        y_to[corner] = y[corner] - offset[1];
    }
    const double square = extent * extent;
    const Lanes zero{}, edge_error = zero + 64 * 0x1p-53 * square,
                        side_error = zero + 512 * 0x1p-53 * square * extent;

    const Lanes ux = x[1] - x[0], uy = y[1] - y[0], uz = z[1] - z[0];
    const Lanes vx = x[2] - x[0], vy = y[2] - y[0], vz = z[2] - z[0];
    const Lanes nx = uy * vz - uz * vy, ny = uz * vx - ux * vz, nz = ux * vy - uy * vx;
    const Lanes at_start = -(nx * x[0] + ny * y[0] + nz * z[0]);
    const Lanes after_x = at_start + nx * offset[0], after_y = after_x + ny * offset[1];
    const Sides start = sides_of(at_start, side_error), first = sides_of(after_x, side_error),
                second = sides_of(after_y, side_error), last = sides_of(after_y + nz * offset[2], side_error);

    Count count;
    count_step(inclusion(y, z, edge_error), start, first, count);
    count_step(inclusion(x_to, z, edge_error), first, second, count);
    count_step(inclusion(x_to, y_to, edge_error), second, last, count);
    return count;
}

}  // namespace

std::optional<int> winding_change(std::span<const std::uint32_t> references,
                                  std::span<const FacetCorners> facets,
                                  const std::array<std::int32_t, 3>& low, double extent,
                                  const std::array<double, 3>& offset) {
    LaneFlags change{};
    for (std::size_t i = 0; i < references.size(); i += 4) {
        // Lanes beyond the last facet repeat it and do not count.
        const std::size_t last = references.size() - 1;
        const std::array<const FacetCorners*, 4> four{
            &facets[references[i]], &facets[references[std::min(i + 1, last)]],
            &facets[references[std::min(i + 2, last)]], &facets[references[std::min(i + 3, last)]]};
        const auto left = static_cast<std::int64_t>(references.size() - i);
        const LaneFlags used = LaneFlags{0, 1, 2, 3} < left;
        const Count count = count_path(classic::gather(four, low), extent, offset);
        const LaneFlags doubt = count.doubt & used;
        if (doubt[0] | doubt[1] | doubt[2] | doubt[3]) return std::nullopt;
        change += count.change & used;
    }
    return static_cast<int>(-(change[0] + change[1] + change[2] + change[3]));
}

}  // namespace octavo::query
