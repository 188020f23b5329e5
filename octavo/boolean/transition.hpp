// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

// How the winding numbers of the operands change when a facet is crossed from its front to its back.
//
// An ordinary facet adds one turn of its own operand. Facets that coincide become one facet that carries the sum
// of their changes, so a change is a short list. Lists are interned: equal changes have equal ids, and the id of
// "one more turn of operand k" is k itself, so that the facets of a million-facet operand share one number.

namespace octavo::boolean {

/// Winding behind the facet minus winding in front of it, for one operand; never zero in a list.
struct Delta {
    std::uint32_t operand = 0;
    std::int32_t turns = 0;
    friend auto operator<=>(const Delta&, const Delta&) = default;
};

using TransitionId = std::uint32_t;

/// Adds lists of changes; the result is sorted by operand and free of zeros.
class TransitionSum {
  public:
    void clear() { terms_.clear(); }
    void add(std::span<const Delta> deltas, int sign);
    /// The sum; valid until the next call.
    std::span<const Delta> normalised();

  private:
    std::vector<Delta> terms_;
};

class TransitionTable {
  public:
    explicit TransitionTable(std::uint32_t operands = 0);

    std::span<const Delta> of(TransitionId id) const {
        return {deltas_.data() + begin_[id], begin_[id + 1] - begin_[id]};
    }
    /// The id of a list that is sorted by operand and free of zeros.
    TransitionId intern(std::span<const Delta> deltas);

  private:
    std::vector<Delta> deltas_;
    std::vector<std::uint32_t> begin_{0};
    std::map<std::vector<Delta>, TransitionId> ids_;
};

}  // namespace octavo::boolean
