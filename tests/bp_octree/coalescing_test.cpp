// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include <octavo/bp_octree/build.hpp>
#include <octavo/bp_octree/certify.hpp>
#include <octavo/bp_octree/triangle_cell.hpp>

#include "bp_octree/solids.hpp"

namespace octavo::bp_octree {
namespace {

using octree::Cell;
using octree::CellKey;
using octree::Node;
using Faces = std::set<mesh::FaceIndex>;
using Cells = std::map<CellKey, Faces>;

constexpr int depth = 4;

/// All cells of the deepest level that triangles meet, by trying every pair.
Cells deepest_cells(const mesh::LatticeMesh& mesh, const Frame& frame) {
    Cells cells;
    for (mesh::FaceIndex face = 0; face < mesh.triangles.size(); ++face) {
        const mesh::Triangle& t = mesh.triangles[face];
        const TriangleInCells triangle(mesh.points[t[0]], mesh.points[t[1]], mesh.points[t[2]]);
        for (std::uint64_t code = 0; code < std::uint64_t{1} << 3 * depth; ++code) {
            const CellKey key = CellKey::from_code(code << 3 * (octree::max_level - depth), depth);
            if (triangle.meets(frame.box(Cell::of(key)))) cells[key].insert(face);
        }
    }
    return cells;
}

/// As the thesis says it: siblings that are all leaves are joined where `joins` says so, from below.
Cells joined_from_below(Cells leaves,
                        const std::function<bool(const std::vector<Faces>&, const Faces&)>& joins) {
    std::set<CellKey> split;
    for (int level = depth; level > 0; --level) {
        std::map<CellKey, std::vector<CellKey>> families;
        for (const auto& [key, faces] : leaves)
            if (key.level() == level) families[key.parent()].push_back(key);
        for (const CellKey& key : split)
            if (key.level() == level) families[key.parent()].push_back(key);
        for (const auto& [parent, octants] : families) {
            std::vector<Faces> sets;
            Faces all;
            bool has_split = false;
            for (const CellKey& octant : octants) {
                has_split |= split.count(octant) > 0;
                if (has_split) break;
                sets.push_back(leaves[octant]);
                all.insert(leaves[octant].begin(), leaves[octant].end());
            }
            if (has_split || !joins(sets, all)) {
                split.insert(parent);
                continue;
            }
            for (const CellKey& octant : octants) leaves.erase(octant);
            leaves[parent] = all;
        }
    }
    return leaves;
}

Cells leaves_of(const BpOctree& tree) {
    Cells leaves;
    const std::function<void(NodeIndex, const Cell&)> visit = [&](NodeIndex node, const Cell& cell) {
        if (tree.nodes[node] == Node::gray) {
            const auto faces = tree.triangles_of(node);
            leaves[cell.key()] = Faces(faces.begin(), faces.end());
        }
        if (tree.nodes[node] != Node::split) return;
        for (unsigned i = 0; i < 8; ++i) visit(tree.link[node] + i, cell.child(static_cast<int>(i)));
    };
    visit(0, Cell::root());
    return leaves;
}

TEST(Coalescing, LeavesAreThoseThatJoiningFromBelowGives) {
    const mesh::LatticeMesh mesh = tests::on_lattice(tests::bumpy_sphere(3));
    BuildOptions options;
    options.depth = depth;
    const auto built = [&] {
        auto tree = build(mesh, options);
        EXPECT_TRUE(tree.has_value());
        EXPECT_TRUE(certify(*tree).has_value());
        return std::move(tree).value();
    };
    options.coalescing = Coalescing::none;
    const BpOctree all = built();
    const Cells cells = deepest_cells(all.mesh, all.frame);
    EXPECT_EQ(leaves_of(all), cells);

    options.coalescing = Coalescing::count;
    for (const std::size_t most : {1, 7, 20, 1000}) {
        options.leaf_triangles = most;
        EXPECT_EQ(leaves_of(built()), joined_from_below(cells, [&](const auto&, const Faces& joined) {
                      return joined.size() <= most;
                  }));
    }
    const auto sum_of = [](const std::vector<Faces>& octants) {
        std::size_t sum = 0;
        for (const Faces& octant : octants) sum += octant.size();
        return sum;
    };
    options.coalescing = Coalescing::sum;
    for (const std::size_t most : {1, 9, 30, 5000}) {
        options.leaf_triangles = most;
        const auto joins = [&](const std::vector<Faces>& octants, const Faces&) {
            return sum_of(octants) <= most;
        };
        EXPECT_EQ(leaves_of(built()), joined_from_below(cells, joins));
    }
    options.coalescing = Coalescing::mean;
    std::set<std::size_t> sizes;
    for (const double least : {0.5, 2.0, 5.5, 12.0, 1e6}) {
        options.least_mean = least;
        const Cells leaves = leaves_of(built());
        const auto joins = [&](const std::vector<Faces>& octants, const Faces&) {
            return static_cast<double>(sum_of(octants)) < least * static_cast<double>(octants.size());
        };
        EXPECT_EQ(leaves, joined_from_below(cells, joins));
        sizes.insert(leaves.size());
    }
    EXPECT_EQ(sizes.size(), 5U);
    EXPECT_EQ(*sizes.begin(), 1U);
}

}  // namespace
}  // namespace octavo::bp_octree
