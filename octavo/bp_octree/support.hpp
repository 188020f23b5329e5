// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octavo/bp_octree/direction.hpp>
#include <octavo/bp_octree/triangle_cell.hpp>
#include <octavo/mesh/mesh.hpp>

// How far the content of a cell reaches in a direction, rounded outwards and proved: the certificate of every
// bounding plane.
//
// Problem: the content of a cell is the convex hull of mesh vertices, of the points where triangles are cut by
// the cell, and of cell corners inside the solid. Cut points are not on the lattice, and keeping them exactly
// would make every support value a comparison of fractions. Idea: in the cell's own coordinates, [0, 65536] along
// each axis, every such point x is replaced by the integer point i with i <= x <= i + 1, componentwise up to a
// slack of 2^-11. For an integer direction u with positive part P and negative part N, P + N = 127, then
//
//     u · x  <=  u · i + P (1 + 2^-11) + N 2^-11  <  u · i + P + 1,
//
// and max(u · i) + P + 1 is an integer bound, computed without any rounding: |u · i| <= 127 · 2^16 < 2^23, so
// 32-bit (and even float) arithmetic is exact. It exceeds the true support by less than 2^-15 of the cell.
//
// The slack, from Sutherland–Hodgman clipping in doubles: |coordinates| <= M = 2^16 · 2^19 (a triangle spans at
// most the padded root, whose side is below 2^19 cells at level 18). Mapping a lattice point to cell coordinates
// takes an exact difference, one product with a rounded factor: error <= 2 · 2^-53 M = 2^-17. A cut point
// a + t (b − a) errs by at most 8 · 2^-53 M = 2^-15 from the true one of the computed a, b. Let the computed
// polygon P' grown by e contain the true one P. Then P ∩ {x <= c} lies in (P' ∩ {x <= c + e}) grown by e; so the
// clip is made at c + 2^-12 and each of the six clips adds 2^-15: e <= 2^-17 + 6 · 2^-15 < 2^-12 throughout, and
// rounding down costs no more than that again. static_asserts below repeat the sums.

namespace octavo::bp_octree {

class PointSet {
  public:
    static constexpr std::int32_t cell_side = 65536;

    void clear() { x_.clear(), y_.clear(), z_.clear(); }
    std::size_t size() const { return x_.size(); }
    bool empty() const { return x_.empty(); }
    void add(std::int32_t x, std::int32_t y, std::int32_t z) {
        x_.push_back(x);
        y_.push_back(y);
        z_.push_back(z);
    }
    void add(const PointSet& other, std::size_t i) { add(other.x_[i], other.y_[i], other.z_[i]); }

    /// An integer that no point's u · x exceeds; see above. Not of an empty set.
    std::int32_t support(Direction u) const { return farthest_value(u) + positive_part(u) + 1; }

    /// The largest u · i, and an index where it occurs.
    std::int32_t farthest_value(Direction u) const;
    std::size_t farthest(Direction u) const;

    Vec3 point(std::size_t i) const {
        return {static_cast<double>(x_[i]), static_cast<double>(y_[i]), static_cast<double>(z_[i])};
    }

  private:
    std::vector<std::int32_t> x_, y_, z_;
    static_assert(std::int64_t{direction_length} * cell_side < (1 << 23));
};

/// Collects the points of one cell.
class CellContent {
  public:
    CellContent(const CellBox& box, PointSet& points);

    /// A mesh vertex in the cell.
    void add_vertex(exact::Point p) { add(map(p)); }
    /// Where the triangle is cut by the sides and edges of the cell.
    void add_cuts(exact::Point p, exact::Point q, exact::Point r);
    /// Corner `index` of the cell, bit 0 set at the high side of x and so on.
    void add_corner(int index);

    bool contains(exact::Point p) const {
        for (int axis = 0; axis < 3; ++axis)
            if (2 * p[axis] < box_.low[axis] || 2 * p[axis] > box_.high[axis]) return false;
        return true;
    }

  private:
    static constexpr double clip_slack = 1.0 / 4096;
    static_assert(1.0 / 131072 + 6.0 / 32768 < clip_slack, "the clip keeps all of the true polygon");
    static_assert(2 * clip_slack * direction_length < 1, "the slack is less than the one unit that is added");

    Vec3 map(exact::Point p) const {
        return {(2 * p.x - box_.low[0]) * scale_[0], (2 * p.y - box_.low[1]) * scale_[1],
                (2 * p.z - box_.low[2]) * scale_[2]};
    }
    void add(Vec3 x);

    CellBox box_;
    std::array<double, 3> scale_;
    PointSet& points_;
};

}  // namespace octavo::bp_octree
