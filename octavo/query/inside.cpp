// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <type_traits>

#include <octavo/base/parallel.hpp>
#include <octavo/octree/morton.hpp>
#include <octavo/query/inside.hpp>
#include <octavo/query/lattice_coordinate.hpp>
#include <octavo/query/leaf_filter.hpp>
#include <octavo/query/leaf_test.hpp>

namespace octavo::query {
namespace {

inline void prefetch(const void* address) { __builtin_prefetch(address); }

constexpr bool is_plain(CellIndex::Kind kind) { return kind < CellIndex::Kind::gray; }

/// Arithmetic, because which of the two it is nobody foretells: g++ turns a comparison with black into a branch,
/// whose mispredictions cost as much as all the rest of an answer.
constexpr Side side_of(CellIndex::Kind plain) {
    static_assert(static_cast<int>(CellIndex::Kind::white) == 0 && static_cast<int>(Side::outside) == 1);
    static_assert(static_cast<int>(CellIndex::Kind::black) == 1 && static_cast<int>(Side::inside) == -1);
    return static_cast<Side>(1 - 2 * static_cast<int>(plain));
}

}  // namespace

/// False for points outside the universe, which are outside the solid; NaN and infinity among them.
inline bool InsideQuery::place(Vec3 point, Located& located) const {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        LatticeCoordinate coordinate;
        if (!coordinate.split(point[static_cast<int>(axis)], inverse_unit_)) return false;
        const std::int64_t whole = coordinate.whole - lattice_.origin()[axis];
        if (whole < 0 || whole >= exact::universe_side) return false;
        located.whole[axis] = static_cast<std::int32_t>(whole);
        located.part[axis] = coordinate.part;
    }
    const auto& w = located.whole;
    located.code = octree::CellKey::at({w[0], w[1], w[2]}, octree::max_level).code();
    return true;
}

Side InsideQuery::test(const LeafRecord& leaf, Vec3 point, const Located& located) const {
    std::array<std::int32_t, 3> low;
    std::array<double, 3> offset;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = located.whole[axis] & -octree::cell_side(leaf.level);
        offset[axis] = static_cast<double>(located.whole[axis] - low[axis]) + located.part[axis];
    }
    if (const std::optional<int> change = winding_change(leaf.facets, facets_, low, leaf.extent, offset))
        return leaf.winding + *change > 0 ? Side::inside : Side::outside;
    const LatticePlace place{point, located.whole, located.part};
    const LeafAnswer answer = test_in_leaf(place, low, leaf.winding, leaf.facets, facets_, lattice_);
    return answer.on_facet ? Side::on : answer.winding > 0 ? Side::inside : Side::outside;
}

Side InsideQuery::operator()(Vec3 point) const {
    Located located;
    if (!place(point, located)) return Side::outside;
    const CellIndex::Kind kind = cells_.kind_of(located.code);
    if (is_plain(kind)) [[likely]]
        return side_of(kind);
    const CellIndex::Entry entry = cells_.find_below(cells_.top(located.code), located.code);
    if (is_plain(entry.kind)) return side_of(entry.kind);
    return test(LeafRecord::at(cells_.record(entry)), point, located);
}

InsideQuery::Begun InsideQuery::begin(Vec3 point) const {
    Begun begun;
    begun.point = point;
    if (!place(point, begun.located)) return begun;
    begun.kind = cells_.kind_of(begun.located.code);
    if (is_plain(begun.kind)) return begun;
    begun.entry = cells_.top(begun.located.code);
    if (begun.entry.kind == CellIndex::Kind::brick) cells_.prefetch_brick(begun.entry);
    return begun;
}

Side InsideQuery::finish(const Begun& begun) const {
    if (is_plain(begun.kind)) return side_of(begun.kind);
    const CellIndex::Entry entry = cells_.find_below(begun.entry, begun.located.code);
    if (is_plain(entry.kind)) return side_of(entry.kind);
    return test(LeafRecord::at(cells_.record(entry)), begun.point, begun.located);
}

