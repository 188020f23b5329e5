// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

// Memory for large arrays in pages of 2 MiB.
//
// With pages of 4 KiB nearly every look-up at a random place beyond some megabytes misses the TLB too, and walking the
// page table costs as much as the load itself; and the system hands out a page at a time when an array is first
// written: a fifth of the wall time of joining two spheres of a million triangles. Where the system has pages of 2 MiB
// for those who ask (Linux does), arrays of that size ask for them. Only whole large pages are asked for, so an array
// takes at most one of them more than what is written of it.

namespace octavo {

template <class T>
struct HugePageAllocator {
    using value_type = T;

    HugePageAllocator() = default;
    template <class Other>
    HugePageAllocator(const HugePageAllocator<Other>&) {}

    T* allocate(std::size_t count) {
        const std::size_t bytes = count * sizeof(T);
        if (bytes < page) return static_cast<T*>(::operator new(bytes, alignment));
        void* memory = nullptr;
        if (posix_memalign(&memory, page, bytes) != 0) throw std::bad_alloc();
#ifdef __linux__
        madvise(memory, bytes / page * page, MADV_HUGEPAGE);  // Refused, it is only slower.
#endif
        return static_cast<T*>(memory);
    }
    void deallocate(T* memory, std::size_t count) {
        if (count * sizeof(T) < page)
            ::operator delete(memory, alignment);
        else
            std::free(memory);
    }

    template <class Other>
    friend bool operator==(const HugePageAllocator&, const HugePageAllocator<Other>&) {
        return true;
    }

  private:
    static constexpr std::size_t page = std::size_t{2} << 20;
    static constexpr std::align_val_t alignment{alignof(T)};
    static_assert(alignof(T) <= page);
};

}  // namespace octavo
