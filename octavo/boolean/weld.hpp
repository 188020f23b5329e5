// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/exact/point.hpp>

// Equal lattice points become one.
//
// Idea: points are dealt out by hash into parts of a few thousand; a part and its hash table fit the second-level
// cache, and parts are independent. Points are numbered in the order in which they first appear, so the result does not
// depend on hashes or threads. One table for all, four times the size of the cache, took three times as long. Cost:
// about 30 ns a point.

namespace octavo::boolean {

struct Welded {
    UninitialisedVector<exact::Point> points;     ///< each once, in the order of first appearance
    UninitialisedVector<std::uint32_t> point_of;  ///< per position
};

Welded weld(const UninitialisedVector<exact::Point>& positions, const Context& context);

/// Spreads the coordinates over all 64 bits.
inline std::uint64_t hash(exact::Point point) {
    const std::uint64_t xy = static_cast<std::uint64_t>(static_cast<std::uint32_t>(point.x)) |
                             static_cast<std::uint64_t>(static_cast<std::uint32_t>(point.y)) << 32;
    const std::uint64_t mixed =
        (xy * 0x9E3779B97F4A7C15ull) ^
        (static_cast<std::uint64_t>(static_cast<std::uint32_t>(point.z)) * 0xC2B2AE3D27D4EB4Full);
    const std::uint64_t spread = (mixed ^ mixed >> 32) * 0x9E3779B97F4A7C15ull;
    return spread ^ spread >> 29;
}

}  // namespace octavo::boolean
