// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <numeric>
#include <utility>

#include <octavo/base/parallel.hpp>
#include <octavo/base/uninitialised.hpp>

// Union-find that several threads may unite at the same time. The representative of a set is its smallest member,
// whatever the order of the unions: a root is only ever linked below a smaller one.
//
// Source: R. Anderson and H. Woll, Wait-free parallel algorithms for the union-find problem, 1991; without ranks, which
// the order of members stands in for.

namespace octavo::boolean {

class ConcurrentSets {
  public:
    /// Each member is a set of its own, unless the context is cancelled.
    ConcurrentSets(std::uint32_t count, const Context& context) : parent_(count) {
        parallel_chunks(context, count, 1 << 12, [&](std::size_t begin, std::size_t end) {
            std::iota(parent_.data() + begin, parent_.data() + end, static_cast<std::uint32_t>(begin));
        });
    }

    /// The smallest member of the set of `x`, unless unions are going on.
    std::uint32_t find(std::uint32_t x) {
        for (;;) {
            const std::uint32_t up = parent(x).load(std::memory_order_relaxed);
            if (up == x) return x;
            const std::uint32_t above = parent(up).load(std::memory_order_relaxed);
            // Another thread may have written an ancestor that is farther up; this one is one too.
            if (above != up) parent(x).store(above, std::memory_order_relaxed);
            x = above;
        }
    }

    void unite(std::uint32_t a, std::uint32_t b) {
        // Most unions of neighbours join nothing new, which one look at either mostly tells.
        if (parent(a).load(std::memory_order_relaxed) == parent(b).load(std::memory_order_relaxed)) return;
        for (;;) {
            a = find(a), b = find(b);
            if (a == b) return;
            if (a < b) std::swap(a, b);
            std::uint32_t root = a;
            if (parent(a).compare_exchange_weak(root, b, std::memory_order_relaxed)) return;
        }
    }

  private:
    std::atomic_ref<std::uint32_t> parent(std::uint32_t x) { return std::atomic_ref(parent_[x]); }

    UninitialisedVector<std::uint32_t> parent_;
};

}  // namespace octavo::boolean
