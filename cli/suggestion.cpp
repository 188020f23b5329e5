// SPDX-License-Identifier: Apache-2.0
#include "suggestion.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace octavo::cli {
namespace {

/// How many letters must be put in, left out or changed to make one word of the other (V. Levenshtein, 1966).
std::size_t distance(const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t changed = diagonal + (a[i] != b[j]);
            diagonal = row[j + 1];
            row[j + 1] = std::min({changed, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

}  // namespace

std::string nearest_word(const std::string& word, std::span<const std::string> known) {
    // The beginning of a word is what people type when they hope for an abbreviation.
    std::string nearest;
    std::size_t least = (word.size() + 2) / 3 + 1;  // a third of the letters may be wrong
    for (const std::string& one : known) {
        const std::size_t here = word.size() > 1 && one.starts_with(word) ? 1 : distance(word, one);
        if (here < least) least = here, nearest = one;
    }
    return nearest;
}

}  // namespace octavo::cli
