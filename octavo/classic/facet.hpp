// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/mesh/mesh.hpp>

// The triangles of a solid as the descent wants them: corners and bounds side by side in one cache line, so that a
// test of a triangle against a cell costs one miss at most; triangles without area, which bound nothing and would
// need special cases everywhere, are left out.

namespace octavo::classic {

/// The corners of a triangle on the lattice.
using FacetCorners = std::array<std::array<std::int32_t, 3>, 3>;

struct alignas(64) Facet {
    std::array<std::int32_t, 3> low, high;  ///< bounds, both inclusive
    FacetCorners corner;                    ///< counter-clockwise seen from outside
    std::uint32_t source = 0;               ///< index of the triangle in the mesh
};
static_assert(sizeof(Facet) == 64);

/// Twice the area times the outward normal. Differences have 27 signed bits and each component is a difference of
/// two of their products, so it fits 54 signed bits.
struct Normal {
    std::int64_t x, y, z;
    std::int64_t operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    bool is_zero() const { return x == 0 && y == 0 && z == 0; }
};
static_assert(2 * exact::coordinate_bits + 1 + 1 <= 63, "a normal's component fits a signed word");

inline Normal normal_of(const FacetCorners& corner) {
    const auto& [a, b, c] = corner;
    const std::int64_t ux = b[0] - a[0], uy = b[1] - a[1], uz = b[2] - a[2];
    const std::int64_t vx = c[0] - a[0], vy = c[1] - a[1], vz = c[2] - a[2];
    return {uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
}

inline Normal normal_of(const Facet& facet) { return normal_of(facet.corner); }

/// Errors: bad_input when a triangle names a vertex that is not there, or a point lies outside the universe.
Status check_places(const mesh::LatticeMesh& mesh);

/// The facets of a mesh, in its order, without those that have no area. Errors: those of check_places.
Result<std::vector<Facet>> facets_of(const mesh::LatticeMesh& mesh);

/// A mesh of facets none of which has area bounds nothing: an octree of it would be white, and look like an answer.
/// Errors: not_a_solid. A mesh without triangles passes. Precondition: triangles name points.
Status check_some_have_area(const mesh::LatticeMesh& mesh);

}  // namespace octavo::classic
