// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

// A gray leaf as a few words in a row, so that one load brings its head and the numbers of its facets.
//
//     │ level 5 │ extent 5 │ wide 1 │ count 8 │ winding 13 │  facet │ facet │ …
//
// With `wide`, two words of 32 bits follow the head: the count and the winding number, which did not fit.

namespace octavo::query {

struct LeafRecord {
    int level = 0;
    /// Bounds the coordinates of the leaf and its facets relative to the leaf's low corner; a power of two.
    double extent = 0;
    std::int32_t winding = 0;  ///< at the low corner, displaced
    std::span<const std::uint32_t> facets;

    static LeafRecord at(const std::uint32_t* words) {
        const std::uint32_t head = *words++;
        LeafRecord leaf;
        leaf.level = static_cast<int>(head & 31);
        leaf.extent = static_cast<double>(std::uint64_t{1} << (head >> 5 & 31));
        std::size_t count = head >> 11 & 255;
        leaf.winding = static_cast<std::int32_t>(head) >> 19;
        if (head >> 10 & 1) [[unlikely]] {
            count = *words++;
            leaf.winding = static_cast<std::int32_t>(*words++);
        }
        leaf.facets = {words, count};
        return leaf;
    }
    /// How many words a record has.
    static std::size_t size_of(const std::uint32_t* record) {
        return head_words(*record) + at(record).facets.size();
    }
    /// The words of this record that come before its facets.
    static std::size_t head_words(std::uint32_t head) { return head >> 10 & 1 ? 3 : 1; }

    /// Appends a record without an extent, and returns where it begins.
    static std::size_t append(std::vector<std::uint32_t>& words, int level, std::int32_t winding,
                              std::span<const std::uint32_t> facets) {
        const std::size_t at = words.size();
        const bool wide = facets.size() > 255 || winding < -4096 || winding > 4095;
        const std::uint32_t head = static_cast<std::uint32_t>(level) | (wide ? 1U << 10 : 0U);
        if (wide) {
            words.push_back(head);
            words.push_back(static_cast<std::uint32_t>(facets.size()));
            words.push_back(static_cast<std::uint32_t>(winding));
        } else {
            words.push_back(head | static_cast<std::uint32_t>(facets.size()) << 11 |
                            static_cast<std::uint32_t>(winding) << 19);
        }
        words.insert(words.end(), facets.begin(), facets.end());
        return at;
    }
    /// Sets the extent, from a bound below 2^28.
    static void set_extent(std::uint32_t& head, std::uint32_t bound) {
        head = (head & ~(31U << 5)) | static_cast<std::uint32_t>(std::bit_width(bound)) << 5;
    }
};

}  // namespace octavo::query
