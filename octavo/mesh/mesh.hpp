// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octavo/base/vec3.hpp>
#include <octavo/exact/lattice.hpp>

// Triangle meshes, as they come in (double vertices) and as the kernel sees them (lattice points). Plain
// arrays: they are what files hold, what NumPy sees and what the caches like. Facets run counter-clockwise
// seen from outside.

namespace octavo::mesh {

using VertexIndex = std::uint32_t;
using FaceIndex = std::uint32_t;
using Triangle = std::array<VertexIndex, 3>;

/// Where an output facet came from.
struct Source {
    std::uint32_t operand = 0;  ///< index of the input solid
    FaceIndex face = 0;         ///< facet of that solid
    friend bool operator==(const Source&, const Source&) = default;
};

struct Mesh {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    std::vector<Source> sources;  ///< empty, or one per triangle

    Box3 bounds() const {
        Box3 box;
        for (const Vec3& vertex : vertices) box.add(vertex);
        return box;
    }
};

/// A mesh snapped to a lattice; facet i is facet i of the mesh it came from.
struct LatticeMesh {
    exact::Lattice lattice;
    std::vector<exact::Point> points;
    std::vector<Triangle> triangles;
};

/// Polygonal faces with any number of contours: contours of face f are [face_begin[f], face_begin[f + 1]),
/// corners of contour c are corners[contour_begin[c] .. contour_begin[c + 1]). The first contour is the outer
/// one.
struct PolygonMesh {
    std::vector<Vec3> vertices;
    std::vector<std::uint32_t> face_begin{0};
    std::vector<std::uint32_t> contour_begin{0};
    std::vector<VertexIndex> corners;
};

}  // namespace octavo::mesh
