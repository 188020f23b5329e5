// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>

#include <octavo/classic/csg_build.hpp>
#include <octavo/io/openscad_csg.hpp>

// Octrees of real .csg files, by both methods. Usage: octavo_csg_models_scene DEPTH METHOD FILE... with METHOD
// top-down, classic or both. Prints a CSV table; one thread, CPU time of one run.

namespace {

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void measure(const octavo::io::CsgFile& file, const std::string& name, int depth, double read_seconds,
             octavo::classic::CsgMethod method) {
    octavo::classic::CsgBuildOptions options;
    options.depth = depth;
    options.method = method;
    octavo::Context context;
    context.threads = 1;
    const double start = cpu_seconds();
    const octavo::Result<octavo::classic::CsgOctree> built =
        octavo::classic::build(file.expression, options, context);
    const double seconds = cpu_seconds() - start;
    if (!built) {
        std::printf("%s,%d,error: %s\n", name.c_str(), depth, built.error().describe().c_str());
        return;
    }
    const octavo::octree::OctreeStats tree = built->octree.stats();
    const octavo::exact::Lattice& lattice = built->octree.lattice();
    const double lower = octavo::octree::world_volume(lattice, tree.black_volume);
    const double upper = octavo::octree::world_volume(lattice, tree.black_volume + tree.gray_volume);
    const char* const method_name = method == octavo::classic::CsgMethod::classic ? "classic" : "top-down";
    std::printf(
        "%s,%d,%s,%.4f,%.4f,%llu,%llu,%.3f,%llu,%llu,%.9g,%.9g\n", name.c_str(), depth, method_name,
        read_seconds, seconds, static_cast<unsigned long long>(built->stats.primitives),
        static_cast<unsigned long long>(built->stats.octants),
        static_cast<double>(built->stats.primitive_tests) / static_cast<double>(built->stats.octants + 1),
        static_cast<unsigned long long>(built->stats.peak_nodes),
        static_cast<unsigned long long>(built->stats.resolved), lower, upper);
    std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 4) {
        std::fprintf(stderr, "usage: octavo_csg_models_scene DEPTH top-down|classic|both FILE...\n");
        return 2;
    }
    const int depth = std::atoi(argv[1]);
    const std::string method = argv[2];
    std::printf(
        "model,depth,method,read_seconds,build_seconds,primitives,octants,tests_per_octant,peak_nodes,"
        "resolved,"
        "lower_volume,upper_volume\n");
    for (int i = 3; i < argc; ++i) {
        const std::string name = std::filesystem::path(argv[i]).stem().string();
        octavo::io::CsgReadOptions options;
        options.faceted = true;
        options.skip_unsupported = true;  // as OpenSCAD does, which leaves open polyhedra out
        const double start = cpu_seconds();
        const octavo::Result<octavo::io::CsgFile> file = octavo::io::read_csg(argv[i], options);
        const double seconds = cpu_seconds() - start;
        if (!file) {
            std::printf("%s,%d,error: %s\n", name.c_str(), depth, file.error().describe().c_str());
            std::fflush(stdout);
            continue;
        }
        if (method != "classic") measure(*file, name, depth, seconds, octavo::classic::CsgMethod::top_down);
        if (method != "top-down") measure(*file, name, depth, seconds, octavo::classic::CsgMethod::classic);
    }
}
