// SPDX-License-Identifier: Apache-2.0
// Hexahedral meshes beside the peers of each stage: p4est balances the same leaves and numbers their nodes; OpenVDB
// tells inside from outside on a grid of the same cells.
//
//     octavo_hexmesh_peers [MESH [LEVEL…]]        a closed mesh; without it a generated one; levels 8, 9 and 10
//
// CPU seconds of the process, one thread, the best of three of Octavo and one run of each peer, as CSV; the last column
// is how many times as long as Octavo the system takes for the same. Peak memory of Octavo is that of a process that
// does nothing else. Cell counts under balance must agree or the program fails.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/number.hpp>
#include <octavo/io/read.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/octree/balance.hpp>
#include <octavo/octree/complete.hpp>

#include "hexmesh_peer.hpp"
#include "measured_at.hpp"
#include "octree_peer.hpp"
#include "peer_clock.hpp"

namespace {

using namespace octavo;
using bench::Usage;

/// Peak memory of `work` in a process of its own: in this one, pages that earlier work left would count. Ask before
/// this process does such work, for the other inherits its heap.
template <class Work>
double peak_megabytes(const Work& work) {
    std::array<int, 2> ends{};
    if (pipe(ends.data()) != 0) return 0;
    const pid_t child = fork();
    if (child == 0) {
        const bench::Stopwatch watch;
        work();
        const double megabytes = watch.stop().megabytes;
        _exit(write(ends[1], &megabytes, sizeof megabytes) == sizeof megabytes ? EXIT_SUCCESS : EXIT_FAILURE);
    }
    close(ends[1]);
    double megabytes = 0;
    if (child < 0 || read(ends[0], &megabytes, sizeof megabytes) != sizeof megabytes) megabytes = 0;
    close(ends[0]);
    if (child > 0) waitpid(child, nullptr, 0);
    return megabytes;
}

template <class Work>
Usage best_of_three(const Work& work, double megabytes = -1) {
    Usage best{1e300, megabytes >= 0 ? megabytes : peak_megabytes(work)};
    for (int run = 0; run < 3; ++run) {
        const bench::Stopwatch watch;
        work();
        best.seconds = std::min(best.seconds, watch.stop().seconds);
    }
    return best;
}

/// `octavo` is the time to compare with; 0 for Octavo itself.
void print(int level, const char* stage, const char* who, const Usage& usage, std::size_t cells,
           double octavo = 0) {
    const auto count = static_cast<double>(cells);
    std::printf("%d,%s,%s,%.3f,%zu,%.2f,", 1 << level, stage, who, usage.seconds, cells,
                count / usage.seconds / 1e6);
    if (usage.megabytes > 0) std::printf("%.1f", usage.megabytes * 1048576 / count);
    std::printf(",%.2f\n", octavo > 0 ? usage.seconds / octavo : 1.0);
    std::fflush(stdout);
}

hexmesh::Built built_or_exit(const mesh::Mesh& solid, const hexmesh::Options& options) {
    Context one_thread;
    one_thread.threads = 1;
    Result<hexmesh::Built> built = hexmesh::build(std::span(&solid, 1), options, one_thread);
    if (built) return std::move(*built);
    std::fprintf(stderr, "%s\n", built.error().describe().c_str());
    std::exit(EXIT_FAILURE);
}

/// The whole mesh, without and with the parts of boundary cells. Returns the seconds without.
double measure_meshes(const mesh::Mesh& solid, int level) {
    hexmesh::Options options{.level = level};
    double without = 0;
    constexpr std::array kinds{hexmesh::Fractions::skip, hexmesh::Fractions::compute};
    std::array<double, 2> peaks{};
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        options.fractions = kinds[i];
        peaks[i] = peak_megabytes([&] { built_or_exit(solid, options); });
    }
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        options.fractions = kinds[i];
        hexmesh::Report report;
        const Usage usage = best_of_three([&] { report = built_or_exit(solid, options).report; }, peaks[i]);
        const bool computed = kinds[i] == hexmesh::Fractions::compute;
        print(level, computed ? "mesh with fractions" : "mesh", "Octavo", usage, report.tree_cells);
        if (!computed) without = usage.seconds;
        if (computed)
            std::printf("# relative error of the filled volume: %.1e\n",
                        report.solids[0].filled_volume / report.solids[0].exact_volume - 1);
    }
    return without;
}

