// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include <octavo/octree/octree.hpp>

// Volume, centroid and inertia of a classic octree.
//
// Each leaf is a cube, whose moments are closed formulas; they are added as integers, so the sums are exact and do
// not depend on the order, and rounded once at the end.
// Bits: lengths are counted in half sides of a cell of level 21, so a side is at most 2^22 and a volume 2^66. Second
// moments are multiplied by 12: 4 + 66 + 44 = 114 < 127.

namespace octavo::classic {

struct Moments {
    double volume = 0;
    Vec3 centroid;
    /// About the centroid, for density one: ∫ |r|² δ_ij − r_i r_j.
    std::array<std::array<double, 3>, 3> inertia{};
};

/// Of the black leaves alone, a lower bound of the solid, or with the gray ones.
enum class CountedLeaves : std::uint8_t { black, black_and_gray };

Moments moments(const octree::Octree& octree, CountedLeaves counted = CountedLeaves::black);

}  // namespace octavo::classic
