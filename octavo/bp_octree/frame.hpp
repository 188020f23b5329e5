// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <octavo/base/result.hpp>
#include <octavo/octree/cell.hpp>

// Where the cells of a BP-octree lie: a box that fits its content, halved along all axes at every level.
//
// Problem: envelopes are the tighter the smaller their cells are, and a cube round a long thin solid wastes most
// of its cells on air. Idea: the root is the content's own bounding box, so cells have its proportions; an
// octree::Cell only names them (its position counts cells). To stay exact, all coordinates here are *doubled*
// lattice units and every cell plane is odd, that is, at a half-integer of the lattice: no vertex ever lies on
// one, so no face lies in one either, and a vertex is in exactly one cell of a level.
//
// Invariant: the root's low corner is odd, and each of its sides is a multiple of 2^(depth + 1), so that cells of
// one level have the same, even sides down to `depth`. The root exceeds the content by half a lattice unit at its
// low sides and by at most 2^depth units at its high ones.

namespace octavo::bp_octree {

/// The finest level of any BP-octree: the depth at which the thesis's octcodes fill 64 bits.
inline constexpr int max_depth = 18;

/// A closed box in doubled lattice units.
struct CellBox {
    std::array<std::int32_t, 3> low{}, high{};
    std::int32_t side(int axis) const { return high[axis] - low[axis]; }
};

class Frame {
  public:
    Frame() = default;

    /// The frame of these points with cells down to level `depth`, 0 to max_depth. At least one point.
    static Frame around(std::span<const exact::Point> points, int depth);

    /// A frame as stored in a file. Errors: bad_input when it is not one that `around` could have made.
    static Result<Frame> from_parts(std::array<std::int32_t, 3> low, std::array<std::int32_t, 3> side,
                                    int depth);

    const std::array<std::int32_t, 3>& low() const { return low_; }
    const std::array<std::int32_t, 3>& side() const { return side_; }
    int depth() const { return depth_; }
    /// Side of the cells of this level along `axis`, in doubled units.
    std::int32_t side(int axis, int level) const { return side_[axis] >> level; }

    /// The box of a cell, whose level is at most `depth`.
    CellBox box(const octree::Cell& cell) const {
        CellBox box;
        for (int axis = 0; axis < 3; ++axis) {
            const std::int32_t position = cell.low[axis] >> (exact::coordinate_bits - cell.level);
            box.low[axis] = low_[axis] + position * side(axis, cell.level);
            box.high[axis] = box.low[axis] + side(axis, cell.level);
        }
        return box;
    }

    friend bool operator==(const Frame&, const Frame&) = default;

  private:
    std::array<std::int32_t, 3> low_{-1, -1, -1};
    std::array<std::int32_t, 3> side_{2, 2, 2};
    int depth_ = 0;
};

}  // namespace octavo::bp_octree
