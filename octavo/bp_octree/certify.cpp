// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <numeric>
#include <string>

#include <octavo/bp_octree/cell_split.hpp>
#include <octavo/bp_octree/certify.hpp>
#include <octavo/bp_octree/node_content.hpp>
#include <octavo/classic/closed_surface.hpp>

namespace octavo::bp_octree {
namespace {

using octree::Cell;
using octree::Node;

class Certificate {
  public:
    Certificate(const BpOctree& tree, const Context& context)
        : tree_(tree), context_(context), buffers_(tree.levels.size()) {}

    Status run() {
        if (tree_.is_solid != classic::open_edges(tree_.mesh).empty())
            return wrong("the tree is wrong about whether its triangles are closed");
        std::vector<mesh::FaceIndex> all(tree_.mesh.triangles.size());
        std::iota(all.begin(), all.end(), 0U);
        return visit(0, Cell::root(), all, 0, 0);
    }

  private:
    static Error wrong(std::string sentence) { return {ErrorCode::bad_input, std::move(sentence), {}}; }
    static Error wrong(NodeIndex node, const char* what) {
        return wrong("node " + std::to_string(node) + " of the BP-octree " + what);
    }

    /// `inside` and `at_low` are the corner labels and the winding number at the low corner.
    Status visit(NodeIndex node, const Cell& cell, const std::vector<mesh::FaceIndex>& triangles,
                 std::uint8_t inside, std::int32_t at_low) {
        if (context_.cancelled()) return Context::cancelled_error();
        const Node kind = tree_.nodes[node];
        if (kind == Node::white || kind == Node::black) {
            if (!triangles.empty()) return wrong(node, "has a colour although the surface meets it");
            if ((kind == Node::black) != (at_low > 0)) return wrong(node, "has the wrong colour");
            return Done{};
        }
        if (triangles.empty()) return wrong(node, "has no colour although the surface does not meet it");
        const CellBox box = tree_.frame.box(cell);
        content_.gather(tree_.mesh, box, triangles, inside);
        // A plane at the far corner of its cell cuts nothing of it, though rounded supports may lie beyond.
        for (const BoundingPlane& plane : tree_.planes_of(node))
            if (plane.offset < largest_offset && !content_.points().empty() &&
                content_.points().support(direction_of(plane.direction)) > plane.reach())
                return wrong(node, "has a plane that cuts the solid");
        if (kind == Node::gray) {
            const auto own = tree_.triangles_of(node);
            if (!std::equal(own.begin(), own.end(), triangles.begin(), triangles.end()))
                return wrong(node, "has not the triangles that meet it");
            if (tree_.leaf_winding[tree_.link[node]] != at_low)
                return wrong(node, "has a wrong winding number");
            return Done{};
        }
        WindingGrid winding{};
        if (tree_.is_solid) winding = wind(tree_.mesh, triangles, box, at_low);
        auto& octants = buffers_[static_cast<std::size_t>(cell.level)];
        for (auto& octant : octants) octant.clear();
        distribute(tree_.mesh, triangles, box, octants);
        for (int i = 0; i < 8; ++i) {
            const Status child = visit(tree_.link[node] + static_cast<unsigned>(i), cell.child(i),
                                       octants[static_cast<std::size_t>(i)], inside_corners(winding, i),
                                       winding_at_corner(winding, i, 0));
            if (!child) return child;
        }
        return Done{};
    }

    const BpOctree& tree_;
    const Context& context_;
    NodeContent content_;
    std::vector<std::array<std::vector<mesh::FaceIndex>, 8>> buffers_;
};

}  // namespace

Status certify(const BpOctree& tree, const Context& context) { return Certificate(tree, context).run(); }

}  // namespace octavo::bp_octree
