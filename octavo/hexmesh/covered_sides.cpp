// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <optional>

#include <octavo/hexmesh/covered_sides.hpp>
#include <octavo/hexmesh/find_leaf.hpp>

namespace octavo::hexmesh {
namespace {

using octree::CellKey;

/// How many of the four octants of `beside`, which is split, at its side towards `axis` (`high`: the high one) are
/// kept.
int kept_at_side(const ClassifiedCells& cells, CellKey beside, unsigned axis, bool high) {
    int kept = 0;
    for (int octant = 0; octant < 8; ++octant) {
        if ((octant >> axis & 1) != int{high}) continue;
        const CellKey small = beside.child(octant);
        const auto at = std::lower_bound(cells.keys.begin(), cells.keys.end(), small);
        kept += at != cells.keys.end() && *at == small &&
                cells.set_of_cell[static_cast<std::size_t>(at - cells.keys.begin())] != 0;
    }
    return kept;
}

bool has_side_covered_in_part(const ClassifiedCells& cells, CellKey cell) {
    for (unsigned axis = 0; axis < 3; ++axis)
        for (const int step : {-1, 1}) {
            const std::optional<CellKey> beside =
                cell.neighbour(axis == 0 ? step : 0, axis == 1 ? step : 0, axis == 2 ? step : 0);
            if (!beside) continue;
            const auto first =
                std::lower_bound(cells.keys.begin(), cells.keys.end(), beside->first_descendant());
            const bool is_split = first != cells.keys.end() && beside->contains(*first) && *first != *beside;
            if (!is_split) continue;
            const int kept = kept_at_side(cells, *beside, axis, step < 0);
            if (kept > 0 && kept < 4) return true;
        }
    return false;
}

exact::Point moved(exact::Point p, unsigned axis, std::int32_t by) {
    (axis % 3 == 0 ? p.x : axis % 3 == 1 ? p.y : p.z) += by;
    return p;
}

/// The leaves round a point inside an edge along `axis`: whether some are smaller than `level`, and whether all are
/// kept.
struct RoundEdge {
    bool some_smaller = false, all_kept = true;
};
RoundEdge round_edge(const ClassifiedCells& cells, exact::Point p, unsigned axis, int level) {
    RoundEdge result;
    for (int quarter = 0; quarter < 4; ++quarter) {
        const exact::Point inside =
            moved(moved(p, axis + 1, quarter & 1 ? 0 : -1), axis + 2, quarter & 2 ? 0 : -1);
        const std::optional<std::size_t> leaf = find_leaf(cells.keys, inside);
        result.all_kept = result.all_kept && leaf && cells.set_of_cell[*leaf] != 0;
        result.some_smaller = result.some_smaller || (leaf && cells.keys[*leaf].level() > level);
    }
    return result;
}

bool has_edge_cut_off(const ClassifiedCells& cells, CellKey cell) {
    const std::int32_t side = cell.side(), quarter = side / 4;
    for (unsigned axis = 0; axis < 3; ++axis)
        for (int edge = 0; edge < 4; ++edge) {
            const exact::Point start =
                moved(moved(cell.low(), axis + 1, edge & 1 ? side : 0), axis + 2, edge & 2 ? side : 0);
            const RoundEdge low = round_edge(cells, moved(start, axis, quarter), axis, cell.level());
            const RoundEdge high = round_edge(cells, moved(start, axis, 3 * quarter), axis, cell.level());
            if ((low.some_smaller || high.some_smaller) && low.all_kept != high.all_kept) return true;
        }
    return false;
}

}  // namespace

std::vector<CellKey> cut_off_in_the_middle(const ClassifiedCells& cells) {
    int deepest = 0;
    for (const CellKey cell : cells.keys) deepest = std::max(deepest, cell.level());
    std::vector<CellKey> found;
    for (std::size_t i = 0; i < cells.keys.size(); ++i)
        if (cells.set_of_cell[i] != 0 && cells.keys[i].level() < deepest &&
            (has_side_covered_in_part(cells, cells.keys[i]) || has_edge_cut_off(cells, cells.keys[i])))
            found.push_back(cells.keys[i]);
    return found;
}

std::vector<CellKey> split(std::span<const CellKey> leaves, std::span<const CellKey> cells) {
    std::vector<CellKey> result;
    std::size_t next = 0;
    for (const CellKey leaf : leaves) {
        if (next == cells.size() || leaf != cells[next]) {
            result.push_back(leaf);
            continue;
        }
        for (int octant = 0; octant < 8; ++octant) result.push_back(leaf.child(octant));
        ++next;
    }
    return result;
}

}  // namespace octavo::hexmesh
