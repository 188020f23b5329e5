// SPDX-License-Identifier: Apache-2.0
#include <openvdb/openvdb.h>
#include <openvdb/tools/LevelSetUtil.h>
#include <openvdb/tools/MeshToVolume.h>

#include "octree_peer.hpp"

// meshToLevelSet with its default band of three voxels: a signed distance in the band and the sign everywhere, which
// is what colouring is. Voxel i has its centre at cell i's centre.

namespace octavo::bench {

OctreeAnswer run_openvdb(const OctreeJob& job) {
    openvdb::initialize();
    std::vector<openvdb::Vec3s> points;
    std::vector<openvdb::Vec3I> triangles;
    for (const auto& v : job.vertices) points.emplace_back(v[0] - 0.5, v[1] - 0.5, v[2] - 0.5);
    for (const auto& t : job.triangles) triangles.emplace_back(t[0], t[1], t[2]);
    const auto transform = openvdb::math::Transform::createLinearTransform(1.0);

    OctreeAnswer answer;
    answer.system = std::string("OpenVDB ") + openvdb::getLibraryAbiVersionString();
    answer.what = "meshToLevelSet, half-width 3";
    const Stopwatch watch;
    const auto grid = openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(*transform, points, triangles, 3.0f);
    answer.usage = watch.stop();
    answer.leaves = grid->activeVoxelCount();
    answer.inside_volume = static_cast<double>(openvdb::tools::sdfInteriorMask(*grid)->activeVoxelCount());
    auto accessor = grid->getConstAccessor();
    for (const auto& cell : job.sample)
        answer.inside.push_back(
            accessor.getValue(openvdb::Coord(static_cast<int>(cell[0]), static_cast<int>(cell[1]),
                                             static_cast<int>(cell[2]))) < 0);
    return answer;
}

}  // namespace octavo::bench