/// Answers up to `block_size` points side by side: each round makes one load for every point that is still under way
/// and asks for what the next round will load, so that the cache misses of a round overlap.
void InsideQuery::answer_block(std::span<const Vec3> points, std::span<Side> sides) const {
    std::array<Located, block_size> located;
    std::array<CellIndex::Entry, block_size> entries;
    std::array<std::uint8_t, block_size> active, in_gray;
    std::size_t under_way = 0, gray_count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        sides[i] = Side::outside;
        if (!place(points[i], located[i])) continue;
        const CellIndex::Kind kind = cells_.kind_of(located[i].code);
        sides[i] = side_of(kind);
        cells_.prefetch_top(located[i].code);
        active[under_way] = static_cast<std::uint8_t>(i);
        under_way += !is_plain(kind);
    }
    // The first round looks into the table, the others into bricks.
    for (int level = cells_.top_level() - CellIndex::brick_levels; under_way > 0;
         level += CellIndex::brick_levels) {
        std::size_t still = 0;
        for (std::size_t k = 0; k < under_way; ++k) {
            const std::uint8_t i = active[k];
            const std::uint64_t code = located[i].code;
            entries[i] =
                level < cells_.top_level() ? cells_.top(code) : cells_.below(entries[i], code, level);
            switch (entries[i].kind) {
                case CellIndex::Kind::brick:
                    cells_.prefetch_brick(entries[i]);
                    active[still++] = i;
                    break;
                case CellIndex::Kind::gray:
                    prefetch(cells_.record(entries[i]));
                    in_gray[gray_count++] = i;
                    break;
                default:
                    sides[i] = side_of(entries[i].kind);
            }
        }
        under_way = still;
    }
    std::array<LeafRecord, block_size> leaves;
    for (std::size_t k = 0; k < gray_count; ++k) {
        leaves[k] = LeafRecord::at(cells_.record(entries[in_gray[k]]));
        for (const std::uint32_t facet : leaves[k].facets) prefetch(&facets_[facet]);
    }
    for (std::size_t k = 0; k < gray_count; ++k)
        sides[in_gray[k]] = test(leaves[k], points[in_gray[k]], located[in_gray[k]]);
}

template <class Point>
std::vector<Side> InsideQuery::answer(std::span<const Point> points, const Context& context) const {
    std::vector<Side> sides(points.size(), Side::outside);
    parallel_chunks(context, points.size(), 128 * block_size, [&](std::size_t begin, std::size_t end) {
        for (std::size_t first = begin; first < end; first += block_size) {
            const std::size_t count = std::min(block_size, end - first);
            const std::span<Side> block_sides = std::span(sides).subspan(first, count);
            if constexpr (std::is_same_v<Point, Vec3>) {
                answer_block(points.subspan(first, count), block_sides);
            } else {
                std::array<Vec3, block_size> block;
                for (std::size_t i = 0; i < count; ++i) {
                    const Point& p = points[first + i];
                    block[i] = {p[0], p[1], p[2]};
                }
                answer_block(std::span(block).first(count), block_sides);
            }
        }
    });
    return sides;
}

std::vector<Side> InsideQuery::operator()(std::span<const Vec3> points, const Context& context) const {
    return answer(points, context);
}

std::vector<Side> InsideQuery::operator()(std::span<const std::array<float, 3>> points,
                                          const Context& context) const {
    return answer(points, context);
}

std::size_t InsideQuery::memory_bytes() const {
    return cells_.memory_bytes() + facets_.capacity() * sizeof(classic::FacetCorners);
}

Result<std::vector<Side>> contains(const mesh::Mesh& mesh, std::span<const Vec3> points,
                                   const InsideOptions& options, const Context& context) {
    const Result<InsideQuery> query = InsideQuery::build(mesh, options, context);
    if (!query) return query.error();
    std::vector<Side> sides = (*query)(points, context);
    if (context.cancelled()) return Context::cancelled_error();
    return sides;
}

}  // namespace octavo::query
