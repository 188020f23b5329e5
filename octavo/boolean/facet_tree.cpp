// SPDX-License-Identifier: Apache-2.0
#if defined(__AVX2__)
#include <immintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <octavo/boolean/facet_tree.hpp>
#include <octavo/exact/bit_budget.hpp>

namespace octavo::boolean {
namespace {

/// Every third bit, beginning with the lowest, from the low 21 bits.
std::uint64_t spread(std::uint64_t bits) {
    bits &= 0x1fffff;
    bits = (bits | bits << 32) & 0x1f00000000ffffull;
    bits = (bits | bits << 16) & 0x1f0000ff0000ffull;
    bits = (bits | bits << 8) & 0x100f00f00f00f00full;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3ull;
    return (bits | bits << 2) & 0x1249249249249249ull;
}

struct Box {
    std::int32_t low[3], high[3];
};

Box box_of(const Soup& soup, std::uint32_t facet) {
    const mesh::Triangle& corners = soup.facets[facet];
    const exact::Point a = soup.points[corners[0]], b = soup.points[corners[1]], c = soup.points[corners[2]];
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min({a[axis], b[axis], c[axis]});
        box.high[axis] = std::max({a[axis], b[axis], c[axis]});
    }
    return box;
}

struct Keyed {
    std::uint64_t key;
    std::uint32_t facet;
};

/// Least significant digit first, 11 bits a pass over the key's upper 44 bits (a grid of 2^14 or 2^15 cells a
/// side); facets of one such cell are then sorted by the rest, in runs that are short but for clustered scenes.
void sort_by_key(std::vector<Keyed>& keyed) {
    constexpr int first_bit = 19, digit_bits = 11, digits = 1 << digit_bits;
    std::vector<Keyed> other(keyed.size());
    for (int shift = first_bit; shift < 63; shift += digit_bits) {
        std::array<std::uint32_t, digits + 1> begin{};
        for (const Keyed& item : keyed) ++begin[((item.key >> shift) & (digits - 1)) + 1];
        for (int digit = 0; digit < digits; ++digit) begin[digit + 1] += begin[digit];
        for (const Keyed& item : keyed) other[begin[(item.key >> shift) & (digits - 1)]++] = item;
        keyed.swap(other);
    }
    for (std::size_t i = 0, end; i < keyed.size(); i = end) {
        for (end = i + 1; end < keyed.size() && keyed[end].key >> first_bit == keyed[i].key >> first_bit;)
            ++end;
        if (end - i > FacetTree::width)
            std::stable_sort(keyed.begin() + static_cast<std::ptrdiff_t>(i),
                             keyed.begin() + static_cast<std::ptrdiff_t>(end),
                             [](const Keyed& a, const Keyed& b) { return a.key < b.key; });
    }
}

void set_empty(FacetTree::Node& node) {
    for (int axis = 0; axis < 3; ++axis)
        for (int lane = 0; lane < FacetTree::width; ++lane) {
            node.low[axis][lane] = std::numeric_limits<std::int32_t>::max();
            node.high[axis][lane] = std::numeric_limits<std::int32_t>::min();
        }
}

}  // namespace

FacetTree::FacetTree(const Soup& soup) : order_(soup.facets.size()) {
    const std::size_t count = order_.size();
    if (count == 0) return;
    std::vector<Keyed> keyed(count);
    for (std::uint32_t facet = 0; facet < count; ++facet) {
        const Box box = box_of(soup, facet);
        std::uint64_t key = 0;
        for (int axis = 0; axis < 3; ++axis) {
            // 21 of the 27 bits of low + high.
            const std::uint64_t centre =
                static_cast<std::uint64_t>(box.low[axis]) + static_cast<std::uint64_t>(box.high[axis]);
            key |= spread(centre >> 6) << axis;
        }
        keyed[facet] = {key, facet};
    }
    sort_by_key(keyed);
    leaves_.assign((count + width - 1) / width, Leaf{});
    for (std::size_t position = 0; position < count; ++position) {
        order_[position] = keyed[position].facet;
        Leaf& leaf = leaves_[position / width];
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = soup.facets[order_[position]][corner];
            leaf.corner[corner][position % width] = vertex;
            for (int axis = 0; axis < 3; ++axis)
                leaf.point[corner][axis][position % width] = soup.points[vertex][axis];
        }
    }

    std::size_t boxes = count;
    do {
        const std::size_t nodes = (boxes + width - 1) / width;
        std::vector<Node> level(nodes);
        set_empty(level.back());
        for (std::size_t box = 0; box < boxes; ++box) {
            Node& node = level[box / width];
            const std::size_t lane = box % width;
            if (levels_.empty()) {
                const Box bounds = box_of(soup, order_[box]);
                for (int axis = 0; axis < 3; ++axis) {
                    node.low[axis][lane] = bounds.low[axis];
                    node.high[axis][lane] = bounds.high[axis];
                }
            } else {
                const Node& child = levels_.back()[box];
                for (int axis = 0; axis < 3; ++axis) {
                    node.low[axis][lane] = *std::min_element(child.low[axis], child.low[axis] + width);
                    node.high[axis][lane] = *std::max_element(child.high[axis], child.high[axis] + width);
                }
            }
        }
        levels_.push_back(std::move(level));
        boxes = nodes;
    } while (boxes > 1);
}

