// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/mesh/mesh.hpp>

// Generated solids: for tests, examples and benchmarks, and as building blocks. Every one is closed, oriented
// outwards and free of self-intersections, has no unused or repeated vertex and no facet without area (for
// parameters that make geometric sense; each function checks its own). What is symmetric comes out symmetric
// to the last bit: circles are built from one octant by exact reflections. The same parameters give the same
// bytes on every machine with a correctly rounding libm for the octant's sines (and without sines at all for
// displaced_sphere).

namespace octavo::mesh {

/// An axis-aligned box; 12 triangles.
Mesh box(Vec3 low, Vec3 high);

/// A cube of this side about the origin.
Mesh cube(double side = 1);

/// The regular tetrahedron on alternate corners of the cube [−size, size]³.
Mesh tetrahedron(double size = 1);

/// An octahedron whose facets are cut into frequency² each and pushed to the sphere about the origin:
/// 8 · frequency² triangles.
Mesh octasphere(double radius, std::uint32_t frequency);

/// The same of an icosahedron: 20 · frequency² triangles, more even than those of the octahedron.
Mesh icosphere(double radius, std::uint32_t frequency);

/// A sphere in meridians and parallels, poles on z. segments >= 3 round the axis, rings >= 2 from pole to
/// pole.
Mesh uv_sphere(double radius, std::uint32_t segments, std::uint32_t rings);

/// A cylinder about z from z = 0 to `height`; segments >= 3.
Mesh cylinder(double radius, double height, std::uint32_t segments);

/// A cone, or a frustum when both radii are positive, about z from z = 0 (`radius_low`) to `height`.
Mesh cone(double radius_low, double radius_high, double height, std::uint32_t segments);

/// A torus about z: the tube of radius `tube` round the circle of radius `ring`. 2 · segments · sides
/// triangles.
Mesh torus(double ring, double tube, std::uint32_t segments, std::uint32_t sides);

struct Point2D {
    double x = 0, y = 0;
};
using Outline = std::vector<Point2D>;

/// Points of a circle, counter-clockwise from (radius, 0) + centre, in equal steps.
Outline circle(double radius, std::uint32_t segments, Point2D centre = {});

/// The prism over a polygon from z = 0 to `height`. `outer` runs counter-clockwise, holes run clockwise or
/// not.
Mesh extrude(const Outline& outer, std::span<const Outline> holes, double height);

struct GearOptions {
    std::uint32_t teeth = 24;
    double module = 2;  ///< pitch diameter / teeth
    double thickness = 8;
    double bore_radius = 6;
    std::uint32_t lightening_holes = 6;  ///< round holes in the web; 0 for none
    std::uint32_t flank_points = 6;      ///< per flank of a tooth
    std::uint32_t hole_segments = 48;
};

/// A spur gear with involute flanks (20° pressure angle), a bore and lightening holes.
Mesh gear(const GearOptions& options = {});

struct HousingOptions {
    double flange_radius = 40, flange_height = 8;
    double hub_radius = 24, hub_height = 26;   ///< from the bottom of the flange to the top of the hub
    double seat_radius = 17, seat_depth = 14;  ///< where the bearing sits, from the top of the hub
    double bore_radius = 10;
    double chamfer = 1.5;  ///< of the hub's and the flange's upper edges
    std::uint32_t bolts = 6;
    double bolt_circle = 32, bolt_radius = 2.75;
    double counterbore_radius = 4.75, counterbore_depth = 4;
    std::uint32_t segments = 96;       ///< of the large circles
    std::uint32_t bolt_segments = 32;  ///< of the small ones
};

/// A flanged bearing housing: chamfered flange with counterbored bolt holes, hub with a stepped bore. One
/// connected surface of genus 1 + bolts.
Mesh bearing_housing(const HousingOptions& options = {});

/// A tube of radius `tube` round the (p, q) torus knot, p times round the axis and q times round the ring; p
/// and q have no common divisor. 2 · segments · sides triangles.
Mesh knot_tube(std::uint32_t p, std::uint32_t q, double tube, std::uint32_t segments, std::uint32_t sides);

struct DisplacementOptions {
    double amplitude = 0.35;  ///< of the first octave, as a part of the radius
    std::uint32_t octaves = 5;
    double frequency = 2.5;  ///< of the first octave, bumps per radius
    std::uint64_t seed = 1;
};

/// An icosphere of radius about 1 whose vertices are moved along their radii by value noise: concave and
/// rough at all scales, yet free of self-intersections since every ray from the origin meets it once.
Mesh displaced_sphere(std::uint32_t frequency, const DisplacementOptions& options = {});

/// The Menger sponge of the unit cube, on its own grid of 3^level cells a side: 1, 20, 400 … cubes with the
/// walls between them left out. Edges where only two cubes touch do not occur.
Mesh menger_sponge(std::uint32_t level);

}  // namespace octavo::mesh
