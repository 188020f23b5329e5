// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/csg/brick_seen.hpp>
#include <octavo/csg/lattice_torus.hpp>

// On which side of one surface the 125 corners of a brick lie, and which of its 64 cells it keeps off: point_sides.hpp
// for two levels at once. Lanes are layers for planes, and corners of one layer for quadrics, of which more are
// evaluated. Cost: 30 to 80 nanoseconds a surface, about one a cell.

namespace octavo::csg {

/// A surface in steps of a quarter of a brick from its low corner: low + x (x + xx x + xy y + xz z) + …, negative
/// inside.
struct BrickSurface {
    float low = 0, x = 0, y = 0, z = 0, xx = 0, yy = 0, zz = 0, xy = 0, xz = 0, yz = 0;
    float error = 0;  ///< bounds the rounding of a value anywhere in the brick, the surface's own included
    float slope = 0;  ///< about how steep it is
    float bend = 0;   ///< how far below a tangent it may be in one cell
    bool curved = false;
    bool plain = true;  ///< negative is inside; not where the other nappe of a cone is near
};

/// A surface: corners strictly outside and inside, cells it does not enter and cells that lie inside.
struct BrickSides {
    LayerPair corners;
    Layers white, black;
};
/// `surface` is set to the surface seen from the brick.
BrickSides brick_sides(const LatticePlane& plane, const octree::Cell& brick, BrickSurface& surface);
BrickSides brick_sides(const Quadric& quadric, const octree::Cell& brick, BrickSurface& surface);
/// Only the corners; `white` and `black` are empty.
BrickSides brick_sides(const LatticeTorus& torus, const octree::Cell& brick);
/// The bounding box of a leaf. It holds corners and cells only for one that is a box.
BrickSides brick_sides_of_box(const Leaf& leaf, const octree::Cell& brick);

}  // namespace octavo::csg
