// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include <octavo/base/parallel_sort.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/boolean/coincident_facets.hpp>

namespace octavo::boolean {
namespace {

struct SortedCorners {
    std::uint32_t low, middle, high;
    bool odd;  ///< the facet runs low, high, middle
    bool same_corners(const SortedCorners& other) const {
        return low == other.low && middle == other.middle && high == other.high;
    }
};

SortedCorners sorted(const mesh::Triangle& facet) {
    const int low = facet[0] < facet[1] ? (facet[0] < facet[2] ? 0 : 2) : (facet[1] < facet[2] ? 1 : 2);
    const std::uint32_t second = facet[(low + 1) % 3], third = facet[(low + 2) % 3];
    return {facet[low], std::min(second, third), std::max(second, third), second > third};
}

/// The same for any order of the corners.
std::uint64_t fingerprint(const mesh::Triangle& facet) {
    std::uint64_t sum = 0;
    for (const std::uint64_t corner : facet) {
        const std::uint64_t spread = (corner + 1) * 0x9E3779B97F4A7C15ull;
        sum += spread ^ spread >> 29;
    }
    return sum * 0xC2B2AE3D27D4EB4Full;
}

/// Facets by ranges of their least corners; ascending within a range.
struct Dealt {
    UninitialisedVector<std::uint32_t> facets;
    std::vector<std::uint32_t> begin;  ///< per range, and one past the last
};

Dealt deal_out(const Soup& soup, const Context& context) {
    constexpr std::size_t points_a_range = 4096, most_ranges = 512;
    const std::size_t count = soup.facets.size(),
                      ranges = std::clamp(soup.points.size() / points_a_range, std::size_t{1}, most_ranges),
                      range = soup.points.size() / ranges + 1;
    const std::size_t chunk = std::max<std::size_t>(1 << 14, (count + 15) / 16),
                      chunks = (count + chunk - 1) / chunk;
    const auto range_of = [&](const mesh::Triangle& facet) {
        return std::min({facet[0], facet[1], facet[2]}) / range;
    };
    std::vector<std::uint32_t> place(chunks * ranges, 0);
    parallel_chunks(context, count, chunk, [&](std::size_t first, std::size_t last) {
        std::uint32_t* const counts = place.data() + first / chunk * ranges;
        for (std::size_t i = first; i < last; ++i) ++counts[range_of(soup.facets[i])];
    });
    Dealt dealt{UninitialisedVector<std::uint32_t>(count), {}};
    std::uint32_t sum = 0;
    for (std::size_t r = 0; r < ranges; ++r) {
        dealt.begin.push_back(sum);
        for (std::size_t c = 0; c < chunks; ++c) {
            const std::uint32_t size = place[c * ranges + r];
            place[c * ranges + r] = sum;
            sum += size;
        }
    }
    dealt.begin.push_back(sum);
    parallel_chunks(context, count, chunk, [&](std::size_t first, std::size_t last) {
        std::uint32_t* const next = place.data() + first / chunk * ranges;
        for (std::size_t i = first; i < last; ++i)
            dealt.facets[next[range_of(soup.facets[i])]++] = static_cast<std::uint32_t>(i);
    });
    return dealt;
}

struct Coincidence {
    std::uint32_t first, facet;
    friend auto operator<=>(const Coincidence&, const Coincidence&) = default;
};

/// Those of some facets that have the corners of one before them.
void find_repeated(const Soup& soup, std::span<const std::uint32_t> facets, std::vector<Coincidence>& found) {
    struct Slot {
        std::uint32_t facet, check;
    };
    std::vector<Slot> slots(std::bit_ceil(2 * facets.size() + 1), Slot{no_index, 0});
    const std::size_t mask = slots.size() - 1;
    for (const std::uint32_t facet : facets) {
        const std::uint64_t print = fingerprint(soup.facets[facet]);
        const auto check = static_cast<std::uint32_t>(print);
        std::size_t slot = (print >> 32) & mask;
        for (; slots[slot].facet != no_index; slot = (slot + 1) & mask) {
            const Slot& known = slots[slot];
            if (known.check != check ||
                !sorted(soup.facets[known.facet]).same_corners(sorted(soup.facets[facet])))
                continue;
            found.push_back({known.facet, facet});
            break;
        }
        if (slots[slot].facet == no_index) slots[slot] = {facet, check};
    }
}

std::vector<Coincidence> find_coincident(const Soup& soup, const Context& context) {
    const Dealt dealt = deal_out(soup, context);
    const std::size_t ranges = dealt.begin.size() - 1;
    std::vector<std::vector<Coincidence>> found(ranges);
    parallel_chunks(context, ranges, 1, [&](std::size_t r, std::size_t) {
        find_repeated(soup, {dealt.facets.data() + dealt.begin[r], dealt.begin[r + 1] - dealt.begin[r]},
                      found[r]);
    });
    std::vector<Coincidence> all;
    for (const std::vector<Coincidence>& part : found) all.insert(all.end(), part.begin(), part.end());
    parallel_sort(context, all);
    return all;
}

}  // namespace

void merge_coincident(Soup& soup, const Context& context) {
    const std::vector<Coincidence> coincident = find_coincident(soup, context);
    if (context.cancelled() || coincident.empty()) return;
    std::vector<char> dropped(soup.facets.size(), 0);
    // Neighbours mostly add up the same, which is told from what they add.
    using Terms = std::vector<std::pair<TransitionId, int>>;
    Terms terms, known;
    TransitionId known_sum = no_index;  // nothing is left
    TransitionSum sum;
    for (std::size_t i = 0, end; i < coincident.size(); i = end) {
        const std::uint32_t first = coincident[i].first;
        const bool odd = sorted(soup.facets[first]).odd;
        terms.assign(1, {soup.transition[first], 1});
        for (end = i; end < coincident.size() && coincident[end].first == first; ++end) {
            const std::uint32_t facet = coincident[end].facet;
            terms.push_back({soup.transition[facet], sorted(soup.facets[facet]).odd == odd ? 1 : -1});
            dropped[facet] = 1;
        }
        if (terms != known) {
            sum.clear();
            for (const auto& [transition, sign] : terms) sum.add(soup.transitions.of(transition), sign);
            const std::span<const Delta> total = sum.normalised();
            known_sum = total.empty() ? no_index : soup.transitions.intern(total);
            known.swap(terms);
        }
        if (known_sum == no_index)
            dropped[first] = 1;
        else
            soup.transition[first] = known_sum;
    }
    soup.coincident_facets += coincident.size();
    drop_facets(dropped, soup);
}

}  // namespace octavo::boolean
