// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

#include <gtest/gtest.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/mesh/mesh.hpp>

// What several tests make solids of, and what holds for the mesh of any solid.

namespace octavo::hexmesh {

inline mesh::Mesh moved(mesh::Mesh mesh, Vec3 by) {
    for (Vec3& vertex : mesh.vertices) vertex = vertex + by;
    return mesh;
}

inline mesh::Mesh reversed(mesh::Mesh mesh) {
    for (mesh::Triangle& t : mesh.triangles) std::swap(t[0], t[1]);
    return mesh;
}

inline mesh::Mesh joined(mesh::Mesh a, const mesh::Mesh& b) {
    const auto offset = static_cast<mesh::VertexIndex>(a.vertices.size());
    a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
    for (const mesh::Triangle& t : b.triangles)
        a.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
    return a;
}

inline void expect_exact_volumes(const Built& built) {
    for (const SolidReport& solid : built.report.solids)
        EXPECT_NEAR(solid.filled_volume / solid.exact_volume, 1, 1e-9);
}

}  // namespace octavo::hexmesh
