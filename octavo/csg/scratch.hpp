// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <type_traits>

// A growing array of plain numbers that is written through a pointer.
//
// std::vector looks at its capacity at every push and clears what resize adds; both show where a cell writes some
// twenty words. Here the writer asks once for as much room as it could need and says afterwards what it used.

namespace octavo::csg {

template <class Number>
class Scratch {
    static_assert(std::is_trivially_copyable_v<Number>);

  public:
    /// Where to write next; at least `count` more fit.
    Number* room(std::size_t count) {
        if (size_ + count > capacity_) grow(size_ + count);
        return numbers_.get() + size_;
    }
    /// The array ends here now: a pointer into it or into the room asked for.
    void end_at(const Number* end) { size_ = static_cast<std::size_t>(end - numbers_.get()); }
    void resize(std::size_t size) {
        if (size > capacity_) grow(size);
        size_ = size;
    }
    void clear() { size_ = 0; }

    std::size_t size() const { return size_; }
    std::size_t capacity() const { return capacity_; }
    Number* data() { return numbers_.get(); }
    const Number* data() const { return numbers_.get(); }
    Number& operator[](std::size_t index) { return numbers_[index]; }
    const Number& operator[](std::size_t index) const { return numbers_[index]; }

  private:
    void grow(std::size_t least) {
        const std::size_t capacity = least + least / 2 + 64;
        std::unique_ptr<Number[]> numbers(new Number[capacity]);
        if (size_ > 0) std::memcpy(numbers.get(), numbers_.get(), size_ * sizeof(Number));
        numbers_ = std::move(numbers);
        capacity_ = capacity;
    }

    std::unique_ptr<Number[]> numbers_;
    std::size_t size_ = 0, capacity_ = 0;
};

}  // namespace octavo::csg
