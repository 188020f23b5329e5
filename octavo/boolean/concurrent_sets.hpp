// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <vector>

// Union-find that several threads may unite at the same time. The representative of a set is its smallest member,
// whatever the order of the unions: a root is only ever linked below a smaller one.
//
// Source: R. Anderson and H. Woll, Wait-free parallel algorithms for the union-find problem, 1991; without ranks, which
// the order of members stands in for.

namespace octavo::boolean {

class ConcurrentSets {
  public:
    explicit ConcurrentSets(std::uint32_t count) : parent_(count) {
        for (std::uint32_t member = 0; member < count; ++member)
            parent_[member].store(member, std::memory_order_relaxed);
    }

    /// The smallest member of the set of `x`, unless unions are going on.
    std::uint32_t find(std::uint32_t x) {
        for (;;) {
            const std::uint32_t parent = parent_[x].load(std::memory_order_relaxed);
            if (parent == x) return x;
            const std::uint32_t above = parent_[parent].load(std::memory_order_relaxed);
            // Another thread may have written an ancestor that is farther up; this one is one too.
            if (above != parent) parent_[x].store(above, std::memory_order_relaxed);
            x = above;
        }
    }

    void unite(std::uint32_t a, std::uint32_t b) {
        // Most unions of neighbours join nothing new, which one look at either mostly tells.
        if (parent_[a].load(std::memory_order_relaxed) == parent_[b].load(std::memory_order_relaxed)) return;
        for (;;) {
            a = find(a), b = find(b);
            if (a == b) return;
            if (a < b) std::swap(a, b);
            std::uint32_t root = a;
            if (parent_[a].compare_exchange_weak(root, b, std::memory_order_relaxed)) return;
        }
    }

  private:
    std::vector<std::atomic<std::uint32_t>> parent_;
};

}  // namespace octavo::boolean
