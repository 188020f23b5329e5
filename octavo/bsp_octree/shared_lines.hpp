// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <octavo/bsp/fragment.hpp>
#include <octavo/bsp/plane_table.hpp>

// Lines along which faces in three planes may meet.
//
// Faces cross only along a line that three planes with faces have in common (borders.hpp), and such lines are rare: so
// edges of fragments that run both ways are forgotten at once everywhere else. In a leaf, the line of an edge's plane
// and of its bound must lie in the plane of another fragment. Where it is the line of two walls, the faces about it are
// in four cells, and none may know of the others. Doubles tell: what they leave open may be shared, and costs a look.
// In the few leaves of very many planes, as of an apex with thousands of faces, all edges may: trying each with each
// plane took seven times as long as all the rest of `to_mesh` of a cone of 12 000 faces.

namespace octavo::bsp_octree {

class SharedLines {
  public:
    /// The fragments of a leaf.
    void begin(const bsp::PlaneTable& planes, std::span<const bsp::Fragment> fragments);

    /// Whether faces in three planes may meet along an edge in `plane` that `bound` cuts out and a point of which is at
    /// `start`, rounded. False only when they certainly do not.
    bool may_be_shared(bsp::PlaneId plane, bsp::Bound bound, const Vec3& start) const;

  private:
    struct Approximate {
        bsp::PlaneId id;
        Vec3 normal;
        double d;
    };

    static constexpr std::size_t most_planes = 64;
    const bsp::PlaneTable* table_ = nullptr;
    std::vector<bsp::PlaneId> ids_;
    std::vector<Approximate> planes_;
};

}  // namespace octavo::bsp_octree
