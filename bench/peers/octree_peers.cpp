// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include <tbb/global_control.h>

#include <octavo/classic/from_mesh.hpp>
#include <octavo/io/read.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/octree/linear_octree.hpp>
#include <octavo/octree/oct_format.hpp>

#include "octree_peer.hpp"

// Mesh → octree with inside and outside, on one thread: Octavo against OpenVDB and CGAL, at the same cells of the same
// universe. Prints CPU time, peak memory and ratios as CSV, and whether the answers agree.
//
//     octavo_octree_peers MODEL [DEPTH=9] [RUNS=5] [peers=openvdb,cgal]

namespace octavo::bench {
namespace {

struct OctavoRun {
    classic::Built built;
    Usage usage;
};

/// The fastest of several runs, from double vertices to the finished octree: snapping, the test for closedness and
/// the descent. The first run tells the peak of memory.
OctavoRun run_octavo(const mesh::Mesh& mesh, int depth, int runs) {
    Context one_thread;
    one_thread.threads = 1;
    OctavoRun best;
    for (int run = 0; run < runs; ++run) {
        const Stopwatch watch;
        Result<classic::Built> built = classic::build(mesh, {.depth = depth}, one_thread);
        const Usage usage = watch.stop();
        if (!built) {
            std::fprintf(stderr, "%s\n", built.error().describe().c_str());
            std::exit(1);
        }
        const double peak = run == 0 ? usage.megabytes : best.usage.megabytes;
        if (run == 0 || usage.seconds < best.usage.seconds) best = {std::move(*built), usage};
        best.usage.megabytes = peak;
    }
    return best;
}

/// The mesh in units of cells, and a sample of decided cells.
OctreeJob make_job(const mesh::Mesh& mesh, const octree::Octree& octree, int depth) {
    const mesh::LatticeMesh snapped = mesh::snap(mesh)->mesh;
    OctreeJob job;
    job.depth = depth;
    const double side = octree::cell_side(depth);
    for (const exact::Point& p : snapped.points) job.vertices.push_back({p.x / side, p.y / side, p.z / side});
    job.triangles = snapped.triangles;

    // Half of the sample lies near the surface: cells beside gray ones are of the last levels.
    std::mt19937_64 random(1);
    const std::uint32_t shift = static_cast<std::uint32_t>(octree::max_level - depth) + 5;
    const octree::LinearOctree leaves = *octree::LinearOctree::from(octree);
    while (job.sample.size() < 200000) {
        const auto leaf = static_cast<octree::LeafIndex>(random() % leaves.size());
        if (leaves.color(leaf) == octree::Color::gray) continue;
        exact::Point p = leaves.key(leaf).low();
        const auto within = static_cast<std::uint64_t>(leaves.key(leaf).side());
        p.x += static_cast<std::int32_t>(random() % within);
        p.y += static_cast<std::int32_t>(random() % within);
        p.z += static_cast<std::int32_t>(random() % within);
        job.sample.push_back({static_cast<std::uint32_t>(p.x) >> shift,
                              static_cast<std::uint32_t>(p.y) >> shift,
                              static_cast<std::uint32_t>(p.z) >> shift});
    }
    return job;
}

std::vector<bool> octavo_inside(const OctreeJob& job, const octree::Octree& octree) {
    const octree::LinearOctree leaves = *octree::LinearOctree::from(octree);
    const std::int32_t side = octree::cell_side(job.depth);
    std::vector<bool> inside;
    for (const auto& cell : job.sample) {
        const exact::Point p{static_cast<std::int32_t>(cell[0]) * side,
                             static_cast<std::int32_t>(cell[1]) * side,
                             static_cast<std::int32_t>(cell[2]) * side};
        inside.push_back(leaves.color(leaves.locate(p)) == octree::Color::black);
    }
    return inside;
}

void print(const OctreeAnswer& answer, const OctavoRun& octavo, const std::vector<bool>& inside) {
    std::size_t differ = 0;
    for (std::size_t i = 0; i < inside.size(); ++i) differ += inside[i] != answer.inside[i];
    std::printf("%s,%s,%.4f,%.2f,%.1f,%llu,%.0f,%zu of %zu\n", answer.system.c_str(), answer.what.c_str(),
                answer.usage.seconds, answer.usage.seconds / octavo.usage.seconds, answer.usage.megabytes,
                static_cast<unsigned long long>(answer.leaves), answer.inside_volume, differ, inside.size());
}

int compare(const std::string& model, int depth, int runs, const std::string& peers) {
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const Result<io::ReadMesh> read = io::read_mesh(model);
    if (!read) {
        std::fprintf(stderr, "%s\n", read.error().describe().c_str());
        return 1;
    }
    const OctavoRun octavo = run_octavo(read->mesh, depth, runs);
    const octree::OctreeStats stats = octavo.built.octree.stats();
    const double cell = static_cast<double>(octree::cell_volume(depth));
    const double leaves = static_cast<double>(stats.leaves());
    const std::size_t bytes = octree::encode(octavo.built.octree).size();
    const Vec3 extents = read->mesh.bounds().extents();
    const double unit = octavo.built.octree.lattice().unit() * octree::cell_side(depth);

    std::printf("# %s: %zu triangles, depth %d, content %.0f x %.0f x %.0f cells, one thread, CPU seconds\n",
                model.c_str(), read->mesh.triangles.size(), depth, extents.x / unit, extents.y / unit,
                extents.z / unit);
    std::printf(
        "# Octavo: %llu nodes, .oct %zu bytes (%.3f a node), peak %.1f bytes a leaf, %.1f M facet-cell "
        "pairs\n",
        static_cast<unsigned long long>(stats.nodes()), bytes,
        static_cast<double>(bytes) / static_cast<double>(stats.nodes()),
        octavo.usage.megabytes * 1048576 / leaves,
        static_cast<double>(octavo.built.report.primitive_tests) / 1e6);
    std::printf("system,what,cpu_s,times_octavo,peak_mb,leaves_or_voxels,inside_cells,centres_that_differ\n");
    std::printf("Octavo,classic::build from double vertices,%.4f,1.00,%.1f,%llu,%.0f to %.0f,\n",
                octavo.usage.seconds, octavo.usage.megabytes, static_cast<unsigned long long>(stats.leaves()),
                static_cast<double>(stats.black_volume) / cell,
                static_cast<double>(stats.black_volume + stats.gray_volume) / cell);
    const OctreeJob job = make_job(read->mesh, octavo.built.octree, depth);
    const std::vector<bool> inside = octavo_inside(job, octavo.built.octree);
#ifdef OCTAVO_WITH_OPENVDB
    if (peers.find("openvdb") != std::string::npos) print(run_openvdb(job), octavo, inside);
#else
    std::printf("# OpenVDB was not installed when this program was built\n");
#endif
#ifdef OCTAVO_WITH_CGAL
    if (peers.find("cgal") != std::string::npos) print(run_cgal(job), octavo, inside);
#else
    std::printf("# CGAL was not installed when this program was built\n");
#endif
    return 0;
}

}  // namespace
}  // namespace octavo::bench

int main(int count, char** words) {
    if (count < 2) {
        std::fprintf(stderr, "usage: octavo_octree_peers MODEL [DEPTH=9] [RUNS=5] [PEERS=openvdb,cgal]\n");
        return 2;
    }
    return octavo::bench::compare(words[1], count > 2 ? std::atoi(words[2]) : 9,
                                  count > 3 ? std::atoi(words[3]) : 5, count > 4 ? words[4] : "openvdb,cgal");
}
