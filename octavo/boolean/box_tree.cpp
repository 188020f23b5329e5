// SPDX-License-Identifier: Apache-2.0
#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <limits>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/box_tree.hpp>
#include <octavo/octree/morton.hpp>

namespace octavo::boolean {
namespace {

constexpr std::size_t grain = 1 << 12;

using Keyed = BoxTree::Keyed;

/// Twice the centre of a box, 27 bits a coordinate.
std::array<std::uint32_t, 3> doubled_centre(const FacetBox& box) {
    return {static_cast<std::uint32_t>(box.low.x + box.high.x),
            static_cast<std::uint32_t>(box.low.y + box.high.y),
            static_cast<std::uint32_t>(box.low.z + box.high.z)};
}

// 10 of the 27 bits of an axis: a third of the memory traffic of sorting by full keys, and enough to tell the facets of
// a million from one another where they are spread evenly.
constexpr int key_bits = 10, drop_bits = exact::coordinate_bits + 1 - key_bits;

/// Least significant digit first. Each chunk of the input counts and writes for itself, so that chunks may run at
/// the same time and the order never depends on that.
void sort_by_key(UninitialisedVector<Keyed>& keyed, const Context& context) {
    constexpr int digit_bits = key_bits, digits = 1 << digit_bits;
    const std::size_t chunk = std::max<std::size_t>(grain, (keyed.size() + 15) / 16),
                      chunks = (keyed.size() + chunk - 1) / chunk;
    UninitialisedVector<Keyed> other(keyed.size());
    std::vector<std::array<std::uint32_t, digits>> places(chunks);
    for (int shift = 0; shift < 3 * key_bits; shift += digit_bits) {
        parallel_chunks(context, keyed.size(), chunk, [&](std::size_t begin, std::size_t end) {
            std::array<std::uint32_t, digits>& count = places[begin / chunk];
            count.fill(0);
            for (std::size_t i = begin; i < end; ++i) ++count[keyed[i].key >> shift & (digits - 1)];
        });
        std::uint32_t sum = 0;
        for (int digit = 0; digit < digits; ++digit)
            for (std::array<std::uint32_t, digits>& place : places) {
                const std::uint32_t count = place[digit];
                place[digit] = sum;
                sum += count;
            }
        parallel_chunks(context, keyed.size(), chunk, [&](std::size_t begin, std::size_t end) {
            std::array<std::uint32_t, digits>& place = places[begin / chunk];
            for (std::size_t i = begin; i < end; ++i)
                other[place[keyed[i].key >> shift & (digits - 1)]++] = keyed[i];
        });
        keyed.swap(other);
    }
}

/// Sorts the runs of equal keys that begin in a chunk by the bits that the keys have dropped; runs are short but for
/// clustered scenes.
void sort_runs(const Soup& soup, std::span<const exact::Point> places, UninitialisedVector<Keyed>& keyed,
               std::size_t begin, std::size_t end) {
    struct Fine {
        std::uint64_t key;
        std::uint32_t facet;
    };
    std::vector<Fine> run;
    while (begin > 0 && begin < end && keyed[begin].key == keyed[begin - 1].key) ++begin;
    for (std::size_t i = begin, after; i < end; i = after) {
        for (after = i + 1; after < keyed.size() && keyed[after].key == keyed[i].key;) ++after;
        if (after - i <= BoxTree::width) continue;
        run.clear();
        for (std::size_t k = i; k < after; ++k) {
            const auto [x, y, z] = doubled_centre({soup.facets[keyed[k].facet], places});
            constexpr std::uint32_t mask = (1u << drop_bits) - 1;
            run.push_back({octree::interleave(x & mask, y & mask, z & mask), keyed[k].facet});
        }
        std::stable_sort(run.begin(), run.end(), [](const Fine& a, const Fine& b) { return a.key < b.key; });
        for (std::size_t k = i; k < after; ++k) keyed[k].facet = run[k - i].facet;
    }
}

using Margin = std::array<std::int32_t, 3>;

void set_box(BoxNode& node, std::size_t lane, const FacetBox& box, const Margin& margin) {
    for (int axis = 0; axis < 3; ++axis) {
        node.low[axis][lane] = box.low[axis] - margin[static_cast<std::size_t>(axis)];
        node.high[axis][lane] = box.high[axis] + margin[static_cast<std::size_t>(axis)];
    }
}

/// All eight, of the facets where they are.
void set_boxes(BoxNode& node, const FacetBlock& block, const Margin& margin) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (int lane = 0; lane < BoxNode::width; ++lane) {
            const std::int32_t a = block.point[0][axis][lane], b = block.point[1][axis][lane],
                               c = block.point[2][axis][lane];
            node.low[axis][lane] = std::min(a, std::min(b, c)) - margin[axis];
            node.high[axis][lane] = std::max(a, std::max(b, c)) + margin[axis];
        }
}

void set_empty(BoxNode& node, int lane) {
    for (int axis = 0; axis < 3; ++axis) {
        node.low[axis][lane] = std::numeric_limits<std::int32_t>::max();
        node.high[axis][lane] = std::numeric_limits<std::int32_t>::min();
    }
}

}  // namespace

