// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>
#include <string>

#include <octavo/bp_octree/bpo_format.hpp>
#include <octavo/bp_octree/build.hpp>
#include <octavo/bp_octree/certify.hpp>
#include <octavo/io/read.hpp>
#include <octavo/mesh/snap.hpp>

#include "../peers/peer_clock.hpp"
#include "../wavy_sphere.hpp"

// The BP-octree of a model: time and memory of building it, and of each level its planes, its volume as a percentage
// of the solid's, and the bytes of the file up to it.
//   octavo_bp_octree_scene MODEL|sphere:LEVEL [greedy|k-medoids] [normal|fast] [THREADS] [DEPTH]

namespace octavo::bench {
namespace {

mesh::Mesh model(const std::string& name) {
    if (name.rfind("sphere:", 0) == 0) return wavy_sphere(std::atoi(name.c_str() + 7));
    auto read = io::read_mesh(name);
    if (read) return std::move(read->mesh);
    std::fprintf(stderr, "%s\n", read.error().describe().c_str());
    std::exit(1);
}

int measure(int argc, char** argv) {
    if (argc < 2) {
        std::fprintf(stderr,
                     "usage: %s MODEL|sphere:LEVEL [greedy|k-medoids] [normal|fast] [THREADS] [DEPTH]\n",
                     argv[0]);
        return 2;
    }
    const auto snapped = mesh::snap(model(argv[1]));
    if (!snapped) return 1;
    const mesh::LatticeMesh& mesh = snapped->mesh;
    bp_octree::BuildOptions options;
    if (argc > 2 && std::string(argv[2]) == "k-medoids") options.planes = bp_octree::PlaneChoice::k_medoids;
    if (argc > 3 && std::string(argv[3]) == "fast") options.quality = bp_octree::Quality::fast;
    Context context;
    context.threads = argc > 4 ? std::atoi(argv[4]) : 1;
    if (argc > 5) options.depth = std::atoi(argv[5]);

    const Stopwatch building;
    const auto tree = bp_octree::build(mesh, options, context);
    const Usage build = building.stop();
    if (!tree) {
        std::fprintf(stderr, "%s\n", tree.error().describe().c_str());
        return 1;
    }
    const Stopwatch certifying;
    const bool certified = bp_octree::certify(*tree, context).has_value();
    const Usage certify = certifying.stop();
    const Stopwatch encoding;
    const std::vector<std::uint8_t> bytes = bp_octree::encode(*tree);
    const Usage encode = encoding.stop();
    const Stopwatch decoding;
    const bool decoded = bp_octree::decode(bytes, {}, context).has_value();
    const Usage decode = decoding.stop();
    const auto to_level = bp_octree::bytes_to_level(bytes);

    const double triangles = static_cast<double>(mesh.triangles.size());
    std::printf("# %s, %zu triangles, %s, %s\n", argv[1], mesh.triangles.size(),
                argc > 2 ? argv[2] : "greedy", argc > 3 ? argv[3] : "normal");
    std::printf("# build %.3f s CPU, %.0f triangles/s, peak %.0f bytes a triangle; certified: %s (%.3f s)\n",
                build.seconds, triangles / build.seconds, build.megabytes * 1048576 / triangles,
                certified ? "yes" : "NO", certify.seconds);
    std::printf("# file %zu bytes, %.2f a triangle; encode %.3f s; decode %.3f s: %s\n", bytes.size(),
                static_cast<double>(bytes.size()) / triangles, encode.seconds, decode.seconds,
                decoded ? "well" : "BADLY");
    std::printf("level,split,gray,white,black,planes,volume_percent,bytes_to_level,bytes_a_triangle\n");
    for (std::size_t level = 0; level < tree->levels.size(); ++level) {
        const bp_octree::LevelFigures& figures = tree->levels[level];
        const double to = static_cast<double>((*to_level)[level]);
        std::printf(
            "%zu,%llu,%llu,%llu,%llu,%llu,%.3f,%.0f,%.4f\n", level,
            static_cast<unsigned long long>(figures.split), static_cast<unsigned long long>(figures.gray),
            static_cast<unsigned long long>(figures.white), static_cast<unsigned long long>(figures.black),
            static_cast<unsigned long long>(figures.planes), 100 * figures.volume / tree->solid_volume, to,
            to / triangles);
    }
    return 0;
}

}  // namespace
}  // namespace octavo::bench

int main(int argc, char** argv) { return octavo::bench::measure(argc, argv); }
