// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include <octavo/exact/lattice.hpp>
#include <octavo/exact/plane.hpp>
#include <octavo/exact/sign.hpp>
#include <octavo/octree/cell.hpp>
#include <octavo/render/camera.hpp>

// The viewer on the lattice: which side of a plane, and of a cell's middle walls, it is on. Exact, so that whatever
// orders parts of a solid by it can never contradict itself.
//
// In perspective the eye is rounded to the lattice once; orthographically it is infinitely far away, in a direction of
// whole numbers. Planes through the eye are seen edge-on, and what lies in them is not seen at all.
// Widths: coordinates of the eye below 2^60, normals below 2^53, offsets below 2^81: sides below 2^116, in 128 bits.

namespace octavo::render {

class Eye {
  public:
    Eye(const Camera& camera, const exact::Lattice& lattice);

    /// The side of the plane on which the viewer is.
    exact::Sign side(const exact::Plane& plane) const;

    /// The octant of the cell that the viewer is in, or that is nearest. From the front to the back, octants are
    /// this one exclusive-or 0, 1, … 7: none hides one before it.
    int nearest_octant(const octree::Cell& cell) const;

  private:
    static constexpr int bits = 60;
    static_assert(exact::budget::sum(4, exact::budget::normal + bits) < 127);
    static_assert(exact::budget::offset < exact::budget::normal + bits);

    std::array<std::int64_t, 3> at_{};  ///< in units, or the direction towards the viewer
    bool is_far_ = true;                ///< infinitely
};

}  // namespace octavo::render
