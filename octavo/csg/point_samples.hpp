// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/csg/program.hpp>

// An expression at 27 points of a cell at once: its corners, the middles of its edges and faces, and its own; those
// are also the corners of its octants.
//
// Two points strictly on different sides of the solid's surface prove that a cell which holds both is gray, and that
// is how most gray cells of the last level are recognised: one walk over the words for all eight octants, one bit a
// point. A point counts only when it is beyond doubt: off every plane, and off every quadric by its error bound.
// Then it has a neighbourhood of its colour, so a corner of a cell speaks for the cell's interior.

namespace octavo::csg {

/// One bit a point, x fastest: point i + 3 j + 9 k is at (i, j, k) half sides from the low corner.
struct PointColors {
    std::uint32_t outside = 0, inside = 0;

    static constexpr std::uint32_t all = (std::uint32_t{1} << 27) - 1;
};

inline PointColors complement(PointColors a) { return {a.inside, a.outside}; }
inline PointColors unite(PointColors a, PointColors b) { return {a.outside & b.outside, a.inside | b.inside}; }
inline PointColors intersect(PointColors a, PointColors b) { return {a.outside | b.outside, a.inside & b.inside}; }
inline PointColors symmetric_difference(PointColors a, PointColors b) {
    const std::uint32_t known = (a.outside | a.inside) & (b.outside | b.inside), odd = a.inside ^ b.inside;
    return {known & ~odd, known & odd};
}
/// What an operation of words starts from, and how it takes in an operand.
PointColors neutral_points(std::uint32_t w);
PointColors fold(std::uint32_t w, PointColors a, PointColors b);

PointColors sample(const LatticePlane& plane, const octree::Cell& cell);
PointColors sample(const SecondOrderCone& cone, const octree::Cell& cell);

class PointSampler {
  public:
    /// `words` is a program restricted to the cell. Meshes and tori are left unknown.
    PointColors sample(const Program& program, std::span<const std::uint32_t> words, const octree::Cell& cell);

  private:
    struct Open {
        std::uint32_t word, end;
        PointColors points;
    };
    std::vector<Open> open_;
};

/// Octants of the cell whose corners are seen on both sides, one bit each.
std::uint8_t octants_on_both_sides(PointColors points);

}  // namespace octavo::csg
