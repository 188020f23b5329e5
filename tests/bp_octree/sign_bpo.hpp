// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/checksum.hpp>
#include <octavo/bp_octree/bpo_layout.hpp>

namespace octavo::tests {

/// Recomputes all checksums, as a liar would, as far as the lies leave them within reach.
inline void sign_bpo(std::vector<std::uint8_t>& bytes) {
    const auto put = [&](std::size_t at, std::uint32_t value) {
        for (std::size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
    };
    const auto get = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i) value |= std::uint32_t{bytes[at + i]} << (8 * i);
        return value;
    };
    const std::size_t levels = get(76),
                      index = bp_octree::BpoHead::size + levels * bp_octree::BpoHead::level_size;
    if (index > bytes.size()) return;
    put(12, 0);
    put(12, crc32_of(std::span(bytes).first(index)));
    const std::size_t chunks = get(136);
    for (std::size_t page = 0; page * bp_octree::entries_a_page < chunks; ++page) {
        const std::size_t at = index + page * bp_octree::page_size;
        if (at + bp_octree::page_size > bytes.size()) return;
        for (std::size_t i = 0;
             i < std::min(bp_octree::entries_a_page, chunks - page * bp_octree::entries_a_page); ++i) {
            const std::size_t entry = at + bp_octree::page_head + i * bp_octree::ChunkEntry::size_in_file;
            const std::size_t offset = get(entry), size = get(entry + 8);
            if (offset + size <= bytes.size())
                put(entry + 12, crc32_of(std::span(bytes).subspan(offset, size)));
        }
        put(at, crc32_of(std::span(bytes).subspan(at + 4, bp_octree::page_size - 4)));
    }
}

}  // namespace octavo::tests
