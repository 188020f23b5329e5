// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

// Numbers from 0 for values that come up in a small set again and again, such as the vertices of one tree.
//
// An open-addressing table that is emptied by counting up a stamp, so that starting anew costs nothing. Sorting the
// values and bisecting took a tenth of the time of building a BSP-octree; this takes a fortieth.

namespace octavo::bsp {

class Numbering {
  public:
    /// Forgets all values.
    void clear() {
        values_.clear();
        if (++stamp_ == 0) slots_.assign(slots_.size(), {}), stamp_ = 1;
    }

    /// The number of a value: a new one when it comes for the first time.
    std::uint32_t operator()(std::uint32_t value) {
        std::size_t slot = slot_of(value);
        for (; slots_[slot].stamp == stamp_; slot = (slot + 1) & (slots_.size() - 1))
            if (slots_[slot].value == value) return slots_[slot].number;
        const auto number = static_cast<std::uint32_t>(values_.size());
        slots_[slot] = {value, number, stamp_};
        values_.push_back(value);
        if (2 * values_.size() > slots_.size()) grow();
        return number;
    }

    /// By number.
    const std::vector<std::uint32_t>& values() const { return values_; }

  private:
    struct Slot {
        std::uint32_t value = 0, number = 0, stamp = 0;
    };

    std::size_t slot_of(std::uint32_t value) const {
        return value * std::uint64_t{0x9E3779B97F4A7C15} >> 32 & (slots_.size() - 1);
    }
    void grow() {
        slots_.assign(2 * slots_.size(), {});
        stamp_ = 1;
        for (std::uint32_t number = 0; number < values_.size(); ++number) {
            std::size_t slot = slot_of(values_[number]);
            while (slots_[slot].stamp == stamp_) slot = (slot + 1) & (slots_.size() - 1);
            slots_[slot] = {values_[number], number, stamp_};
        }
    }

    std::vector<Slot> slots_{std::vector<Slot>(256)};
    std::vector<std::uint32_t> values_;
    std::uint32_t stamp_ = 1;
};

}  // namespace octavo::bsp
