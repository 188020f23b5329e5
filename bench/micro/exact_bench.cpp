// SPDX-License-Identifier: Apache-2.0
#include <random>
#include <tuple>
#include <vector>

#include <benchmark/benchmark.h>

#include <octavo/exact/compare.hpp>
#include <octavo/exact/linear_form.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/exact/orient_in_plane.hpp>
#include <octavo/exact/side.hpp>

// Nanoseconds of CPU time for one call of each predicate of exact/, on random full-range input that fits the
// first-level cache, so that the arithmetic is measured and not the memory. Bars: a lattice point against a
// plane 5 ns, a three-plane point against a plane 15 ns by the filter and 40 ns exactly, three planes
// intersected 120 ns.

namespace octavo::exact {
namespace {

constexpr std::size_t set_size = 128;

/// The same random input for every benchmark.
struct Input {
    std::vector<Point> points;
    std::vector<Plane> planes;
    std::vector<Line> lines;
    std::vector<EdgePoint> edge_points;
    std::vector<TriplePoint> triple_points;
    std::vector<LinearForm> forms;
    std::vector<Vec3> queries;

    Input() {
        std::mt19937_64 engine(1);
        std::uniform_int_distribution<std::int32_t> coordinate(0, universe_side - 1);
        std::uniform_real_distribution<double> real(0, universe_side);
        const auto point = [&] { return Point{coordinate(engine), coordinate(engine), coordinate(engine)}; };
        for (std::size_t i = 0; i < set_size; ++i) {
            points.push_back(point());
            planes.push_back(Plane::through(point(), point(), point()));
            queries.push_back({real(engine), real(engine), real(engine)});
            forms.push_back(LinearForm::of(Lattice{}, planes.back()));
        }
        for (std::size_t i = 0; i < set_size; ++i) {
            const auto& [first, second, third] =
                std::tie(planes[i], planes[(i + 1) % set_size], planes[(i + 2) % set_size]);
            lines.emplace_back(first, second);
            edge_points.push_back(*intersect(points[i], points[(i + 1) % set_size], first));
            triple_points.push_back(*intersect(first, second, third));
        }
    }
};

const Input& input() {
    static const Input instance;
    return instance;
}

/// Runs `call(i)` for all i of the set, over and over; `per_call` is one call's share, in seconds.
template <class Call>
void measure(benchmark::State& state, const Call& call) {
    for (auto _ : state)
        for (std::size_t i = 0; i < set_size; ++i) benchmark::DoNotOptimize(call(i));
    state.counters["per_call"] =
        benchmark::Counter(static_cast<double>(state.iterations() * set_size),
                           benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

/// The element `steps` after i, cyclically: operands that have nothing to do with element i.
template <class Element>
const Element& at(const std::vector<Element>& elements, std::size_t i, std::size_t steps = 0) {
    return elements[(i + steps) % set_size];
}

void plane_through_points(benchmark::State& state) {
    const auto& points = input().points;
    measure(state,
            [&](std::size_t i) { return Plane::through(at(points, i), at(points, i, 1), at(points, i, 2)); });
}
BENCHMARK(plane_through_points);

void orient3d_points(benchmark::State& state) {
    const auto& points = input().points;
    measure(state, [&](std::size_t i) {
        return orient3d(at(points, i), at(points, i, 1), at(points, i, 2), at(points, i, 3));
    });
}
BENCHMARK(orient3d_points);

void side_of_lattice_point(benchmark::State& state) {
    const auto& [points, planes] = std::tie(input().points, input().planes);
    measure(state, [&](std::size_t i) { return side_of(at(planes, i), at(points, i, 7)); });
}
BENCHMARK(side_of_lattice_point);

void side_of_edge_point_filtered(benchmark::State& state) {
    const auto& [points, planes] = std::tie(input().edge_points, input().planes);
    measure(state, [&](std::size_t i) { return side_of(at(planes, i), at(points, i, 7)); });
}
BENCHMARK(side_of_edge_point_filtered);

void side_of_edge_point_exact(benchmark::State& state) {
    const auto& [points, planes] = std::tie(input().edge_points, input().planes);
    measure(state, [&](std::size_t i) { return exact_side_of(at(planes, i), at(points, i, 7)); });
}
BENCHMARK(side_of_edge_point_exact);

void side_of_triple_point_filtered(benchmark::State& state) {
    const auto& [points, planes] = std::tie(input().triple_points, input().planes);
    measure(state, [&](std::size_t i) { return side_of(at(planes, i), at(points, i, 7)); });
}
BENCHMARK(side_of_triple_point_filtered);

void side_of_triple_point_exact(benchmark::State& state) {
    const auto& [points, planes] = std::tie(input().triple_points, input().planes);
    measure(state, [&](std::size_t i) { return exact_side_of(at(planes, i), at(points, i, 7)); });
}
BENCHMARK(side_of_triple_point_exact);

/// Asked on purpose about a plane that the point was built from: the filter fails, then the exact path runs.
void side_of_triple_point_zero(benchmark::State& state) {
    const auto& [points, planes] = std::tie(input().triple_points, input().planes);
    measure(state, [&](std::size_t i) { return side_of(at(planes, i), at(points, i)); });
}
BENCHMARK(side_of_triple_point_zero);

void side_of_axis_plane_triple_point(benchmark::State& state) {
    const auto& points = input().triple_points;
    const AxisPlane plane{1, universe_side + 1};
    measure(state, [&](std::size_t i) { return side_of(plane, at(points, i)); });
}
BENCHMARK(side_of_axis_plane_triple_point);

void intersect_edge_and_plane(benchmark::State& state) {
    const auto& [points, planes] = std::tie(input().points, input().planes);
    measure(state, [&](std::size_t i) { return intersect(at(points, i), at(points, i, 1), at(planes, i)); });
}
BENCHMARK(intersect_edge_and_plane);

void intersect_three_planes(benchmark::State& state) {
    const auto& planes = input().planes;
    measure(state,
            [&](std::size_t i) { return intersect(at(planes, i), at(planes, i, 1), at(planes, i, 2)); });
}
BENCHMARK(intersect_three_planes);

void intersect_line_and_plane(benchmark::State& state) {
    const auto& [lines, planes] = std::tie(input().lines, input().planes);
    measure(state, [&](std::size_t i) { return intersect(at(lines, i), at(planes, i, 2)); });
}
BENCHMARK(intersect_line_and_plane);

void compare_triple_points_filtered(benchmark::State& state) {
    const auto& points = input().triple_points;
    measure(state, [&](std::size_t i) { return compare_coordinate(0, at(points, i), at(points, i, 5)); });
}
BENCHMARK(compare_triple_points_filtered);

void compare_triple_points_exact(benchmark::State& state) {
    const auto& points = input().triple_points;
    measure(state,
            [&](std::size_t i) { return exact_compare_coordinate(0, at(points, i), at(points, i, 5)); });
}
BENCHMARK(compare_triple_points_exact);

void compare_edge_points_exact(benchmark::State& state) {
    const auto& points = input().edge_points;
    measure(state,
            [&](std::size_t i) { return exact_compare_coordinate(0, at(points, i), at(points, i, 5)); });
}
BENCHMARK(compare_edge_points_exact);

void orient_triple_points_filtered(benchmark::State& state) {
    const auto& [points, planes] = std::tie(input().triple_points, input().planes);
    measure(state, [&](std::size_t i) {
        return orient_in_plane(at(planes, i), at(points, i), at(points, i, 3), at(points, i, 5));
    });
}
BENCHMARK(orient_triple_points_filtered);

void orient_triple_points_exact(benchmark::State& state) {
    const auto& points = input().triple_points;
    measure(state, [&](std::size_t i) {
        return exact_orient2d(0, at(points, i), at(points, i, 3), at(points, i, 5));
    });
}
BENCHMARK(orient_triple_points_exact);

void orient_edge_points_exact(benchmark::State& state) {
    const auto& points = input().edge_points;
    measure(state, [&](std::size_t i) {
        return exact_orient2d(0, at(points, i), at(points, i, 3), at(points, i, 5));
    });
}
BENCHMARK(orient_edge_points_exact);

void linear_form_filtered(benchmark::State& state) {
    const auto& [forms, queries] = std::tie(input().forms, input().queries);
    measure(state, [&](std::size_t i) { return at(forms, i).at(at(queries, i, 3)); });
}
BENCHMARK(linear_form_filtered);

void linear_form_exact(benchmark::State& state) {
    const auto& [forms, queries] = std::tie(input().forms, input().queries);
    measure(state, [&](std::size_t i) { return at(forms, i).exact_at(at(queries, i, 3)); });
}
BENCHMARK(linear_form_exact);

}  // namespace
}  // namespace octavo::exact