/// The coarsest tree with the smallest cells of a mesh: what its refinement was before balance, as peers are given it.
std::vector<octree::CellKey> unbalanced_leaves(const mesh::Mesh& solid, int level) {
    const hexmesh::Built built = built_or_exit(
        solid, {.level = level, .keep = hexmesh::Keep::all, .fractions = hexmesh::Fractions::skip});
    const std::vector<octree::CellKey>& cells = built.mesh.cells;
    const int deepest = std::max_element(cells.begin(), cells.end(), [](auto a, auto b) {
                            return a.level() < b.level();
                        })->level();
    std::vector<octree::CellKey> fine;
    for (const octree::CellKey cell : cells)
        if (cell.level() == deepest && cell.child_index() == 0) fine.push_back(cell);
    return octree::complete(fine);
}

/// False when counts differ.
bool measure_balance_and_nodes(const std::vector<octree::CellKey>& leaves, int level) {
    bool agree = true;
    for (const auto& [contact, name] : {std::pair(octree::Contact::face, "balance by face"),
                                        std::pair(octree::Contact::edge, "balance by edge"),
                                        std::pair(octree::Contact::corner, "balance by corner")}) {
        std::vector<octree::CellKey> balanced;
        const Usage balancing = best_of_three([&] { balanced = octree::balance(leaves, contact); });
        print(level, name, "Octavo", balancing, balanced.size());
        const Usage numbering = best_of_three([&] { static_cast<void>(hexmesh::number_nodes(balanced)); });
        print(level, "number nodes", "Octavo", numbering, balanced.size());
        const auto peer = bench::p4est_balance_and_number(leaves, contact);
        if (!peer) continue;
        print(level, name, "p4est", {peer->balance_seconds, 0}, peer->cells, balancing.seconds);
        if (peer->number_seconds > 0)
            print(level, "number nodes", "p4est", {peer->number_seconds, 0}, peer->cells, numbering.seconds);
        if (peer->cells == balanced.size()) continue;
        std::printf("# DIFFERENT: Octavo %zu cells, p4est %zu\n", balanced.size(), peer->cells);
        agree = false;
    }
    return agree;
}

/// A signed distance in a band and the sign everywhere, on cells of the side that the mesh has at the surface.
void measure_openvdb([[maybe_unused]] const mesh::Mesh& solid, [[maybe_unused]] int level,
                     [[maybe_unused]] double octavo_seconds) {
#ifdef OCTAVO_WITH_OPENVDB
    const double side =
        built_or_exit(solid, {.level = level, .fractions = hexmesh::Fractions::skip}).report.smallest_cell;
    const Box3 bounds = solid.bounds();
    bench::OctreeJob job;
    for (const Vec3& v : solid.vertices) {
        const Vec3 p = (1 / side) * (v - bounds.low);
        job.vertices.push_back({p.x, p.y, p.z});
    }
    for (const mesh::Triangle& t : solid.triangles) job.triangles.push_back({t[0], t[1], t[2]});
    const bench::OctreeAnswer answer = bench::run_openvdb(job);
    print(level, "level set of half-width 3", "OpenVDB", answer.usage, answer.leaves, octavo_seconds);
#endif
}

}  // namespace

int main(int argc, char** argv) {
    mesh::Mesh solid = mesh::displaced_sphere(70);
    if (argc > 1) {
        Result<io::ReadMesh> read = io::read_mesh(argv[1]);
        if (!read) {
            std::fprintf(stderr, "%s\n", read.error().describe().c_str());
            return EXIT_FAILURE;
        }
        solid = std::move(read->mesh);
    }
    std::vector<int> levels{8, 9, 10};
    if (argc > 2) {
        levels.clear();
        for (int i = 2; i < argc; ++i) levels.push_back(std::atoi(argv[i]));
    }
    bool agree = true;
    std::printf("# %s\n", bench::measured_at(OCTAVO_SOURCES).c_str());
    std::printf("# %s: %zu triangles, one thread, CPU seconds; cells of the octree, those outside included\n",
                argc > 1 ? argv[1] : "generated", solid.triangles.size());
    std::printf("resolution,stage,system,cpu_s,cells,million_cells_per_s,peak_bytes_per_cell,times_octavo\n");
    for (const int level : levels) {
        const double seconds = measure_meshes(solid, level);
        agree = measure_balance_and_nodes(unbalanced_leaves(solid, level), level) && agree;
        measure_openvdb(solid, level, seconds);
    }
    return agree ? EXIT_SUCCESS : EXIT_FAILURE;
}
