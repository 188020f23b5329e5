// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <octavo/octree/morton.hpp>

// A cell unpacked: what a descent computes with. CellKey is its name; going between the two costs a few bit
// operations.

namespace octavo::octree {

struct Cell {
    exact::Point low;
    int level = 0;

    static constexpr Cell root() { return {}; }
    static constexpr Cell of(CellKey key) { return {key.low(), key.level()}; }
    constexpr CellKey key() const { return CellKey::at(low, level); }

    constexpr std::int32_t side() const { return cell_side(level); }
    /// One past the last lattice point on each axis; at most 2^26.
    constexpr exact::Point high() const { return {low.x + side(), low.y + side(), low.z + side()}; }
    constexpr exact::Point centre() const {
        const std::int32_t half = side() >> 1;
        return {low.x + half, low.y + half, low.z + half};
    }
    /// Octant `index`: bit 0 is set in the high half of x, bit 1 of y, bit 2 of z.
    constexpr Cell child(int index) const {
        const std::int32_t half = side() >> 1;
        return {
            {low.x + (index & 1 ? half : 0), low.y + (index & 2 ? half : 0), low.z + (index & 4 ? half : 0)},
            level + 1};
    }
    constexpr bool contains(exact::Point p) const {
        const exact::Point h = high();
        return p.x >= low.x && p.x < h.x && p.y >= low.y && p.y < h.y && p.z >= low.z && p.z < h.z;
    }
    friend constexpr bool operator==(const Cell&, const Cell&) = default;
};

}  // namespace octavo::octree
