// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/octree/cell.hpp>
#include <octavo/render/scene.hpp>

namespace octavo::render {
namespace {

using octree::Cell;
using octree::CellKey;

/// The leaves to draw, in Morton order; white ones and those beyond the cut are not among them.
struct Drawn {
    std::vector<CellKey> keys;
    std::vector<octree::Color> colors;

    /// Whether the whole of `cell` lies in one leaf that is drawn, so that a wall towards it cannot be seen.
    bool covers(CellKey cell) const {
        const auto after = std::upper_bound(keys.begin(), keys.end(), cell.last_descendant());
        return after != keys.begin() && std::prev(after)->contains(cell);
    }
};

bool holds(const Box3& box, Vec3 p) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(box.low[axis] < p[axis] && p[axis] < box.high[axis])) return false;
    return true;
}

Drawn drawn_leaves(const octree::Octree& tree, const OctreeSceneOptions& options) {
    Drawn drawn;
    tree.for_each_leaf([&](CellKey key, octree::Color color) {
        if (color == octree::Color::white) return;
        if (holds(options.removed, tree.lattice().to_world(Cell::of(key).centre()))) return;
        drawn.keys.push_back(key);
        drawn.colors.push_back(color);
    });
    return drawn;
}

/// The four corners of a cell's wall, counter-clockwise seen from outside; `high` is the wall at the high end of
/// `axis`.
std::array<Vec3, 4> wall(const exact::Lattice& lattice, const Cell& cell, int axis, bool high) {
    const exact::Point low = cell.low, top = cell.high();
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<Vec3, 4> corners;
    for (int corner = 0; corner < 4; ++corner) {
        const int turn = high ? corner : 3 - corner;
        std::array<std::int32_t, 3> p{};
        p[axis] = high ? top[axis] : low[axis];
        p[u] = turn == 1 || turn == 2 ? top[u] : low[u];
        p[v] = turn >= 2 ? top[v] : low[v];
        corners[corner] = lattice.to_world({p[0], p[1], p[2]});
    }
    return corners;
}

}  // namespace

Scene scene_of(const octree::Octree& tree, const OctreeSceneOptions& options) {
    const Drawn drawn = drawn_leaves(tree, options);
    Scene scene;
    for (std::size_t i = 0; i < drawn.keys.size(); ++i) {
        const Cell cell = Cell::of(drawn.keys[i]);
        const Color paint =
            drawn.colors[i] == octree::Color::black ? palette::black_cell : palette::gray_cell;
        for (int side = 0; side < 6; ++side) {
            const int axis = side / 2;
            const bool high = side % 2 != 0;
            const int step = high ? 1 : -1;
            const std::optional<CellKey> neighbour =
                drawn.keys[i].neighbour(axis == 0 ? step : 0, axis == 1 ? step : 0, axis == 2 ? step : 0);
            if (neighbour && drawn.covers(*neighbour)) continue;
            const std::array<Vec3, 4> c = wall(tree.lattice(), cell, axis, high);
            scene.facets.push_back({{c[0], c[1], c[2]}, paint, paint});
            scene.facets.push_back({{c[0], c[2], c[3]}, paint, paint});
            if (options.edges == EdgeLines::none) continue;
            const Color outline = mix(paint, palette::ink, 0.55F);
            for (int k = 0; k < 4; ++k) scene.lines.push_back({c[k], c[(k + 1) % 4], outline});
        }
    }
    return scene;
}

}  // namespace octavo::render
