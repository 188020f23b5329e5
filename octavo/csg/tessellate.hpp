// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/csg/region.hpp>
#include <octavo/mesh/mesh.hpp>

// The polyhedra that OpenSCAD puts in the place of round things; all but the circle are convex bodies.

namespace octavo::csg {

/// OpenSCAD's $fn, $fa and $fs: a fixed number of corners, or the most degrees and the most length of a side.
struct Roundness {
    double fn = 0, fa = 12, fs = 2;
};

/// Corners of a circle of this radius.
int segments_of(double radius, const Roundness& roundness);

Contour circle(double radius, int segments);
/// Rings of corners at the middles of equal bands, so without poles.
mesh::Mesh faceted_ball(double radius, int segments);
/// From z = low to z = high; a radius of zero is a point.
mesh::Mesh faceted_frustum(double low, double high, double bottom, double top, int segments);
mesh::Mesh cuboid_mesh(Vec3 low, Vec3 high);

}  // namespace octavo::csg
