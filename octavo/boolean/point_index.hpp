// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/exact/point.hpp>

// Finds lattice points by value. Made when first asked, because most jobs never construct a point that could be one.

namespace octavo::boolean {

class PointIndex {
  public:
    /// The index of `point` in `points`, which hold every point once and are the same at every call; no_index when it
    /// is not among them.
    std::uint32_t find(exact::Point point, std::span<const exact::Point> points);

  private:
    void build(std::span<const exact::Point> points);
    std::vector<std::uint32_t> slots_;
};

}  // namespace octavo::boolean
