// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <gtest/gtest.h>

#include <octavo/bsp_octree/build.hpp>
#include <octavo/bsp_octree/to_mesh.hpp>
#include <octavo/mesh/measure.hpp>

#include "boolean/solids.hpp"

// Solids for the tests of BSP-octrees, on one lattice with room for all of them, and what is always true of one.

namespace octavo::tests {

/// A lattice whose points are the multiples of 2^-`bits` in about [-64, 64]^3.
inline exact::Lattice small_lattice(int bits = 4) {
    const std::int64_t origin = -(std::int64_t{1} << 25);
    return *exact::Lattice::from_parts(-bits, {origin, origin, origin});
}

inline bsp_octree::BspOctree octree_of(const mesh::Mesh& mesh, const bsp_octree::MeshOptions& options = {},
                                       const exact::Lattice& lattice = small_lattice()) {
    Result<bsp_octree::Built> built = bsp_octree::build(mesh, lattice, options);
    EXPECT_TRUE(built) << (built ? "" : built.error().describe());
    return built ? built->octree : bsp_octree::BspOctree(lattice);
}

/// Options with leaves so small that even small solids are split.
inline bsp_octree::MeshOptions fine(std::uint32_t planes) {
    bsp_octree::MeshOptions options;
    options.octree.planes = planes;
    return options;
}

/// Several meshes as one operand.
inline mesh::Mesh joined(const std::vector<mesh::Mesh>& parts) {
    mesh::Mesh all;
    for (const mesh::Mesh& part : parts) {
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
        all.vertices.insert(all.vertices.end(), part.vertices.begin(), part.vertices.end());
        for (const mesh::Triangle& t : part.triangles)
            all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return all;
}

/// Mesh and tree agree on the volume, and the mesh is a manifold.
inline void expect_solid(const bsp_octree::BspOctree& octree, double volume, const std::string& what) {
    const Result<bsp_octree::ToMesh> mesh = bsp_octree::to_mesh(octree);
    ASSERT_TRUE(mesh) << what << ": " << mesh.error().describe();
    EXPECT_EQ(manifold_defect(mesh->mesh), "") << what;
    EXPECT_NEAR(volume_of(mesh->mesh), volume, 1e-9 * (1 + volume)) << what;
    EXPECT_NEAR(bsp_octree::measure(octree).volume, volume, 1e-9 * (1 + volume)) << what;
}

/// Both are the same set of points, exactly: neither has anything that the other has not.
inline void expect_same(const bsp_octree::BspOctree& first, const bsp_octree::BspOctree& second,
                        const std::string& what) {
    EXPECT_TRUE(first.subtract(second)->is_empty()) << what;
    EXPECT_TRUE(second.subtract(first)->is_empty()) << what;
}

}  // namespace octavo::tests
