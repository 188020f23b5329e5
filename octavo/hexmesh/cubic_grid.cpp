// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/hexmesh/cubic_grid.hpp>

namespace octavo::hexmesh {
namespace {

constexpr std::int64_t bias = std::int64_t{1} << (CubicGrid::place_bits - 1);
constexpr std::uint64_t place_mask = (std::uint64_t{1} << CubicGrid::place_bits) - 1;

std::int64_t floor_third(std::int64_t value) { return value >= 0 ? value / 3 : -((2 - value) / 3); }

GridPlace parent_of(const GridPlace& place) {
    return {floor_third(place[0]), floor_third(place[1]), floor_third(place[2])};
}

/// Cells that share a face or an edge with a cell.
std::vector<GridPlace> make_neighbours() {
    std::vector<GridPlace> offsets;
    for (std::int64_t z = -1; z <= 1; ++z)
        for (std::int64_t y = -1; y <= 1; ++y)
            for (std::int64_t x = -1; x <= 1; ++x)
                if (const std::int64_t away = x * x + y * y + z * z; away == 1 || away == 2)
                    offsets.push_back({x, y, z});
    return offsets;
}

const std::vector<GridPlace>& neighbours() {
    static const std::vector<GridPlace> offsets = make_neighbours();
    return offsets;
}

GridPlace plus(const GridPlace& a, const GridPlace& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }

}  // namespace

CubicGrid::CubicGrid(int levels, std::uint64_t max_leaves)
    : max_leaves_(max_leaves), cut_(static_cast<std::size_t>(levels)), templates_(4096) {
    for (unsigned cut = 0; cut < 4096; ++cut) templates_[cut] = !cut_cell(static_cast<EdgeSet>(cut)).empty();
}

CubicGrid::Key CubicGrid::key_of(const GridPlace& place) {
    Key key = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
        key = key << place_bits | static_cast<std::uint64_t>(place[axis] + bias);
    return key;
}

GridPlace CubicGrid::place_of(Key key) {
    GridPlace place{};
    for (std::size_t axis = 3; axis-- > 0; key >>= place_bits)
        place[axis] = static_cast<std::int64_t>(key & place_mask) - bias;
    return place;
}

void CubicGrid::sort_roots() {
    std::sort(roots_.begin(), roots_.end());
    roots_.erase(std::unique(roots_.begin(), roots_.end()), roots_.end());
    sorted_roots_ = roots_.size();
    roots_to_sort_ = std::max(roots_to_sort_, 2 * sorted_roots_);
}

std::uint64_t CubicGrid::cut_above(int level, GridPlace place) {
    std::uint64_t fresh = 0;
    for (int above = level + 1; above <= last_level(); ++above, ++fresh) {
        place = parent_of(place);
        if (!cut_[static_cast<std::size_t>(above)].insert(key_of(place)).second) break;
    }
    return fresh;
}

bool CubicGrid::is_below_root(int level, GridPlace place) const {
    for (; level < last_level(); ++level) place = parent_of(place);
    return std::binary_search(roots_.begin(), roots_.end(), key_of(place));
}

EdgeSet CubicGrid::cut_edges(int level, const GridPlace& place) const {
    unsigned cut = 0;
    if (cut_[static_cast<std::size_t>(level)].empty()) return 0;
    for (const GridPlace& offset : neighbours()) {
        if (!is_cut(level, plus(place, offset))) continue;
        // Edges along each axis in which the neighbour does not lie away, at the ends where it does.
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (offset[axis] != 0) continue;
            const std::int64_t b = offset[(axis + 1) % 3], c = offset[(axis + 2) % 3];
            for (unsigned spot = 0; spot < 4; ++spot) {
                const bool at_b = b == 0 || (spot & 1) == (b > 0), at_c = c == 0 || (spot >> 1) == (c > 0);
                if (at_b && at_c) cut |= 1U << (4 * axis + spot);
            }
        }
    }
    return static_cast<EdgeSet>(cut);
}

void CubicGrid::close(const Context& context) {
    sort_roots();
    for (int level = 1; level <= last_level(); ++level) close_level(level, context);
}

/// Cells of the level that are cut, and their neighbours, exist: their parents are cut. Neighbours without a template
/// are cut themselves.
void CubicGrid::close_level(int level, const Context& context) {
    const std::unordered_set<Key>& cut = cut_[static_cast<std::size_t>(level)];
    std::vector<Key> open(cut.begin(), cut.end());
    while (!open.empty() && !is_full() && !context.cancelled()) {
        const GridPlace place = place_of(open.back());
        open.pop_back();
        close_beside(level, place, open);
    }
}

void CubicGrid::close_beside(int level, const GridPlace& place, std::vector<Key>& open) {
    const auto add_leaves = [&](const GridPlace& at, std::uint64_t cuts) {
        if (cuts > 0 && is_below_root(level, at)) leaves_cut_ += 26 * cuts;
    };
    add_leaves(place, cut_above(level, place));
    for (const GridPlace& offset : neighbours()) {
        const GridPlace next = plus(place, offset);
        add_leaves(next, cut_above(level, next));
        if (is_cut(level, next) || has_template(cut_edges(level, next))) continue;
        cut_[static_cast<std::size_t>(level)].insert(key_of(next));
        add_leaves(next, 1);
        open.push_back(key_of(next));
    }
}

}  // namespace octavo::hexmesh
