// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include <octavo/base/parallel.hpp>
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
    const std::size_t chunk = std::max<std::size_t>(1 << 12, (count + 15) / 16),
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
    bool turned;  ///< the facet is, seen from the first
    bool operator<(const Coincidence& other) const {
        return first != other.first ? first < other.first : facet < other.facet;
    }
};

/// Those of some facets that have the corners of one before them; sorted.
std::vector<Coincidence> find_repeated(const Soup& soup, std::span<const std::uint32_t> facets) {
    struct Slot {
        std::uint32_t facet, check;
    };
    std::vector<Slot> slots(std::bit_ceil(2 * facets.size() + 1), Slot{no_index, 0});
    std::vector<Coincidence> found;
    const std::size_t mask = slots.size() - 1;
    for (const std::uint32_t facet : facets) {
        const std::uint64_t print = fingerprint(soup.facets[facet]);
        const auto check = static_cast<std::uint32_t>(print);
        std::size_t slot = (print >> 32) & mask;
        for (; slots[slot].facet != no_index; slot = (slot + 1) & mask) {
            if (slots[slot].check != check) continue;
            const SortedCorners known = sorted(soup.facets[slots[slot].facet]),
                                here = sorted(soup.facets[facet]);
            if (!known.same_corners(here)) continue;
            found.push_back({slots[slot].facet, facet, known.odd != here.odd});
            break;
        }
        if (slots[slot].facet == no_index) slots[slot] = {facet, check};
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// What is to be added up where facets coincide.
using Terms = std::vector<std::pair<TransitionId, int>>;

/// The facets of a range that coincide.
struct Merged {
    std::vector<Coincidence> repeated;
    std::vector<Terms> sums;  ///< neighbours mostly have the same
    std::vector<std::pair<std::uint32_t, std::uint32_t>>
        first;  ///< of those that coincide, and which of the sums
};

Merged merge_range(const Soup& soup, std::span<const std::uint32_t> facets) {
    Merged merged{find_repeated(soup, facets), {}, {}};
    const std::vector<Coincidence>& repeated = merged.repeated;
    Terms terms;
    for (std::size_t i = 0, end; i < repeated.size(); i = end) {
        const std::uint32_t first = repeated[i].first;
        terms.assign(1, {soup.transition[first], 1});
        for (end = i; end < repeated.size() && repeated[end].first == first; ++end)
            terms.push_back({soup.transition[repeated[end].facet], repeated[end].turned ? -1 : 1});
        if (merged.sums.empty() || terms != merged.sums.back()) merged.sums.push_back(terms);
        merged.first.push_back({first, static_cast<std::uint32_t>(merged.sums.size() - 1)});
    }
    return merged;
}

}  // namespace

void merge_coincident(Soup& soup, const Context& context) {
    const Dealt dealt = deal_out(soup, context);
    std::vector<Merged> merged(dealt.begin.size() - 1);
    parallel_chunks(context, merged.size(), 1, [&](std::size_t r, std::size_t) {
        const std::span<const std::uint32_t> facets(dealt.facets);
        merged[r] = merge_range(soup, facets.subspan(dealt.begin[r], dealt.begin[r + 1] - dealt.begin[r]));
    });
    if (context.cancelled()) return;
    // no_index where nothing is left.
    std::vector<std::vector<TransitionId>> sums(merged.size());
    TransitionSum sum;
    std::size_t count = 0;
    for (std::size_t r = 0; r < merged.size(); ++r) {
        count += merged[r].repeated.size();
        for (const Terms& terms : merged[r].sums) {
            sum.clear();
            for (const auto& [transition, sign] : terms) sum.add(soup.transitions.of(transition), sign);
            const std::span<const Delta> total = sum.normalised();
            sums[r].push_back(total.empty() ? no_index : soup.transitions.intern(total));
        }
    }
    if (count == 0) return;
    std::vector<char> dropped(soup.facets.size(), 0);
    parallel_chunks(context, merged.size(), 1, [&](std::size_t r, std::size_t) {
        for (const Coincidence& each : merged[r].repeated) dropped[each.facet] = 1;
        for (const auto& [first, which] : merged[r].first) {
            if (sums[r][which] == no_index)
                dropped[first] = 1;
            else
                soup.transition[first] = sums[r][which];
        }
    });
    soup.coincident_facets += count;
    drop_facets(dropped, soup, context);
}

}  // namespace octavo::boolean
