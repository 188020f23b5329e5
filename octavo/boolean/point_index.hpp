// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/exact/point.hpp>

// Finds lattice points by value. Made only where one is looked for: most jobs never construct a point that could be
// one.

namespace octavo::boolean {

class PointIndex {
  public:
    /// Before the first search; nothing after that. `points` hold every point once and are the same at every call.
    void prepare(std::span<const exact::Point> points);
    /// The index of `point` in `points`; no_index when it is not among them.
    std::uint32_t find(exact::Point point, std::span<const exact::Point> points) const;

  private:
    std::vector<std::uint32_t> slots_;
};

}  // namespace octavo::boolean
