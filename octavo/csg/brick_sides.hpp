// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/csg/lattice_torus.hpp>
#include <octavo/csg/layers.hpp>
#include <octavo/csg/program.hpp>
#include <octavo/csg/seen.hpp>

// On which side of one surface the 125 corners of a brick lie, and which of its 64 cells it keeps off: point_sides.hpp
// for two levels at once. Lanes are layers, so nothing is moved between lanes but in the end.
// Cost: 50 to 100 nanoseconds a surface, one to two a cell.

namespace octavo::csg {

/// A surface: corners strictly outside and inside, cells it does not enter and cells that lie inside.
struct BrickSides {
    LayerPair corners;
    Layers white, black;
};
BrickSides brick_sides(const LatticePlane& plane, const octree::Cell& brick);
BrickSides brick_sides(const Quadric& quadric, const octree::Cell& brick);
/// Only the corners; `white` and `black` are empty.
BrickSides brick_sides(const LatticeTorus& torus, const octree::Cell& brick);
/// The bounding box of a leaf.
BrickSides brick_sides_of_box(const Leaf& leaf, const octree::Cell& brick);

}  // namespace octavo::csg
