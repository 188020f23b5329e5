// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <octavo/bsp_octree/bso_blocks.hpp>

// What writer and reader of a `.bso` file agree about (docs/formats/bso.md).

namespace octavo::bsp_octree::bso {

constexpr std::array<std::uint8_t, 8> magic{0x89, 'B', 'S', 'O', '\r', '\n', 0x1A, '\n'};
constexpr std::uint32_t version = 2;

// Byte offsets of the header's fields; all integers are little-endian.
constexpr std::size_t version_at = 8, exponent_at = 12, origin_at = 16, depth_at = 40, leaf_planes_at = 44,
                      stop_at = 48, checksum_at = 52, header_bytes = 56;

// Nodes of the octree, two bits each.
constexpr std::uint32_t white = 0, black = 1, split = 2, bsp_leaf = 3;

/// References to points or planes in the order of first use, in Elias' gamma code: 0 is a new one, which follows,
/// n the one that was first used n entries ago.
class References {
  public:
    /// Returns whether the entry is new.
    bool put(BlockWriter& bits, std::uint32_t entry) {
        const std::uint32_t number = used_ - entry + 1;
        const int width = std::bit_width(number);
        bits.put(0, width - 1);
        bits.put(1, 1);
        bits.put(number & ((1U << (width - 1)) - 1), width - 1);
        if (entry != used_) return false;
        ++used_;
        return true;
    }

    static constexpr std::uint32_t none = ~std::uint32_t{0};

    /// An entry, new when it is `used()` was before; `none` when there is no such entry.
    std::uint32_t get(BlockReader& bits) {
        int width = 1;
        while (width < 32 && bits.get(1) == 0) ++width;
        if (width == 32) return none;
        const std::uint32_t back = (1U << (width - 1) | bits.get(width - 1)) - 1;
        if (back > used_) return none;
        return back == 0 ? used_++ : used_ - back;
    }
    std::uint32_t used() const { return used_; }

  private:
    std::uint32_t used_ = 0;
};

}  // namespace octavo::bsp_octree::bso
