// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "peer_clock.hpp"

// What a peer of the query comparison is given and gives back. Plain arrays, so that no peer sees the headers of
// another.

namespace octavo::bench {

struct QueryJob {
    std::vector<std::array<float, 3>> vertices;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    /// Points are floats, so that peers in float and in double get the same.
    std::vector<std::array<float, 3>> points;
    /// Peers far slower than the rest answer only so many of the points.
    std::size_t slow_points = 20000;
    int runs = 5;
};

struct QueryAnswer {
    std::string system;
    Usage build;
    double nanoseconds = 0;  ///< CPU time a point, the median of the runs
    std::vector<std::int8_t>
        inside;                    ///< per point answered: −1 inside, 1 outside, 0 on; empty when not asked
    std::vector<double> distance;  ///< per point answered, without sign; empty when not asked
};

/// Median CPU nanoseconds a point of calling `work()`, which answers `points` points.
double time_a_point(int runs, std::size_t points, const std::function<void()>& work);

std::vector<QueryAnswer> run_embree(const QueryJob& job, bool only_inside);
std::vector<QueryAnswer> run_cgal_queries(const QueryJob& job);

}  // namespace octavo::bench
