// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <octavo/base/parallel.hpp>
#include <octavo/octree/morton.hpp>
#include <octavo/query/inside.hpp>
#include <octavo/query/leaf_test.hpp>

namespace octavo::query {
namespace {

inline void prefetch(const void* address) { __builtin_prefetch(address); }

}  // namespace

/// A point in the universe: where it is and the Morton code of its cell of the last level.
struct InsideQuery::Located {
    LatticePlace place;
    std::uint64_t code;
};

/// False for points outside the universe, which are outside the solid; NaN and infinity among them.
bool InsideQuery::place(Vec3 point, Located& located) const {
    located.place.world = point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const double world = point[static_cast<int>(axis)];
        // Exact, but for underflow to zero, whose sign must not be lost, and overflow, which is outside anyway.
        const double scaled = world * inverse_unit_;
        const double floor = scaled == 0 && world < 0 ? -1.0 : std::floor(scaled);
        if (!(std::fabs(floor) <= 0x1p53)) return false;
        const std::int64_t whole = static_cast<std::int64_t>(floor) - lattice_.origin()[axis];
        if (whole < 0 || whole >= exact::universe_side) return false;
        located.place.whole[axis] = static_cast<std::int32_t>(whole);
        located.place.part[axis] = scaled - floor;
    }
    const auto& w = located.place.whole;
    located.code = octree::CellKey::at({w[0], w[1], w[2]}, octree::max_level).code();
    return true;
}

InsideQuery::Entry InsideQuery::top_entry(std::uint64_t code) const {
    return top_[code >> (3 * (octree::max_level - top_level_))];
}

Side InsideQuery::resolve(Entry entry, const Located& located) const {
    int shift = 3 * (octree::max_level - top_level_ - brick_levels);
    for (; (entry & kind_mask) == brick; shift -= 3 * brick_levels) {
        const std::uint64_t within = shift >= 0 ? located.code >> shift : located.code << -shift;
        entry = bricks_[std::size_t{entry & ~kind_mask} * brick_cells + (within & (brick_cells - 1))];
    }
    if ((entry & kind_mask) != gray) return entry == black ? Side::inside : Side::outside;
    const Leaf& leaf = leaves_[entry & ~kind_mask];
    const std::span<const std::uint32_t> references(references_.data() + leaf.begin, leaf.end - leaf.begin);
    const LeafAnswer answer =
        test_in_leaf(located.place, leaf.low, leaf.winding, references, facets_, lattice_);
    return answer.on_facet ? Side::on : answer.winding > 0 ? Side::inside : Side::outside;
}

Side InsideQuery::operator()(Vec3 point) const {
    Located located;
    if (!place(point, located)) return Side::outside;
    return resolve(top_entry(located.code), located);
}

std::vector<Side> InsideQuery::operator()(std::span<const Vec3> points, const Context& context) const {
    std::vector<Side> sides(points.size(), Side::outside);
    // So many points are under way at once; the machine follows 10 to 20 misses at a time.
    constexpr std::size_t block = 32;
    parallel_chunks(context, points.size(), 128 * block, [&](std::size_t begin, std::size_t end) {
        std::array<Located, block> located;
        std::array<std::uint32_t, block> index;
        std::array<Entry, block> entries;
        for (std::size_t first = begin; first < end; first += block) {
            const std::size_t last = std::min(first + block, end);
            std::size_t count = 0;
            for (std::size_t i = first; i < last; ++i) {
                index[count] = static_cast<std::uint32_t>(i - first);
                if (!place(points[i], located[count])) continue;
                prefetch(&top_[located[count].code >> (3 * (octree::max_level - top_level_))]);
                ++count;
            }
            for (std::size_t k = 0; k < count; ++k) {
                entries[k] = top_entry(located[k].code);
                const std::size_t at = entries[k] & ~kind_mask;
                const int shift = 3 * (octree::max_level - top_level_ - brick_levels);
                if ((entries[k] & kind_mask) == brick)
                    prefetch(&bricks_[at * brick_cells + (located[k].code >> shift & (brick_cells - 1))]);
                else if ((entries[k] & kind_mask) == gray)
                    prefetch(&leaves_[at]);
            }
            for (std::size_t k = 0; k < count; ++k) sides[first + index[k]] = resolve(entries[k], located[k]);
        }
    });
    return sides;
}

std::size_t InsideQuery::memory_bytes() const {
    return (top_.capacity() + bricks_.capacity()) * sizeof(Entry) + leaves_.capacity() * sizeof(Leaf) +
           references_.capacity() * sizeof(std::uint32_t) + facets_.capacity() * sizeof(classic::Facet);
}

Result<std::vector<Side>> contains(const mesh::Mesh& mesh, std::span<const Vec3> points,
                                   const InsideOptions& options, const Context& context) {
    const Result<InsideQuery> query = InsideQuery::build(mesh, options, context);
    if (!query) return query.error();
    return (*query)(points, context);
}

}  // namespace octavo::query
