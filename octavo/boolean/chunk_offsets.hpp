// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <octavo/base/parallel.hpp>

// Where each chunk of a parallel loop writes when elements give different numbers of results: chunks count first, then
// write side by side, and the results are in the order of one loop over all.

namespace octavo::boolean {

/// `size(begin, end)` is how much the chunk [begin, end) will write. The last offset, one past the chunks, is the sum.
template <class Size>
std::vector<std::size_t> chunk_offsets(const Context& context, std::size_t count, std::size_t grain,
                                       const Size& size) {
    std::vector<std::size_t> offset((count + grain - 1) / grain + 1, 0);
    parallel_chunks(context, count, grain, [&](std::size_t begin, std::size_t end) {
        offset[begin / grain + 1] = size(begin, end);
    });
    for (std::size_t chunk = 1; chunk < offset.size(); ++chunk) offset[chunk] += offset[chunk - 1];
    return offset;
}

/// Numbers of elements become their sums before each; one more tells the sum of all.
inline void make_offsets(std::vector<std::uint32_t>& counts) {
    std::uint32_t sum = 0;
    for (std::uint32_t& count : counts) sum += std::exchange(count, sum);
    counts.push_back(sum);
}

}  // namespace octavo::boolean
