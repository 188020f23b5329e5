// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <variant>

#include <octavo/base/vec3.hpp>
#include <octavo/mesh/mesh.hpp>

// The solids that a CSG expression is made of, each in a frame of its own where it is easy to write down; an
// affine map on the way to the root puts it in place. All are closed sets taken for their interiors: two solids
// that touch in a face leave nothing between them.

namespace octavo::csg {

/// The parallelepiped [low, high]; empty unless low < high on every axis.
struct Cuboid {
    Vec3 low, high;
};

/// The ball about the origin; an affine map makes it any ellipsoid.
struct Ball {
    double radius = 1;
};

/// Cylinder, cone or truncated cone about the z axis: radius `bottom` at z = low, `top` at z = high.
struct Frustum {
    double low = 0, high = 1;
    double bottom = 1, top = 1;
};

/// The points nearer than `minor` to the circle of radius `major` in the plane z = 0. A minor radius above the
/// major one gives a spindle without a hole.
struct Torus {
    double major = 1, minor = 0.25;
};

/// The points x with normal · x <= offset; the normal points out of the solid.
struct HalfSpace {
    Vec3 normal{0, 0, 1};
    double offset = 0;
};

/// All of space. Its complement is the empty solid.
struct Everything {};

/// The points about which a closed mesh winds at least once (counter-clockwise facets seen from outside). The
/// mesh may cross or touch itself; `Convexity::convex` promises that it bounds a convex body.
enum class Convexity : unsigned char { any, convex };
struct Polyhedron {
    std::shared_ptr<const mesh::Mesh> mesh;
    Convexity convexity = Convexity::any;
};

using Primitive = std::variant<Cuboid, Ball, Frustum, Torus, HalfSpace, Everything, Polyhedron>;

/// Whether the primitive has no interior by its own parameters (a box of no height, a ball of no radius).
bool is_degenerate(const Primitive& primitive);

/// Whether every parameter is a finite number.
bool is_finite(const Primitive& primitive);

/// The smallest known box around the image of the primitive; infinite sides where it is unbounded.
Box3 bounds(const Primitive& primitive, const Affine& place);

/// Whether the map squeezes space into a plane, line or point, or so near one that no lattice can tell: the image of a
/// solid then has no interior. How much it scales, along whichever axes, does not count.
bool is_singular(const Affine& map);

}  // namespace octavo::csg
