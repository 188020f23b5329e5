// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

// How often a filter decided and how often the exact path had to: the figure that tells whether a job was
// degenerate. Take `predicate_counts()` before and after, and subtract.
//
// Each thread counts in a block of its own, which it alone writes; relaxed loads and stores make reading it
// from elsewhere legal and cost the same as plain ones. A thread's block enters the list of blocks when the
// thread first counts and is folded into a total when it ends. Cost: about 0.4 ns a predicate. A snapshot taken
// while other threads work is only roughly of one moment.

namespace octavo::exact {

/// The predicates that have a filter. All others are plain integer arithmetic.
enum class Predicate : std::uint8_t { side_of_plane, compare, orient_in_plane, linear_form };
inline constexpr std::size_t predicate_kinds = 4;

struct PredicateCount {
    std::uint64_t filtered = 0;  ///< decided by the floating-point filter
    std::uint64_t exact = 0;     ///< decided by wide integers
};

struct PredicateCounts {
    std::array<PredicateCount, predicate_kinds> by_kind{};

    const PredicateCount& of(Predicate predicate) const {
        return by_kind[static_cast<std::size_t>(predicate)];
    }
    std::uint64_t filtered() const;
    std::uint64_t exact() const;
};

PredicateCounts operator-(const PredicateCounts& after, const PredicateCounts& before);

/// What all threads have counted since the program began.
PredicateCounts predicate_counts();

namespace detail {

struct CounterBlock {
    bool registered = false;
    std::array<std::atomic<std::uint64_t>, 2 * predicate_kinds> counts{};
};

// Without a constructor or destructor of its own, access to it is one load; registering adds the destructor. In
// position-independent code the default is a call that hands out the address, which made filters take 4.7 ns
// instead of 2.8; the fixed offset is legal in a shared library too, for a block as small as this.
#ifdef __ELF__
[[gnu::tls_model("initial-exec")]]
#endif
inline constinit thread_local CounterBlock counter_block{};

void register_counter_block();

inline void count(std::size_t index) {
    CounterBlock& block = counter_block;
    if (!block.registered) [[unlikely]]
        register_counter_block();
    std::atomic<std::uint64_t>& count = block.counts[index];
    count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
}

}  // namespace detail

inline void count_filtered(Predicate predicate) { detail::count(2 * static_cast<std::size_t>(predicate)); }
inline void count_exact(Predicate predicate) { detail::count(2 * static_cast<std::size_t>(predicate) + 1); }

}  // namespace octavo::exact
