// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include <octavo/base/huge_page_allocator.hpp>

// Vectors whose new elements are not set to zero first, for large arrays that are written whole right after they are
// made: zeroing them costs as much as filling them. Large ones are in large pages.

namespace octavo {

template <class T>
struct UninitialisedAllocator : HugePageAllocator<T> {
    template <class U>
    struct rebind {
        using other = UninitialisedAllocator<U>;
    };
    template <class U>
    void construct(U* at) noexcept {
        ::new (static_cast<void*>(at)) U;
    }
    template <class U, class... Arguments>
    void construct(U* at, Arguments&&... arguments) {
        std::construct_at(at, std::forward<Arguments>(arguments)...);
    }
};

/// For types without constructors of their own.
template <class T>
using UninitialisedVector = std::vector<T, UninitialisedAllocator<T>>;

}  // namespace octavo
