// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include <octavo/exact/plane.hpp>
#include <octavo/mesh/mesh.hpp>

// What two facets of a surface have in common beyond the vertices and edges that they share by index: decided
// by integer orientation signs alone.
//
// Planes first: facets on one side of each other's plane meet at most where they touch it. When each has
// corners strictly on both sides of the other's plane, both cut the common line in an interval, and two
// orientations order the four ends (P. Guigue, O. Devillers, "Fast and robust triangle–triangle overlap test
// using orientation predicates", 2003). We go beyond their yes or no: the kind of contact is told, and shared
// vertices and edges are taken out of it.
//
// Bit budget: orientations of lattice points, 81 bits (octavo/exact/orient.hpp).

namespace octavo::mesh {

enum class FacetContact : std::uint8_t {
    none,         ///< nothing beyond shared vertices and edges
    touching,     ///< points or segments on the boundary of at least one of them
    penetrating,  ///< the interiors cross in a segment, though no edge runs through an interior
    crossing,     ///< an edge of one runs strictly through the interior of the other
    overlapping,  ///< they lie in one plane and have area in common
};

/// A facet with its plane at hand. Facets without area have a degenerate plane.
struct Facet {
    std::array<exact::Point, 3> points;
    Triangle vertices;
    exact::Plane plane;

    Facet() = default;
    Facet(const Triangle& triangle, const exact::Point* all_points)
        : points{all_points[triangle[0]], all_points[triangle[1]], all_points[triangle[2]]},
          vertices(triangle),
          plane(exact::Plane::through(points[0], points[1], points[2])) {}
};

/// How many vertices the two have in common.
inline int shared_vertices(const Triangle& a, const Triangle& b) {
    int shared = 0;
    for (const VertexIndex v : a) shared += (v == b[0]) + (v == b[1]) + (v == b[2]);
    return shared;
}

/// The contact of two facets with different corners each. Equal points must have equal indices. Facets without
/// area can cross others with their edges; any other contact of theirs counts as none. Facets that share all
/// three vertices are duplicates: none.
FacetContact contact(const Facet& a, const Facet& b);

/// The same for facets that both start with the one vertex that they share.
FacetContact contact_at_first_corner(const Facet& a, const Facet& b);

}  // namespace octavo::mesh
