// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/csg/octant_colors.hpp>
#include <octavo/csg/program.hpp>

// The colours of the eight octants of a cell in one leaf of a program.
//
// Octants are classified eight at a time: neighbours share corners, half-extents and most of the arithmetic, and
// the eight lanes fill the vector unit. White and black are never wrong. They are tight (gray means that the
// surface meets the octant's interior) for boxes, half spaces and every convex body made of them, ellipsoids,
// cylinders and cones; what one constraint cannot say alone, `overlap` is asked about. Meshes are exact. Tori are
// only nearly tight.

namespace octavo::csg {

/// What is left of a leaf in the octants, for the pruning that follows: which items of its payload (constraints
/// or triangles) matter in which octants. Buffers are reused from cell to cell.
struct Remains {
    std::vector<std::uint8_t> matters;   ///< one byte an item, one bit an octant; appended by each leaf
    std::vector<std::int32_t> windings;  ///< eight for each polyhedron
    std::uint64_t tests = 0;  ///< octants in which a primitive was looked at, beyond its bounding box
};

/// A single constraint on the octants: colours, and where it certainly meets the interior.
struct ConstraintOnOctants {
    OctantColors colors;
    std::uint8_t middle_inside = 0;  ///< the middle of the octant is strictly inside
    std::uint8_t meets = 0;          ///< some point of the octant is strictly inside
};
ConstraintOnOctants classify(const LatticePlane& plane, const octree::Cell& parent);
ConstraintOnOctants classify(const SecondOrderCone& cone, const octree::Cell& parent);

/// The payload of a leaf: all of it (`items` empty and `all` true), or the words after the count.
struct Payload {
    bool all = true;
    std::span<const std::uint32_t> items;
};

/// Colours of the octants of `parent`; only those in `needed` must be right. Appends to `remains` one byte for
/// each constraint or triangle of the payload, and for a polyhedron eight windings, unless all needed octants
/// are decided.
OctantColors classify(const Program& program, const Leaf& leaf, Payload payload, const octree::Cell& parent,
                      std::uint8_t needed, Remains& remains);

/// Payload word of a polyhedron that precedes its triangles.
inline std::int32_t winding_of_word(std::uint32_t word) { return static_cast<std::int32_t>(word); }

}  // namespace octavo::csg
