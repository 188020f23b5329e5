// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include <octavo/classic/csg_build.hpp>
#include <octavo/octree/octree.hpp>

#include "csg_random.hpp"

// The comparison of the source: the classic method against the top-down one, on random scenes that fill space.
// Usage: octavo_csg_scene [MOST_PRIMITIVES [FIRST_DEPTH LAST_DEPTH]]. Prints a CSV table; one thread, CPU time,
// the least of three runs, or of as many more as fit into a fifth of a second: one of 2 ms is off by some per cent.

namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Row {
    double seconds = 0;
    octavo::classic::CsgBuildStats stats;
    octavo::octree::OctreeStats tree;
};

Row measure(const octavo::csg::Expr& scene, int depth, octavo::classic::CsgMethod method) {
    octavo::classic::CsgBuildOptions options;
    options.depth = depth;
    options.method = method;
    options.universe = octavo::Box3{{0, 0, 0}, {1, 1, 1}};
    octavo::Context context;
    context.threads = 1;
    Row row;
    double spent = 0;
    for (int run = 0; run < 3 || spent < 0.2; ++run) {
        const double start = cpu_seconds();
        octavo::Result<octavo::classic::CsgOctree> built = octavo::classic::build(scene, options, context);
        const double seconds = cpu_seconds() - start;
        if (!built) {
            std::fprintf(stderr, "%s\n", built.error().describe().c_str());
            std::exit(1);
        }
        spent += seconds;
        if (run == 0 || seconds < row.seconds) row.seconds = seconds;
        row.stats = built->stats;
        if (run == 0) row.tree = built->octree.stats();
    }
    return row;
}

void print(int primitives, int depth, const char* method, const Row& row) {
    const double octants = static_cast<double>(row.stats.octants);
    std::printf("%d,%d,%s,%.6f,%llu,%.2f,%.2f,%llu,%llu,%llu,%llu,%llu\n", primitives, depth, method,
                row.seconds, static_cast<unsigned long long>(row.stats.octants), octants / row.seconds / 1e6,
                static_cast<double>(row.stats.primitive_tests) / octants,
                static_cast<unsigned long long>(row.stats.peak_nodes),
                static_cast<unsigned long long>(row.stats.peak_bytes),
                static_cast<unsigned long long>(row.tree.white),
                static_cast<unsigned long long>(row.tree.black),
                static_cast<unsigned long long>(row.tree.gray));
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    const int most = argc > 1 ? std::atoi(argv[1]) : 100000;
    const int first_depth = argc > 2 ? std::atoi(argv[2]) : 6;
    const int last_depth = argc > 3 ? std::atoi(argv[3]) : 10;
    const bool classic = argc <= 4;
    std::printf(
        "primitives,depth,method,seconds,octants,million_octants_per_second,tests_per_octant,peak_nodes,"
        "peak_bytes,white,black,gray\n");
    for (int primitives = 10; primitives <= most; primitives *= 10) {
        const octavo::csg::Expr scene = octavo::bench::RandomScene(1).tree(primitives);
        for (int depth = first_depth; depth <= last_depth; ++depth) {
            print(primitives, depth, "top-down", measure(scene, depth, octavo::classic::CsgMethod::top_down));
            if (classic)
                print(primitives, depth, "classic",
                      measure(scene, depth, octavo::classic::CsgMethod::classic));
        }
    }
}
