// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <random>
#include <string>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/bsp_octree/build.hpp>
#include <octavo/bsp_octree/to_mesh.hpp>
#include <octavo/io/read.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/transform.hpp>
#include <octavo/render/hidden_parts.hpp>

#include "../peers/measured_at.hpp"
#include "../peers/peer_clock.hpp"

// The BSP-octree of a model: building, file, points, going back to a mesh, a difference beside boolean/, a drawing.
//   octavo_bsp_octree_scene [--repeat N] [--build-only] MODEL|sphere:FREQUENCY...
// One CSV row a model; CPU seconds of one thread, the least of N runs. With --build-only only the tree and its file.
// The difference is with a copy of the model, turned 30° about z and moved by a fifth of its longest side, on one
// lattice. A sphere is rough and has 20 FREQUENCY² triangles.

namespace octavo::bench {
namespace {

mesh::Mesh model(const std::string& name) {
    if (name.rfind("sphere:", 0) == 0)
        return mesh::displaced_sphere(static_cast<std::uint32_t>(std::atoi(name.c_str() + 7)));
    auto read = io::read_mesh(name);
    if (read) return std::move(read->mesh);
    std::fprintf(stderr, "%s\n", read.error().describe().c_str());
    std::exit(1);
}

template <class T>
T or_exit(Result<T> result, const std::string& name) {
    if (result) return std::move(*result);
    std::fprintf(stderr, "%s: %s\n", name.c_str(), result.error().describe().c_str());
    std::exit(1);
}

/// The least CPU time of some runs; what the last one made is in `kept`.
template <class Work, class T>
double least(int repeat, const Work& work, T& kept) {
    double best = 0;
    for (int run = 0; run < repeat; ++run) {
        const double start = cpu_seconds();
        T made = work();
        const double seconds = cpu_seconds() - start;
        best = run == 0 ? seconds : std::min(best, seconds);
        kept = std::move(made);
    }
    return best;
}

double points_per_second(const bsp_octree::BspOctree& solid, const Box3& box, int repeat) {
    std::mt19937_64 random(1);
    std::vector<Vec3> points(100'000);
    for (Vec3& p : points)
        for (int axis = 0; axis < 3; ++axis)
            p[axis] = std::uniform_real_distribution<double>(box.low[axis], box.high[axis])(random);
    int inside = 0;
    const double seconds = least(
        repeat,
        [&] {
            return std::count_if(points.begin(), points.end(),
                                 [&](Vec3 p) { return solid.classify(p) == bsp::Position::in; });
        },
        inside);
    return static_cast<double>(points.size()) / seconds;
}

double drawing_seconds(const bsp_octree::BspOctree& solid, const mesh::Mesh& mesh, int repeat,
                       std::size_t& areas) {
    const render::Scene scene = render::scene_of(mesh);
    const auto camera = render::Camera::look_at(scene.corners(), {}, 1200, 900);
    if (!camera) return 0;
    render::Drawing drawing;
    const double seconds = least(
        repeat,
        [&] {
            const auto patches = or_exit(render::patches_of(solid, *camera), "patches");
            return or_exit(render::remove_hidden_parts(patches, scene.lines, *camera, {}), "drawing");
        },
        drawing);
    areas = drawing.regions.size();
    return seconds;
}

/// The solid and its copy, turned and moved, on one lattice.
struct Pair {
    mesh::Mesh mesh, other;
    exact::Lattice lattice;
};

Pair pair_of(const std::string& name) {
    Pair pair;
    pair.mesh = model(name);
    const Vec3 extents = pair.mesh.bounds().extents();
    const double by = 0.2 * std::max({extents.x, extents.y, extents.z});
    pair.other =
        mesh::transform(pair.mesh, compose(mesh::translation({by, 0, 0}), mesh::rotation({0, 0, 1}, 30)));
    Box3 bounds = pair.mesh.bounds();
    bounds.add(pair.other.bounds());
    pair.lattice = or_exit(exact::Lattice::fit(bounds), name);
    return pair;
}

/// Prints what building and keeping the tree takes; none when the model is no solid.
std::optional<bsp_octree::Built> measure_tree(const std::string& name, const Pair& pair, int repeat) {
    bsp_octree::MeshOptions trusting;
    trusting.surface = bsp_octree::SurfaceCheck::trust;
    const auto first = bsp_octree::build(pair.mesh, pair.lattice);
    if (!first) {
        std::fprintf(stderr, "%s: %s\n", name.c_str(), first.error().describe().c_str());
        return {};
    }
    const auto build = [&](const bsp_octree::MeshOptions& options) {
        return or_exit(bsp_octree::build(pair.mesh, pair.lattice, options), name);
    };
    bsp_octree::Built built;
    const double checked_s = least(
        repeat, [&] { return build({}); }, built);
    const bool resolved = built.report.resolved;
    // A surface that meets itself cannot be trusted.
    const double build_s = resolved ? checked_s
                                    : least(
                                          repeat, [&] { return build(trusting); }, built);
    std::vector<std::uint8_t> bytes;
    const double encode_s = least(
        repeat, [&] { return bsp_octree::encode(built.octree); }, bytes);
    bsp_octree::BspOctree decoded;
    const double decode_s = least(
        repeat, [&] { return or_exit(bsp_octree::decode(bytes), name); }, decoded);
    const bsp_octree::Stats stats = built.octree.stats();
    const double triangles = static_cast<double>(pair.mesh.triangles.size());
    const auto ply = or_exit(io::write_mesh(pair.mesh, {.format = "ply"}), name);
    std::printf(
        "%s,%zu,%.4f,%.0f,%.4f,%.0f,%s,%llu,%llu,%.1f,%zu,%.3f,%.4f,%.4f,",
        name.substr(name.rfind('/') + 1).c_str(), pair.mesh.triangles.size(), build_s, triangles / build_s,
        checked_s, triangles / checked_s, resolved ? "yes" : "no",
        static_cast<unsigned long long>(stats.bsp_nodes), static_cast<unsigned long long>(stats.largest_tree),
        static_cast<double>(stats.bytes) / triangles, bytes.size(),
        static_cast<double>(bytes.size()) / static_cast<double>(ply.bytes.size()), encode_s, decode_s);
    return built;
}

/// Prints what doing things with the tree takes.
void measure_use(const std::string& name, const Pair& pair, const bsp_octree::Built& built, int repeat) {
    bsp_octree::ToMesh back;
    const double to_mesh_s = least(
        repeat, [&] { return or_exit(bsp_octree::to_mesh(built.octree), name); }, back);
    const double points = points_per_second(built.octree, pair.mesh.bounds(), repeat);
    const bsp_octree::Built second = or_exit(bsp_octree::build(pair.other, pair.lattice), name);
    bsp_octree::BspOctree difference;
    const double difference_s = least(
        repeat, [&] { return or_exit(built.octree.subtract(second.octree), name); }, difference);
    boolean::Evaluated evaluated;
    const mesh::Mesh both[] = {pair.mesh, pair.other};
    const double boolean_s = least(
        repeat, [&] { return or_exit(boolean::subtract(both), name); }, evaluated);
    const double volume = bsp_octree::measure(difference).volume,
                 expected = mesh::moments(evaluated.mesh).volume;
    std::size_t areas = 0;
    const double draw_s = drawing_seconds(built.octree, back.mesh, repeat, areas);
    std::printf("%.3f,%zu,%.0f,%.3f,%.3f,%.2e,%.3f,%zu,", to_mesh_s, back.mesh.triangles.size(), points,
                difference_s, boolean_s, std::abs(volume - expected) / expected, draw_s, areas);
}

int measure(int argc, char** argv) {
    int repeat = 3;
    bool build_only = false;
    std::vector<std::string> names;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        if (argument == "--build-only")
            build_only = true;
        else if (argument == "--repeat" && i + 1 < argc)
            repeat = std::max(1, std::atoi(argv[++i]));
        else
            names.push_back(argument);
    }
    if (names.empty()) {
        std::fprintf(stderr, "usage: %s [--repeat N] [--build-only] MODEL|sphere:FREQUENCY...\n", argv[0]);
        return 2;
    }
    std::printf(
        "model,triangles,build_s,triangles_per_s,build_checked_s,checked_triangles_per_s,resolved,bsp_nodes,"
        "largest_tree,memory_per_triangle,bso_bytes,of_binary_ply,encode_s,decode_s,%scommit\n",
        build_only
            ? ""
            : "to_mesh_s,triangles_back,points_per_s,difference_s,boolean_s,volume_differs,draw_s,areas,");
    const std::string commit = commit_of(OCTAVO_SOURCES);
    for (const std::string& name : names) {
        const Pair pair = pair_of(name);
        const std::optional<bsp_octree::Built> built = measure_tree(name, pair, repeat);
        if (!built) continue;
        if (!build_only) measure_use(name, pair, *built, repeat);
        std::printf("%s\n", commit.c_str());
        std::fflush(stdout);
    }
    return 0;
}

}  // namespace
}  // namespace octavo::bench

int main(int argc, char** argv) { return octavo::bench::measure(argc, argv); }
