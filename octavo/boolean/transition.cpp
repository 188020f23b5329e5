// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/boolean/transition.hpp>

namespace octavo::boolean {

void TransitionSum::add(std::span<const Delta> deltas, int sign) {
    for (const Delta& delta : deltas) terms_.push_back({delta.operand, sign * delta.turns});
}

std::span<const Delta> TransitionSum::normalised() {
    std::sort(terms_.begin(), terms_.end());
    std::size_t kept = 0;
    for (std::size_t i = 0; i < terms_.size();) {
        Delta sum{terms_[i].operand, 0};
        for (; i < terms_.size() && terms_[i].operand == sum.operand; ++i) sum.turns += terms_[i].turns;
        if (sum.turns != 0) terms_[kept++] = sum;
    }
    terms_.resize(kept);
    return terms_;
}

TransitionTable::TransitionTable(std::uint32_t operands) {
    for (std::uint32_t operand = 0; operand < operands; ++operand) {
        deltas_.push_back({operand, 1});
        begin_.push_back(operand + 1);
    }
}

TransitionId TransitionTable::intern(std::span<const Delta> deltas) {
    if (deltas.size() == 1 && deltas[0].turns == 1) return deltas[0].operand;
    const auto [place, is_new] = ids_.try_emplace(std::vector<Delta>(deltas.begin(), deltas.end()),
                                                  static_cast<TransitionId>(begin_.size() - 1));
    if (is_new) {
        deltas_.insert(deltas_.end(), deltas.begin(), deltas.end());
        begin_.push_back(static_cast<std::uint32_t>(deltas_.size()));
    }
    return place->second;
}

}  // namespace octavo::boolean