std::uint32_t BoxTree::key_of(const FacetBox& box) {
    const auto [x, y, z] = doubled_centre(box);
    return static_cast<std::uint32_t>(octree::interleave(x >> drop_bits, y >> drop_bits, z >> drop_bits));
}

BoxTree::BoxTree(const Soup& soup, std::vector<std::uint32_t> facets, std::int32_t margin,
                 const Context& context) {
    UninitialisedVector<Keyed> keyed(facets.size());
    parallel_chunks(context, keyed.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            keyed[i] = {key_of({soup.facets[facets[i]], soup.points}), facets[i]};
        }
    });
    *this = BoxTree(soup, std::move(keyed), {soup.points, {margin, margin, margin}}, context);
}

BoxTree::BoxTree(const Soup& soup, UninitialisedVector<Keyed> keyed, const Room& room, const Context& context,
                 std::span<const char> spread) {
    if (keyed.empty()) return;
    sort_by_key(keyed, context);
    parallel_chunks(context, keyed.size(), grain, [&](std::size_t begin, std::size_t end) {
        sort_runs(soup, room.places, keyed, begin, end);
    });
    facets_.resize(keyed.size());
    parallel_chunks(context, keyed.size(), grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) facets_[i] = keyed[i].facet;
    });
    keyed = {};
    fill_blocks(soup, room, spread, context);
    build_levels(context);
}

void BoxTree::fill_blocks(const Soup& soup, const Room& room, std::span<const char> spread,
                          const Context& context) {
    const bool is_upright = room.places.data() == soup.points.data();
    const std::size_t count = (facets_.size() + width - 1) / width;
    blocks_.resize(count);
    levels_.emplace_back(count);
    // What is left of the last block repeats its last facet; its boxes are empty.
    const auto corners_at = [&](std::size_t number, std::size_t lane) -> const mesh::Triangle& {
        return soup.facets[facets_[std::min(number * width + lane, facets_.size() - 1)]];
    };
    parallel_chunks(context, count, grain / width, [&](std::size_t begin, std::size_t end) {
        for (std::size_t number = begin; number < end; ++number) {
            FacetBlock& block = blocks_[number];
            BoxNode& node = levels_[0][number];
            for (std::size_t lane = 0; lane < width; ++lane) {
                const mesh::Triangle& corners = corners_at(number, lane);
                for (int corner = 0; corner < 3; ++corner) {
                    const exact::Point point = soup.points[corners[corner]];
                    const std::uint32_t vertex = corners[corner];
                    block.corner[corner][lane] =
                        !spread.empty() && spread[vertex] ? vertex | FacetBlock::spread : vertex;
                    block.point[corner][0][lane] = point.x;
                    block.point[corner][1][lane] = point.y;
                    block.point[corner][2][lane] = point.z;
                }
            }
            if (is_upright)
                set_boxes(node, block, room.margin);
            else
                for (std::size_t lane = 0; lane < width; ++lane)
                    set_box(node, lane, {corners_at(number, lane), room.places}, room.margin);
        }
    });
    for (std::size_t lane = facets_.size() - (count - 1) * width; lane < width; ++lane)
        set_empty(levels_[0].back(), static_cast<int>(lane));
}

void BoxTree::build_levels(const Context& context) {
    while (levels_.back().size() > 1) {
        const UninitialisedVector<BoxNode>& children = levels_.back();
        UninitialisedVector<BoxNode> level((children.size() + width - 1) / width);
        for (int lane = 0; lane < width; ++lane) set_empty(level.back(), lane);
        parallel_chunks(context, level.size(), grain / width, [&](std::size_t begin, std::size_t end) {
            for (std::size_t child = begin * width; child < std::min(end * width, children.size()); ++child)
                for (int axis = 0; axis < 3; ++axis) {
                    const BoxNode& from = children[child];
                    BoxNode& to = level[child / width];
                    to.low[axis][child % width] = *std::min_element(from.low[axis], from.low[axis] + width);
                    to.high[axis][child % width] =
                        *std::max_element(from.high[axis], from.high[axis] + width);
                }
        });
        levels_.push_back(std::move(level));
    }
}

unsigned meeting(const BoxNode& node, const BoxNode& other, int lane) {
#if defined(__AVX2__)
    __m256i apart = _mm256_setzero_si256();
    for (int axis = 0; axis < 3; ++axis) {
        const __m256i low = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.low[axis]));
        const __m256i high = _mm256_load_si256(reinterpret_cast<const __m256i*>(node.high[axis]));
        const __m256i other_low = _mm256_set1_epi32(other.low[axis][lane]);
        const __m256i other_high = _mm256_set1_epi32(other.high[axis][lane]);
        apart = _mm256_or_si256(
            apart, _mm256_or_si256(_mm256_cmpgt_epi32(low, other_high), _mm256_cmpgt_epi32(other_low, high)));
    }
    return ~static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(apart))) & 0xffu;
#else
    unsigned meets = 0;
    for (int k = 0; k < BoxNode::width; ++k) {
        bool both = true;
        for (int axis = 0; axis < 3; ++axis)
            both = both && node.low[axis][k] <= other.high[axis][lane] &&
                   other.low[axis][lane] <= node.high[axis][k];
        meets |= static_cast<unsigned>(both) << k;
    }
    return meets;
#endif
}

}  // namespace octavo::boolean
