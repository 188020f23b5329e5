// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <compare>
#include <cstdint>

#include <octavo/base/vec3.hpp>
#include <octavo/exact/lattice.hpp>
#include <octavo/exact/wide_int.hpp>

// The part of a triangle that is nearest to a point, and how far it is: exact.
//
// Problem: the nearest point of a triangle is a vertex, on an edge, or in the face; rounding picks the wrong one near
// the borders of their regions, and two triangles that share the nearest vertex must come out equally far. Idea: the
// point is taken as integers, lattice coordinates times 2^shift below 2^62, and all region tests are signs of
// integer expressions (the order of tests is that of C. Ericson, Real-Time Collision Detection, 2005, 5.1.5). Squared
// distances are fractions; they are compared as doubles when these differ by more than their error, else exactly.
//
// Rule: shift is 36 for points in the universe, so each coordinate is rounded by at most 2^-37 lattice units, 2^-63 of
// the universe; points farther out keep 62 bits of the largest coordinate, points beyond 2^61 units keep their
// direction.
//
// Widths: differences q − a 63, edges 26, their scalar products 91, edge × difference 90, normal · difference 118;
// squared distances: vertex 128, edge 182 over 54, face 236 over 108; crosswise products 344.

namespace octavo::query {

/// A query point: lattice coordinates times 2^shift.
struct FixedPoint {
    std::array<std::int64_t, 3> x{};
    int shift = 36;
    bool scaled_down = false;  ///< beyond 2^61 units: only the direction is right

    /// No point of the universe is moved so far, in lattice units.
    static constexpr double resolution = 0x1p-36;

    /// `world` must be finite.
    static FixedPoint of(Vec3 world, const exact::Lattice& lattice);
    /// In lattice units, rounded.
    Vec3 approximation() const;
};

enum class Feature : std::uint8_t { vertex, edge, face };

/// Of a triangle.
using Corners = std::array<exact::Point, 3>;

struct NearestFeature {
    Feature feature = Feature::vertex;
    /// Vertex: it. Edge: both ends, the lesser one first. Face: the triangle's corners.
    Corners corners{};
    double squared_distance = 0;  ///< lattice units, relative error below 2^-48
};

/// Degenerate triangles are segments or points.
NearestFeature nearest_feature(const FixedPoint& q, const Corners& triangle);

/// Compares the true squared distances.
std::strong_ordering compare_distance(const FixedPoint& q, const NearestFeature& a, const NearestFeature& b);

/// The nearest point of the feature, in lattice units, rounded.
Vec3 nearest_point(const FixedPoint& q, const NearestFeature& feature);

}  // namespace octavo::query
