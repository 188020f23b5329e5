// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

// Union-find whose representative is always the smallest member, so that labels never depend on the order of
// the unions. Path halving alone: near-constant in practice, and without a rank array in the cache.

namespace octavo::mesh {

class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), std::uint32_t{0});
    }

    /// The smallest member of the set of `x`.
    std::uint32_t find(std::uint32_t x) {
        while (parent_[x] != x) x = parent_[x] = parent_[parent_[x]];
        return x;
    }

    void unite(std::uint32_t a, std::uint32_t b) {
        a = find(a), b = find(b);
        if (a < b)
            parent_[b] = a;
        else
            parent_[a] = b;
    }

  private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace octavo::mesh
