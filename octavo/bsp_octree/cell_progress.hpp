// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string_view>

#include <octavo/base/context.hpp>
#include <octavo/octree/cell.hpp>

// How far a descent through an octree is: cells that are done add up to the universe, each by its share of it.

namespace octavo::bsp_octree {

class CellProgress {
  public:
    CellProgress(const Context& context, std::string_view phase) : context_(context), phase_(phase) {}

    /// Nothing of the cell is left to do. Tells the context at every hundredth of the universe.
    void finish(const octree::Cell& cell) {
        done_ += std::ldexp(1.0, -3 * cell.level);
        if (done_ < reported_ + 0.01) return;
        reported_ = done_;
        context_.report(phase_, done_);
    }

  private:
    const Context& context_;
    std::string_view phase_;
    double done_ = 0, reported_ = 0;
};

}  // namespace octavo::bsp_octree