unsigned FacetTree::meeting(const Node& node, const Node& other, int lane) {
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
    for (int k = 0; k < width; ++k) {
        bool both = true;
        for (int axis = 0; axis < 3; ++axis)
            both = both && node.low[axis][k] <= other.high[axis][lane] &&
                   other.low[axis][lane] <= node.high[axis][k];
        meets |= static_cast<unsigned>(both) << k;
    }
    return meets;
#endif
}

FacetTree::PlaneFilter::PlaneFilter(const Leaf& leaf, int lane) {
    exact::Point points[3];
    for (int k = 0; k < 3; ++k) {
        points[k] = {leaf.point[k][0][lane], leaf.point[k][1][lane], leaf.point[k][2][lane]};
        corner[k] = leaf.corner[k][lane];
    }
    const std::int64_t ux = points[1].x - points[0].x, uy = points[1].y - points[0].y,
                       uz = points[1].z - points[0].z;
    const std::int64_t vx = points[2].x - points[0].x, vy = points[2].y - points[0].y,
                       vz = points[2].z - points[0].z;
    normal[0] = static_cast<double>(uy * vz - uz * vy);
    normal[1] = static_cast<double>(uz * vx - ux * vz);
    normal[2] = static_cast<double>(ux * vy - uy * vx);
    static_assert(exact::budget::normal <= 53);
    bound = 0x1p-24 * (std::fabs(normal[0]) + std::fabs(normal[1]) + std::fabs(normal[2]));
    for (int axis = 0; axis < 3; ++axis) at[axis] = points[0][axis];
}

unsigned FacetTree::PlaneFilter::undecided(const Leaf& leaf) const {
    unsigned all_front = 0xff, all_back = 0xff;
    for (int k = 0; k < 3; ++k) {
        unsigned shared = 0, front = 0, back = 0;
#if defined(__AVX2__)
        const __m256i vertex = _mm256_load_si256(reinterpret_cast<const __m256i*>(leaf.corner[k]));
        __m256i equal = _mm256_setzero_si256();
        for (const std::uint32_t own : corner)
            equal =
                _mm256_or_si256(equal, _mm256_cmpeq_epi32(vertex, _mm256_set1_epi32(static_cast<int>(own))));
        shared = static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(equal)));
        __m256d low_half = _mm256_setzero_pd(), high_half = _mm256_setzero_pd();
        for (int axis = 0; axis < 3; ++axis) {
            const __m256i difference =
                _mm256_sub_epi32(_mm256_load_si256(reinterpret_cast<const __m256i*>(leaf.point[k][axis])),
                                 _mm256_set1_epi32(at[axis]));
            const __m256d factor = _mm256_set1_pd(normal[axis]);
            const __m256d first = _mm256_cvtepi32_pd(_mm256_castsi256_si128(difference));
            const __m256d second = _mm256_cvtepi32_pd(_mm256_extracti128_si256(difference, 1));
            low_half = _mm256_add_pd(low_half, _mm256_mul_pd(factor, first));
            high_half = _mm256_add_pd(high_half, _mm256_mul_pd(factor, second));
        }
        const __m256d limit = _mm256_set1_pd(bound), minus_limit = _mm256_set1_pd(-bound);
        const auto bits = [](__m256d first, __m256d second) {
            return static_cast<unsigned>(_mm256_movemask_pd(first)) |
                   static_cast<unsigned>(_mm256_movemask_pd(second)) << 4;
        };
        front = bits(_mm256_cmp_pd(low_half, limit, _CMP_GT_OQ), _mm256_cmp_pd(high_half, limit, _CMP_GT_OQ));
        back = bits(_mm256_cmp_pd(low_half, minus_limit, _CMP_LT_OQ),
                    _mm256_cmp_pd(high_half, minus_limit, _CMP_LT_OQ));
#else
        for (int lane = 0; lane < width; ++lane) {
            const std::uint32_t vertex = leaf.corner[k][lane];
            const bool is_shared = vertex == corner[0] || vertex == corner[1] || vertex == corner[2];
            double value = 0;
            for (int axis = 0; axis < 3; ++axis)
                value += normal[axis] * static_cast<double>(leaf.point[k][axis][lane] - at[axis]);
            shared |= static_cast<unsigned>(is_shared) << lane;
            front |= static_cast<unsigned>(value > bound) << lane;
            back |= static_cast<unsigned>(value < -bound) << lane;
        }
#endif
        all_front &= front | shared;
        all_back &= back | shared;
    }
    return ~(all_front | all_back) & 0xff;
}

std::vector<FacetTree::Task> FacetTree::pair_tasks(std::size_t count) const {
    std::vector<Task> tasks;
    if (levels_.empty()) return tasks;
    tasks.push_back({static_cast<std::uint32_t>(levels_.size() - 1), 0, 0});
    while (tasks.size() < count && tasks.front().level > 0) {
        std::vector<Task> finer;
        for (const Task& task : tasks) {
            for (std::uint32_t lane = 0; lane < width; ++lane) {
                unsigned hits = meeting(levels_[task.level][task.second], levels_[task.level][task.first],
                                        static_cast<int>(lane));
                if (task.first == task.second) hits &= ~0u << lane;
                for (; hits; hits &= hits - 1)
                    finer.push_back({task.level - 1, task.first * width + lane,
                                     task.second * width + static_cast<std::uint32_t>(__builtin_ctz(hits))});
            }
        }
        tasks.swap(finer);
    }
    return tasks;
}

}  // namespace octavo::boolean
