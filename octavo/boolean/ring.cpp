// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include <octavo/boolean/lanes.hpp>
#include <octavo/boolean/ring.hpp>
#include <octavo/boolean/soup.hpp>

namespace octavo::boolean {

void Ring::begin(std::size_t count) {
    count_ = count;
    const std::size_t padded = (count + 7) / 8 * 8;
    if (from_.size() < padded) from_.resize(padded), to_.resize(padded), points_.resize(padded);
    for (std::size_t i = count; i < padded; ++i) from_[i] = no_index;
}

bool Ring::close() {
    if (count_ < 3) return false;
    return count_ <= small ? close_small() : close_large();
}

bool Ring::close_small() {
    const std::size_t padded = (count_ + 7) / 8 * 8;
    std::size_t at = 0;
    for (std::size_t step = 0; step < count_; ++step) {
        points_[step] = from_[at];
        std::uint32_t starts = 0;
        for (std::size_t block = 0; block < padded; block += 8)
            starts |= bits(load_block(from_.data() + block) == static_cast<std::int32_t>(to_[at])) << block;
        if (!std::has_single_bit(starts)) return false;
        at = static_cast<std::size_t>(std::countr_zero(starts));
        if (at == 0) return step + 1 == count_;
    }
    return false;
}

/// Sorted by start, a polygon is a permutation that each search follows in logarithmic time.
bool Ring::close_large() {
    sorted_.clear();
    for (std::size_t i = 0; i < count_; ++i) sorted_.push_back({from_[i], to_[i]});
    std::sort(sorted_.begin(), sorted_.end());
    std::size_t at = 0;
    for (std::size_t step = 0; step < count_; ++step) {
        points_[step] = sorted_[at].first;
        const auto next = std::lower_bound(sorted_.begin(), sorted_.end(),
                                           std::pair<std::uint32_t, std::uint32_t>{sorted_[at].second, 0});
        if (next == sorted_.end() || next->first != sorted_[at].second) return false;
        if (next + 1 != sorted_.end() && (next + 1)->first == next->first) return false;
        at = static_cast<std::size_t>(next - sorted_.begin());
        if (at == 0) return step + 1 == count_;
    }
    return false;
}

}  // namespace octavo::boolean
