// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <mutex>
#include <vector>

#include <octavo/exact/counters.hpp>

namespace octavo::exact {
namespace {

using Counts = std::array<std::uint64_t, 2 * predicate_kinds>;

/// The blocks of the threads that live, and the sum of those that ended.
struct Registry {
    std::mutex mutex;
    std::vector<const detail::CounterBlock*> blocks;
    Counts ended{};
};

// Never destroyed: threads may end after the program's static objects are gone.
Registry& registry() {
    static Registry& instance = *new Registry;
    return instance;
}

void add(Counts& sum, const detail::CounterBlock& block) {
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += block.counts[i].load(std::memory_order_relaxed);
}

/// A thread's membership in the registry; ends with the thread.
struct Registration {
    Registration() {
        const std::lock_guard lock(registry().mutex);
        registry().blocks.push_back(&detail::counter_block);
    }
    ~Registration() {
        const std::lock_guard lock(registry().mutex);
        auto& blocks = registry().blocks;
        blocks.erase(std::find(blocks.begin(), blocks.end(), &detail::counter_block));
        add(registry().ended, detail::counter_block);
        // What other destructors of this thread still count is not seen any more.
    }
};

}  // namespace

void detail::register_counter_block() {
    counter_block.registered = true;
    thread_local const Registration registration;
    static_cast<void>(registration);
}

PredicateCounts predicate_counts() {
    Counts sum;
    {
        const std::lock_guard lock(registry().mutex);
        sum = registry().ended;
        for (const detail::CounterBlock* block : registry().blocks) add(sum, *block);
    }
    PredicateCounts counts;
    for (std::size_t kind = 0; kind < predicate_kinds; ++kind)
        counts.by_kind[kind] = {sum[2 * kind], sum[2 * kind + 1]};
    return counts;
}

std::uint64_t PredicateCounts::filtered() const {
    std::uint64_t sum = 0;
    for (const PredicateCount& count : by_kind) sum += count.filtered;
    return sum;
}

std::uint64_t PredicateCounts::exact() const {
    std::uint64_t sum = 0;
    for (const PredicateCount& count : by_kind) sum += count.exact;
    return sum;
}

PredicateCounts operator-(const PredicateCounts& after, const PredicateCounts& before) {
    PredicateCounts difference;
    for (std::size_t kind = 0; kind < predicate_kinds; ++kind) {
        difference.by_kind[kind].filtered = after.by_kind[kind].filtered - before.by_kind[kind].filtered;
        difference.by_kind[kind].exact = after.by_kind[kind].exact - before.by_kind[kind].exact;
    }
    return difference;
}

}  // namespace octavo::exact
