// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <benchmark/benchmark.h>

#include <octavo/classic/crossing.hpp>
#include <octavo/classic/from_mesh.hpp>
#include <octavo/classic/octant_overlap.hpp>
#include <octavo/octree/linear_octree.hpp>
#include <octavo/octree/oct_format.hpp>
#include <octavo/query/inside.hpp>

// The steps of building octrees and of asking them, on a bumpy sphere with 2 · 256² facets.

namespace octavo {
namespace {

Vec3 on_bumpy_sphere(double theta, double phi) {
    const double radius = 2.4e7 * (1 + 0.1 * std::sin(7 * phi) * std::sin(9 * theta));
    return {33554432 + radius * std::sin(theta) * std::cos(phi),
            33554432 + radius * std::sin(theta) * std::sin(phi), 33554432 + radius * std::cos(theta)};
}

mesh::LatticeMesh bumpy_sphere() {
    constexpr int rings = 256, sectors = 256;
    mesh::LatticeMesh mesh;
    const auto add = [&](double polar, double around) {
        const Vec3 p = on_bumpy_sphere(std::acos(-1.0) * polar, 2 * std::acos(-1.0) * around);
        const auto round = [](double v) { return static_cast<std::int32_t>(std::lround(v)); };
        mesh.points.push_back({round(p.x), round(p.y), round(p.z)});
    };
    add(0, 0);
    for (int ring = 1; ring < rings; ++ring)
        for (int sector = 0; sector < sectors; ++sector)
            add(static_cast<double>(ring) / rings, static_cast<double>(sector) / sectors);
    add(1, 0);
    const auto at = [&](int ring, int sector) {
        return static_cast<mesh::VertexIndex>(1 + (ring - 1) * sectors + sector % sectors);
    };
    const auto last = static_cast<mesh::VertexIndex>(mesh.points.size() - 1);
    for (int sector = 0; sector < sectors; ++sector) {
        mesh.triangles.push_back({0, at(1, sector), at(1, sector + 1)});
        mesh.triangles.push_back({last, at(rings - 1, sector + 1), at(rings - 1, sector)});
        for (int ring = 1; ring + 1 < rings; ++ring) {
            mesh.triangles.push_back({at(ring, sector), at(ring + 1, sector), at(ring + 1, sector + 1)});
            mesh.triangles.push_back({at(ring, sector), at(ring + 1, sector + 1), at(ring, sector + 1)});
        }
    }
    return mesh;
}

const mesh::LatticeMesh& the_mesh() {
    static const mesh::LatticeMesh mesh = bumpy_sphere();
    return mesh;
}

Context one_thread() {
    Context context;
    context.threads = 1;
    return context;
}

struct Pair {
    classic::Facet facet;
    octree::Cell cell;
};

/// Facets with cells of about their size that they touch.
const std::vector<Pair>& pairs() {
    static const std::vector<Pair> all = [] {
        std::vector<Pair> found;
        const std::vector<classic::Facet> facets = *classic::facets_of(the_mesh());
        for (const classic::Facet& facet : facets) {
            const auto& p = facet.corner[0];
            const octree::Cell cell = octree::Cell::of(octree::CellKey::at({p[0], p[1], p[2]}, 8));
            if (classic::touches(facet, cell, classic::Touch::interior)) found.push_back({facet, cell});
        }
        return found;
    }();
    return all;
}

void bounds_of_a_facet(benchmark::State& state) {
    std::size_t i = 0;
    for (auto _ : state) {
        const Pair& pair = pairs()[i++ % 4096];
        benchmark::DoNotOptimize(
            classic::OctantFrame<classic::Touch::interior>(pair.cell).bounds(pair.facet));
    }
}
BENCHMARK(bounds_of_a_facet);

void octants_of_four_facets(benchmark::State& state) {
    std::size_t i = 0;
    for (auto _ : state) {
        const Pair* four = &pairs()[i];
        i = (i + 4) % 4096;
        benchmark::DoNotOptimize(
            classic::touched_octants({&four[0].facet, &four[1].facet, &four[2].facet, &four[3].facet},
                                     four->cell, classic::Touch::interior));
    }
    state.SetItemsProcessed(4 * state.iterations());
}
BENCHMARK(octants_of_four_facets);

void crossing_of_a_step(benchmark::State& state) {
    std::size_t i = 0;
    for (auto _ : state) {
        const Pair& pair = pairs()[i++ % 4096];
        benchmark::DoNotOptimize(classic::crossing(
            pair.facet, {pair.cell.low.x, pair.cell.low.y, pair.cell.low.z}, 2, pair.cell.side()));
    }
}
BENCHMARK(crossing_of_a_step);

void build_octree(benchmark::State& state) {
    const int depth = static_cast<int>(state.range(0));
    std::uint64_t leaves = 0;
    for (auto _ : state) {
        const Result<classic::Built> built = classic::build(the_mesh(), {.depth = depth}, one_thread());
        leaves = built->octree.stats().leaves();
    }
    state.counters["leaves"] = static_cast<double>(leaves);
}
BENCHMARK(build_octree)->DenseRange(6, 10)->Unit(benchmark::kMillisecond);

void encode_octree(benchmark::State& state) {
    const octree::Octree octree = classic::build(the_mesh(), {.depth = 9}, one_thread())->octree;
    std::size_t bytes = 0;
    for (auto _ : state) bytes = octree::encode(octree).size();
    state.SetBytesProcessed(static_cast<std::int64_t>(bytes) * state.iterations());
}
BENCHMARK(encode_octree)->Unit(benchmark::kMillisecond);

void locate_in_linear_octree(benchmark::State& state) {
    const octree::LinearOctree octree =
        *octree::LinearOctree::from(classic::build(the_mesh(), {.depth = 9}, one_thread())->octree);
    std::mt19937 random(1);
    std::vector<exact::Point> points(1 << 16);
    const auto place = [&] { return static_cast<std::int32_t>(random() % exact::universe_side); };
    for (exact::Point& p : points) p = {place(), place(), place()};
    for (auto _ : state) benchmark::DoNotOptimize(octree.locate(points, one_thread()));
    state.SetItemsProcessed(static_cast<std::int64_t>(points.size()) * state.iterations());
}
BENCHMARK(locate_in_linear_octree);

enum class Where { anywhere, near_surface };

/// Points anywhere in the bounds, or within a hundredth of the size of the surface.
std::vector<Vec3> query_points(Where where) {
    std::mt19937_64 random(1);
    std::vector<Vec3> points(1 << 18);
    const auto unit = [&] { return std::ldexp(static_cast<double>(random() >> 11), -53); };
    for (Vec3& p : points) {
        if (where == Where::near_surface) {
            const Vec3 v = on_bumpy_sphere(std::acos(1 - 2 * unit()), 2 * std::acos(-1.0) * unit());
            p = v + 1e6 * Vec3{unit() - 0.5, unit() - 0.5, unit() - 0.5};
        } else {
            p = {7e6 + 5.3e7 * unit(), 7e6 + 5.3e7 * unit(), 7e6 + 5.3e7 * unit()};
        }
    }
    return points;
}

void inside_batch(benchmark::State& state) {
    const query::InsideQuery query = *query::InsideQuery::build(the_mesh(), {}, one_thread());
    const std::vector<Vec3> points = query_points(static_cast<Where>(state.range(0)));
    for (auto _ : state) benchmark::DoNotOptimize(query(points, one_thread()));
    state.SetItemsProcessed(static_cast<std::int64_t>(points.size()) * state.iterations());
    state.counters["bytes_a_facet"] =
        static_cast<double>(query.memory_bytes()) / static_cast<double>(the_mesh().triangles.size());
}
BENCHMARK(inside_batch)->Arg(0)->Arg(1);

void inside_single(benchmark::State& state) {
    const query::InsideQuery query = *query::InsideQuery::build(the_mesh(), {}, one_thread());
    const std::vector<Vec3> points = query_points(static_cast<Where>(state.range(0)));
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(query(points[i++ % points.size()]));
}
BENCHMARK(inside_single)->Arg(0)->Arg(1);

void build_inside_query(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(query::InsideQuery::build(the_mesh(), {}, one_thread()));
}
BENCHMARK(build_inside_query)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace octavo
