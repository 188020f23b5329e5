// SPDX-License-Identifier: Apache-2.0
#include <benchmark/benchmark.h>

#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/repair.hpp>
#include <octavo/mesh/self_intersection.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/topology.hpp>
#include <octavo/mesh/triangulate.hpp>
#include <octavo/mesh/validate.hpp>
#include <octavo/mesh/weld.hpp>

// One thread; items are facets (corners for polygons).

namespace octavo::mesh {
namespace {

const Mesh& rough_sphere() {
    static const Mesh mesh = displaced_sphere(132);  // 348 480 facets
    return mesh;
}

Context one_thread() {
    Context context;
    context.threads = 1;
    return context;
}

void count_items(benchmark::State& state, std::size_t items) {
    state.SetItemsProcessed(static_cast<std::int64_t>(items) * state.iterations());
}

void validate_all(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(validate(rough_sphere(), {}, one_thread()));
    count_items(state, rough_sphere().triangles.size());
}
BENCHMARK(validate_all)->Unit(benchmark::kMillisecond);

void self_intersections(benchmark::State& state) {
    const auto snapped = snap(rough_sphere());
    for (auto _ : state)
        benchmark::DoNotOptimize(
            find_self_intersections(snapped->mesh.points, snapped->mesh.triangles, one_thread()));
    count_items(state, rough_sphere().triangles.size());
}
BENCHMARK(self_intersections)->Unit(benchmark::kMillisecond);

/// Two fans of slivers, one above the other: quadratic for plain box tests.
void self_intersections_of_slivers(benchmark::State& state) {
    const Mesh mesh = cone(1, 0, 0.01, static_cast<std::uint32_t>(state.range(0)));
    const auto snapped = snap(mesh);
    for (auto _ : state)
        benchmark::DoNotOptimize(
            find_self_intersections(snapped->mesh.points, snapped->mesh.triangles, one_thread()));
    count_items(state, mesh.triangles.size());
}
BENCHMARK(self_intersections_of_slivers)->Arg(1000)->Arg(4000)->Arg(16000)->Unit(benchmark::kMillisecond);

void edges(benchmark::State& state) {
    const Mesh& mesh = rough_sphere();
    for (auto _ : state) benchmark::DoNotOptimize(build_edges(mesh.triangles, mesh.vertices.size()));
    count_items(state, mesh.triangles.size());
}
BENCHMARK(edges)->Unit(benchmark::kMillisecond);

void fans(benchmark::State& state) {
    const Mesh& mesh = rough_sphere();
    const EdgeTable table = build_edges(mesh.triangles, mesh.vertices.size());
    for (auto _ : state) benchmark::DoNotOptimize(fan_of_corner(table, mesh.triangles));
    count_items(state, mesh.triangles.size());
}
BENCHMARK(fans)->Unit(benchmark::kMillisecond);

void welding(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(equal_vertices(rough_sphere().vertices));
    count_items(state, rough_sphere().triangles.size());
}
BENCHMARK(welding)->Unit(benchmark::kMillisecond);

void measuring(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(measure(rough_sphere()));
    count_items(state, rough_sphere().triangles.size());
}
BENCHMARK(measuring)->Unit(benchmark::kMillisecond);

void repairing(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(repair(rough_sphere(), one_thread()));
    count_items(state, rough_sphere().triangles.size());
}
BENCHMARK(repairing)->Unit(benchmark::kMillisecond);

void triangulate_star(benchmark::State& state) {
    const auto corners = static_cast<std::uint32_t>(state.range(0));
    std::vector<Vec3> vertices;
    std::vector<VertexIndex> polygon;
    std::uint32_t random = 12345;
    for (const Point2D& p : circle(1, corners)) {
        random = random * 1664525u + 1013904223u;
        const double radius = 0.5 + random * 0x1p-33;
        polygon.push_back(static_cast<VertexIndex>(vertices.size()));
        vertices.push_back({radius * p.x, radius * p.y, 0});
    }
    Triangulator triangulator;
    for (auto _ : state) benchmark::DoNotOptimize(triangulator(vertices, polygon));
    count_items(state, corners);
}
BENCHMARK(triangulate_star)->Arg(8)->Arg(100)->Arg(1000)->Arg(10000)->Arg(100000);

}  // namespace
}  // namespace octavo::mesh
