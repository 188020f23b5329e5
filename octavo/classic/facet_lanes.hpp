// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <octavo/classic/facet.hpp>

// Four facets side by side in SIMD registers, one a lane, as doubles relative to a lattice point. Differences of
// lattice coordinates are exact doubles. For use inside a source file only: vector types have no stable ABI.

namespace octavo::classic {

using Lanes = double __attribute__((vector_size(32)));
using LaneFlags = std::int64_t __attribute__((vector_size(32)));  // all ones or zero a lane

/// position[corner][axis], one facet a lane.
struct FacetLanes {
    std::array<std::array<Lanes, 3>, 3> position;
};

/// Reads a corner as four words, of which the last belongs to what follows the corners and must be readable, and
/// transposes.
inline FacetLanes gather(const std::array<const FacetCorners*, 4>& facets,
                         const std::array<std::int32_t, 3>& low) {
    using Words = std::int32_t __attribute__((vector_size(16)));
    const Words base{low[0], low[1], low[2], 0};
    FacetLanes lanes;
    for (std::size_t corner = 0; corner < 3; ++corner) {
        std::array<Lanes, 4> row;
        for (std::size_t lane = 0; lane < 4; ++lane) {
            Words words;
            const auto* bytes = reinterpret_cast<const std::byte*>(facets[lane]);
            std::memcpy(&words, bytes + corner * sizeof(FacetCorners::value_type), sizeof words);
            row[lane] = __builtin_convertvector(words - base, Lanes);
        }
        const Lanes xy01 = __builtin_shufflevector(row[0], row[1], 0, 4, 1, 5);  // x0 x1 y0 y1
        const Lanes xy23 = __builtin_shufflevector(row[2], row[3], 0, 4, 1, 5);
        lanes.position[corner][0] = __builtin_shufflevector(xy01, xy23, 0, 1, 4, 5);
        lanes.position[corner][1] = __builtin_shufflevector(xy01, xy23, 2, 3, 6, 7);
        const Lanes z01 = __builtin_shufflevector(row[0], row[1], 2, 6, 2, 6);
        const Lanes z23 = __builtin_shufflevector(row[2], row[3], 2, 6, 2, 6);
        lanes.position[corner][2] = __builtin_shufflevector(z01, z23, 0, 1, 4, 5);
    }
    return lanes;
}

inline FacetLanes gather(const std::array<const Facet*, 4>& facets, const std::array<std::int32_t, 3>& low) {
    static_assert(offsetof(Facet, corner) + sizeof(FacetCorners) + 4 <= sizeof(Facet));
    return gather({&facets[0]->corner, &facets[1]->corner, &facets[2]->corner, &facets[3]->corner}, low);
}

}  // namespace octavo::classic
