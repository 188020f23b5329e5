// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include <octavo/hexmesh/find_leaf.hpp>
#include <octavo/hexmesh/walls.hpp>

namespace octavo::hexmesh {
namespace {

using octree::CellKey;

/// Coordinates, per axis and sorted, of facets in planes that can hold walls of cells which are too large.
class Planes {
  public:
    Planes(std::span<const SolidFacets> solids, const SizeField& sizes) {
        for (mesh::SolidIndex solid = 0; solid < solids.size(); ++solid) {
            const int level = sizes.surface_level(solid);
            if (level == 0) continue;
            const std::int32_t least_too_large = octree::cell_side(level - 1);
            for (const classic::Facet& facet : solids[solid].facets)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    if (facet.low[axis] == facet.high[axis] && facet.low[axis] % least_too_large == 0)
                        at_[axis].push_back(facet.low[axis]);
        }
        for (std::vector<std::int32_t>& at : at_) {
            std::sort(at.begin(), at.end());
            at.erase(std::unique(at.begin(), at.end()), at.end());
        }
    }
    bool none() const { return at_[0].empty() && at_[1].empty() && at_[2].empty(); }
    bool has(int axis, std::int32_t coordinate) const {
        const std::vector<std::int32_t>& at = at_[static_cast<std::size_t>(axis)];
        return std::binary_search(at.begin(), at.end(), coordinate);
    }

  private:
    std::array<std::vector<std::int32_t>, 3> at_;
};

bool contains(const std::vector<mesh::SolidIndex>& solids, mesh::SolidIndex solid) {
    return std::find(solids.begin(), solids.end(), solid) != solids.end();
}

class WallRefinement {
  public:
    WallRefinement(const ClassifiedCells& cells, const Planes& planes, const SizeField& sizes, Keep keep)
        : sets_(cells.sets),
          planes_(planes),
          sizes_(sizes),
          keep_(keep),
          keys_(cells.keys),
          set_of_cell_(cells.set_of_cell) {}

    /// The cells that are too large for a surface in one of their walls, by index; `at_walls` of all with such a wall.
    std::vector<std::size_t> find_too_large() {
        at_walls_.clear();
        too_large_.clear();
        for (std::size_t cell = 0; cell < keys_.size(); ++cell) look_round(cell);
        for (std::vector<std::size_t>* found : {&at_walls_, &too_large_}) {
            std::sort(found->begin(), found->end());
            found->erase(std::unique(found->begin(), found->end()), found->end());
        }
        return too_large_;
    }

    /// Their octants in place of these cells, which are sorted.
    void split(const std::vector<std::size_t>& cells) {
        std::vector<CellKey> keys;
        std::vector<std::uint16_t> sets;
        keys.reserve(keys_.size() + 7 * cells.size());
        sets.reserve(keys_.size() + 7 * cells.size());
        auto next = cells.begin();
        for (std::size_t cell = 0; cell < keys_.size(); ++cell) {
            const bool is_split = next != cells.end() && *next == cell;
            for (int octant = 0; octant < (is_split ? 8 : 1); ++octant) {
                keys.push_back(is_split ? keys_[cell].child(octant) : keys_[cell]);
                sets.push_back(set_of_cell_[cell]);
            }
            next += is_split;
        }
        keys_ = std::move(keys);
        set_of_cell_ = std::move(sets);
    }

    std::size_t cell_count() const { return keys_.size(); }
    RefinedAtWalls take() && {
        RefinedAtWalls refined;
        for (const std::size_t cell : at_walls_) refined.cells.push_back(keys_[cell]);
        refined.keys = std::move(keys_);
        return refined;
    }

  private:
    /// Looks at the walls of a cell towards cells that are not smaller: of two cells one sees the other.
    void look_round(std::size_t cell) {
        const exact::Point low = keys_[cell].low();
        const std::int32_t side = keys_[cell].side();
        for (int axis = 0; axis < 3; ++axis)
            for (const bool up : {false, true}) {
                if (!planes_.has(axis, low[axis] + (up ? side : 0))) continue;
                exact::Point across = low;
                (axis == 0 ? across.x : axis == 1 ? across.y : across.z) += up ? side : -1;
                const std::optional<std::size_t> other = find_leaf(keys_, across);
                if (!other || keys_[*other].level() > keys_[cell].level()) continue;
                const int level = level_between(sets_[set_of_cell_[cell]], sets_[set_of_cell_[*other]]);
                if (level > 0) note(cell, level), note(*other, level);
            }
    }

    /// The least level of cells beside a wall between cells of these sets; 0 when no surface lies in it.
    int level_between(const mesh::SolidSet& one, const mesh::SolidSet& other) const {
        int level = 0;
        for (const auto& [here, there] : {std::pair(&one, &other), std::pair(&other, &one)})
            for (const mesh::SolidIndex solid : here->inside)
                if (!contains(there->inside, solid) && !contains(there->boundary, solid))
                    level = std::max(level, sizes_.surface_level(solid));
        return level;
    }

    void note(std::size_t cell, int level) {
        if (set_of_cell_[cell] == 0 && keep_ != Keep::all) return;
        at_walls_.push_back(cell);
        if (keys_[cell].level() < level) too_large_.push_back(cell);
    }

    const std::vector<mesh::SolidSet>& sets_;
    const Planes& planes_;
    const SizeField& sizes_;
    Keep keep_;
    std::vector<CellKey> keys_;
    std::vector<std::uint16_t> set_of_cell_;  // of the cells that `keys_` were split from
    std::vector<std::size_t> at_walls_, too_large_;
};

}  // namespace

Result<RefinedAtWalls> refine_at_walls(const ClassifiedCells& cells, std::span<const SolidFacets> solids,
                                       const SizeField& sizes, const Options& options,
                                       const Context& context) {
    if (!options.refine_at_walls) return RefinedAtWalls{cells.keys, {}};
    const Planes planes(solids, sizes);
    if (planes.none()) return RefinedAtWalls{cells.keys, {}};
    WallRefinement refinement(cells, planes, sizes, options.keep);
    for (;;) {
        if (context.cancelled()) return Context::cancelled_error();
        const std::vector<std::size_t> too_large = refinement.find_too_large();
        if (too_large.empty()) return std::move(refinement).take();
        if (refinement.cell_count() + 7 * too_large.size() > options.max_cells)
            return too_many_cells(options.max_cells);
        refinement.split(too_large);
    }
}

}  // namespace octavo::hexmesh
