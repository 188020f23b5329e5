// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/csg/fold_words.hpp>
#include <octavo/csg/seen.hpp>

// The colours of the eight octants of a cell in one leaf of a program.
//
// Octants are classified eight at a time: a constraint is white or black where it cannot change sides on the way from
// the middle of an octant to its corners. Where points are asked for, the 27 corners tell black, and of a half space
// white; of a quadric its tangent. White and black are never wrong. Gray is not yet tight: octants that an edge or a
// bulge passes by may be left gray, because on the way down a cell too many costs less than the question whether it is
// needed; second_look.hpp asks it on the last level. Of a body that is small beside the octants, only the bounding box
// is looked at: most leaves of a large scene, on the levels where all of them are read. Meshes are exact.

namespace octavo::csg {

/// What is left of a leaf in the octants, for the pruning that follows: which items of its payload (constraints
/// or triangles) matter in which octants. Buffers are reused from cell to cell.
struct Remains {
    Scratch<std::uint8_t> matters;   ///< one byte an item, one bit an octant; appended by each leaf
    Scratch<std::int32_t> windings;  ///< eight for each polyhedron
    bool whole = false;              ///< all of the leaf last looked at is left, wherever it is gray
    std::uint64_t tests = 0;         ///< octants in which a primitive was looked at, beyond its bounding box
};

/// Of the octants of `parent` only those in `needed` must be right; the points, where they are asked for, are right
/// always. Appends to `remains` one byte for each constraint or triangle of the payload, and for a polyhedron eight
/// windings, unless all needed octants are decided.
template <class SeenOfLeaf>
SeenOfLeaf classify(const Program& program, const Leaf& leaf, Payload payload, const octree::Cell& parent,
                    std::uint8_t needed, Remains& remains);
extern template Seen classify<Seen>(const Program&, const Leaf&, Payload, const octree::Cell&, std::uint8_t,
                                    Remains&);
extern template ColorsSeen classify<ColorsSeen>(const Program&, const Leaf&, Payload, const octree::Cell&,
                                                std::uint8_t, Remains&);

/// The triangles of a polyhedron in a cell, and the winding number at the cell's reference point.
struct TrianglesInCell {
    std::span<const std::uint32_t> triangles;
    std::int32_t winding = 0;
};
/// Of a payload. When it is all of the polyhedron, `all` is filled with the triangles.
TrianglesInCell triangles_in(const LatticePolyhedron& polyhedron, Payload payload, const octree::Cell& cell,
                             std::vector<std::uint32_t>& all);

}  // namespace octavo::csg
