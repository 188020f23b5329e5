// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

// Chunks of a parallel loop whose elements differ a thousandfold in their work: a chunk of equal numbers of them may be
// a third of the loop, and then one thread waits for another. An element that is too much for any chunk is alone.

namespace octavo::boolean {

/// The chunks of [0, count) run from each of these to the next: of at most `most_elements`, and of `weight(element)`s
/// that sum to at most `most_weight`. They depend on nothing else. Cost: linear.
template <class Weight>
std::vector<std::size_t> balanced_chunks(std::size_t count, std::size_t most_elements,
                                         std::size_t most_weight, const Weight& weight) {
    std::vector<std::size_t> bounds{0};
    std::size_t sum = 0;
    for (std::size_t element = 0; element < count; ++element) {
        const std::size_t here = weight(element);
        const bool is_full = element - bounds.back() == most_elements || sum + here > most_weight;
        if (is_full && element != bounds.back()) bounds.push_back(element), sum = 0;
        sum += here;
    }
    if (count != 0) bounds.push_back(count);
    return bounds;
}

}  // namespace octavo::boolean
