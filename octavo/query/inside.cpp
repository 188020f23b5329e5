// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <octavo/base/parallel.hpp>
#include <octavo/octree/morton.hpp>
#include <octavo/query/inside.hpp>
#include <octavo/query/leaf_filter.hpp>
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

const InsideQuery::Entry* InsideQuery::top_cell(const Located& located) const {
    return &top_[located.code >> (3 * (octree::max_level - top_level_))];
}

/// The cell of the brick `entry` that holds the point; `level` is that of the brick's cells.
const InsideQuery::Entry* InsideQuery::brick_cell(Entry entry, const Located& located, int level) const {
    // Bricks may reach below the last level of a code, which then goes on with zeros.
    const int shift = 3 * (octree::max_level - level);
    const std::uint64_t within = shift >= 0 ? located.code >> shift : located.code << -shift;
    return &bricks_[std::size_t{entry & ~kind_mask} * brick_cells + (within & (brick_cells - 1))];
}

Side InsideQuery::test(const Leaf& leaf, const LatticePlace& place) const {
    const std::span<const std::uint32_t> references(references_.data() + leaf.begin, leaf.end - leaf.begin);
    std::array<double, 3> offset;
    for (std::size_t axis = 0; axis < 3; ++axis)
        offset[axis] = static_cast<double>(place.whole[axis] - leaf.low[axis]) + place.part[axis];
    if (const std::optional<int> change = winding_change(references, facets_, leaf.low, leaf.extent, offset))
        return leaf.winding + *change > 0 ? Side::inside : Side::outside;
    const LeafAnswer answer = test_in_leaf(place, leaf.low, leaf.winding, references, facets_, lattice_);
    return answer.on_facet ? Side::on : answer.winding > 0 ? Side::inside : Side::outside;
}

Side InsideQuery::operator()(Vec3 point) const {
    Located located;
    if (!place(point, located)) return Side::outside;
    Entry entry = *top_cell(located);
    for (int level = top_level_ + brick_levels; kind_of(entry) == brick; level += brick_levels)
        entry = *brick_cell(entry, located, level);
    if (kind_of(entry) != gray) return entry == black ? Side::inside : Side::outside;
    return test(leaves_[index_of(entry)], located.place);
}

/// Answers up to `block_size` points side by side: each round makes one load for every point that is still under way
/// and asks for what the next round will load, so that the cache misses of a round overlap.
void InsideQuery::answer_block(std::span<const Vec3> points, std::span<Side> sides) const {
    std::array<Located, block_size> located;
    std::array<const Entry*, block_size> cells;
    std::array<std::uint8_t, block_size> active, in_gray;
    std::size_t under_way = 0, gray_count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        sides[i] = Side::outside;
        if (!place(points[i], located[i])) continue;
        cells[i] = top_cell(located[i]);
        prefetch(cells[i]);
        active[under_way++] = static_cast<std::uint8_t>(i);
    }
    std::array<const Leaf*, block_size> leaves;
    for (int level = top_level_ + brick_levels; under_way > 0; level += brick_levels) {
        std::size_t still = 0;
        for (std::size_t k = 0; k < under_way; ++k) {
            const std::uint8_t i = active[k];
            const Entry entry = *cells[i];
            if (kind_of(entry) == brick) {
                cells[i] = brick_cell(entry, located[i], level);
                prefetch(cells[i]);
                active[still++] = i;
            } else if (kind_of(entry) == gray) {
                leaves[i] = &leaves_[index_of(entry)];
                prefetch(leaves[i]);
                in_gray[gray_count++] = i;
            } else {
                sides[i] = entry == black ? Side::inside : Side::outside;
            }
        }
        under_way = still;
    }
    for (std::size_t k = 0; k < gray_count; ++k) prefetch(references_.data() + leaves[in_gray[k]]->begin);
    for (std::size_t k = 0; k < gray_count; ++k) {
        const Leaf& leaf = *leaves[in_gray[k]];
        for (std::uint32_t r = leaf.begin; r < leaf.end; ++r) prefetch(&facets_[references_[r]]);
    }
    for (std::size_t k = 0; k < gray_count; ++k)
        sides[in_gray[k]] = test(*leaves[in_gray[k]], located[in_gray[k]].place);
}

std::vector<Side> InsideQuery::operator()(std::span<const Vec3> points, const Context& context) const {
    std::vector<Side> sides(points.size(), Side::outside);
    parallel_chunks(context, points.size(), 128 * block_size, [&](std::size_t begin, std::size_t end) {
        for (std::size_t first = begin; first < end; first += block_size) {
            const std::size_t count = std::min(block_size, end - first);
            answer_block(points.subspan(first, count), std::span(sides).subspan(first, count));
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
