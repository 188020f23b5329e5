// SPDX-License-Identifier: Apache-2.0
// The stages of a hexahedral mesh, each beside the peer that does it: p4est balances and numbers the same leaves.
//
//     octavo_hexmesh_peers [MESH]        a closed mesh; without it a generated one
//
// CPU seconds of the process, one thread, best of three; cell counts must agree or the program fails.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include <sys/resource.h>

#include "hexmesh_peer.hpp"
#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/number.hpp>
#include <octavo/io/read.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/octree/balance.hpp>

namespace {

using namespace octavo;

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double peak_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

template <class Work>
double best_of_three(const Work& work) {
    double best = 1e300;
    for (int run = 0; run < 3; ++run) {
        const double start = cpu_seconds();
        work();
        best = std::min(best, cpu_seconds() - start);
    }
    return best;
}

void print(int level, const char* stage, const char* who, double seconds, std::size_t cells) {
    std::printf("%5d  %-28s %-8s %8.3f s  %7.2f M cells/s\n", 1 << level, stage, who, seconds,
                static_cast<double>(cells) / seconds / 1e6);
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
    const Context one_thread{.threads = 1, .on_progress = {}};
    bool agree = true;
    for (const int level : {8, 9, 10}) {
        // The universe of a job is up to four times its content, so levels of the tree are counted by cell counts only.
        hexmesh::Options options{.level = level};
        for (const auto fractions : {hexmesh::Fractions::skip, hexmesh::Fractions::compute}) {
            options.fractions = fractions;
            std::size_t tree_cells = 0;
            double error = 0;
            const double seconds = best_of_three([&] {
                const Result<hexmesh::Built> built =
                    hexmesh::build(std::span(&solid, 1), options, one_thread);
                if (!built) std::exit((std::fprintf(stderr, "%s\n", built.error().describe().c_str()), 1));
                tree_cells = built->report.tree_cells;
                const hexmesh::SolidReport& report = built->report.solids[0];
                error = report.filled_volume / report.exact_volume - 1;
            });
            const bool computed = fractions == hexmesh::Fractions::compute;
            print(level, computed ? "whole mesh with fractions" : "whole mesh", "Octavo", seconds,
                  tree_cells);
            std::printf("       %zu cells, peak %.1f bytes a cell", tree_cells,
                        peak_bytes() / static_cast<double>(tree_cells));
            std::printf(computed ? ", volume off by %.1e\n" : "\n", error);
        }
        options.keep = hexmesh::Keep::all;
        options.fractions = hexmesh::Fractions::skip;
        options.balance = octree::Contact::corner;
        const Result<hexmesh::Built> built = hexmesh::build(std::span(&solid, 1), options, one_thread);
        if (!built) return EXIT_FAILURE;
        // The unbalanced tree: only the smallest cells, and what must be split for them.
        std::vector<octree::CellKey> leaves;
        const std::vector<octree::CellKey>& cells = built->mesh.cells;
        const int deepest = std::max_element(cells.begin(), cells.end(), [](auto a, auto b) {
                                return a.level() < b.level();
                            })->level();
        std::vector<octree::CellKey> fine;
        for (const octree::CellKey cell : cells)
            if (cell.level() == deepest && cell.child_index() == 0) fine.push_back(cell);
        leaves = bench::completed(fine);
        for (const auto contact : {octree::Contact::face, octree::Contact::edge, octree::Contact::corner}) {
            std::vector<octree::CellKey> balanced;
            const double seconds = best_of_three([&] { balanced = octree::balance(leaves, contact); });
            const char* const name = contact == octree::Contact::face   ? "balance by face"
                                     : contact == octree::Contact::edge ? "balance by edge"
                                                                        : "balance by corner";
            print(level, name, "Octavo", seconds, balanced.size());
            const double numbering =
                best_of_three([&] { static_cast<void>(hexmesh::number_nodes(balanced)); });
            print(level, "number nodes", "Octavo", numbering, balanced.size());
            if (const auto peer = bench::p4est_balance_and_number(leaves, contact)) {
                print(level, name, "p4est", peer->balance_seconds, peer->cells);
                if (peer->number_seconds > 0)
                    print(level, "number nodes", "p4est", peer->number_seconds, peer->cells);
                if (peer->cells != balanced.size()) {
                    std::printf("       DIFFERENT: Octavo %zu cells, p4est %zu\n", balanced.size(),
                                peer->cells);
                    agree = false;
                }
            }
        }
    }
    return agree ? EXIT_SUCCESS : EXIT_FAILURE;
}
