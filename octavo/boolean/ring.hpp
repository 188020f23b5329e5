// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

// The sides that triangles about a point have opposite to it, and whether they make one closed polygon: then the
// triangles are one fan about the point.
//
// Idea: fans are small, so the side that follows another one is found among all by comparing eight at once.
// Cost: about 15 instructions a side up to 32 of them, then a sort.

namespace octavo::boolean {

class Ring {
  public:
    /// Sides 0 to `count` - 1 are to be set.
    void begin(std::size_t count);
    /// Side i runs from one point to another.
    void set(std::size_t i, std::uint32_t from, std::uint32_t to) { from_[i] = from, to_[i] = to; }

    /// Whether each side follows another one so that all are one closed polygon, which has no point twice.
    bool close();
    /// The points of the polygon in their order, from the start of side 0.
    std::span<const std::uint32_t> points() const { return {points_.data(), count_}; }

  private:
    static constexpr std::size_t small = 32;
    bool close_small();
    bool close_large();

    std::size_t count_ = 0;
    std::vector<std::uint32_t> from_, to_, points_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sorted_;
};

}  // namespace octavo::boolean
