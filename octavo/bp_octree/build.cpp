// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>

#include <octavo/base/parallel.hpp>
#include <octavo/bp_octree/build.hpp>
#include <octavo/bp_octree/cell_split.hpp>
#include <octavo/bp_octree/node_content.hpp>
#include <octavo/bp_octree/select_planes.hpp>
#include <octavo/classic/closed_surface.hpp>
#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/topology.hpp>
#include <octavo/mesh/weld.hpp>

namespace octavo::bp_octree {
namespace {

using octree::Cell;
using octree::Node;

/// A split node whose octants are not made yet. Its triangles are in the level's list.
struct OpenNode {
    Cell cell;
    std::size_t begin = 0, count = 0;
    std::int32_t winding_at_low = 0;
    Polytope envelope;
};

/// What making some nodes gives; parts are joined in Morton order.
struct Part {
    std::vector<Node> nodes;
    std::vector<std::uint32_t> plane_counts;  ///< per node
    std::vector<BoundingPlane> planes;
    std::vector<std::uint32_t> leaf_counts;  ///< triangles, per gray node
    std::vector<mesh::FaceIndex> leaf_triangles;
    std::vector<std::int32_t> leaf_winding;
    std::vector<OpenNode> open;
    std::vector<mesh::FaceIndex> open_triangles;
    double split_volume = 0, gray_volume = 0;  ///< of envelopes, in cells
};

/// Buffers of one thread; pooled, since an idle thread may run another chunk.
struct Workspace {
    std::array<std::vector<mesh::FaceIndex>, 8> octants;
    NodeContent content;
};

class Builder {
  public:
    Builder(BpOctree& tree, const BuildOptions& options, const Context& context)
        : tree_(tree), options_(options), context_(context) {}

    Status run() {
        if (options_.coalescing == Coalescing::sum || options_.coalescing == Coalescing::mean) {
            constexpr double any = std::numeric_limits<double>::infinity();
            const SiblingCriterion criterion =
                options_.coalescing == Coalescing::sum
                    ? SiblingCriterion{static_cast<double>(options_.leaf_triangles), any}
                    : SiblingCriterion{any, options_.least_mean};
            auto split = split_by_siblings(tree_.mesh, tree_.frame, options_.depth, criterion, context_);
            if (!split) return std::move(split).error();
            split_ = std::move(*split);
        }
        std::vector<Part> parts(1);
        {
            std::vector<mesh::FaceIndex> all(tree_.mesh.triangles.size());
            std::iota(all.begin(), all.end(), 0U);
            Polytope cell;
            cell.make_cell();
            std::unique_ptr<Workspace> workspace = borrow();
            make_node(Cell::root(), all, 0, 0, std::move(cell), *workspace, parts[0]);
            give_back(std::move(workspace));
        }
        tree_.level_begin = {0};
        tree_.leaf_begin = {0};
        tree_.plane_begin = {0};
        std::vector<OpenNode> open;
        std::vector<mesh::FaceIndex> triangles;
        for (;;) {
            if (Status joined = join(parts, open, triangles); !joined) return joined;
            if (open.empty()) return Done{};
            if (Status made = make_level(open, triangles, parts); !made) return made;
        }
    }

  private:
    // Enough nodes to hide the cost of a chunk; the grain decides in which order sums are rounded, so it is fixed.
    static constexpr std::size_t grain = 8;

    Status make_level(const std::vector<OpenNode>& open, const std::vector<mesh::FaceIndex>& triangles,
                      std::vector<Part>& parts) {
        parts.clear();
        parts.resize((open.size() + grain - 1) / grain);
        std::mutex progress;
        std::size_t done = 0;
        parallel_chunks(context_, open.size(), grain, [&](std::size_t begin, std::size_t end) {
            std::unique_ptr<Workspace> workspace = borrow();
            for (std::size_t i = begin; i < end; ++i)
                make_octants(open[i], {triangles.data() + open[i].begin, open[i].count}, *workspace,
                             parts[begin / grain]);
            give_back(std::move(workspace));
            if (!context_.on_progress) return;
            const std::scoped_lock lock(progress);
            done += end - begin;
            // Work a level is about constant until the leaves; the sum of all levels is not known before.
            const double level = static_cast<double>(tree_.levels.size() - 1) +
                                 static_cast<double>(done) / static_cast<double>(open.size());
            context_.report("envelopes", std::min(1.0, level / (options_.depth + 1)));
        });
        if (context_.cancelled()) return Context::cancelled_error();
        return Done{};
    }

    void make_octants(const OpenNode& parent, std::span<const mesh::FaceIndex> triangles,
                      Workspace& workspace, Part& part) {
        const CellBox box = tree_.frame.box(parent.cell);
        WindingGrid winding{};
        if (tree_.is_solid) winding = wind(tree_.mesh, triangles, box, parent.winding_at_low);
        for (auto& octant : workspace.octants) octant.clear();
        distribute(tree_.mesh, triangles, box, workspace.octants);
        for (int i = 0; i < 8; ++i) {
            const std::uint8_t inside = inside_corners(winding, i);
            const auto& own = workspace.octants[static_cast<std::size_t>(i)];
            if (own.empty()) {
                part.nodes.push_back(inside ? Node::black : Node::white);
                part.plane_counts.push_back(0);
                continue;
            }
            Polytope start;
            start.assign_octant(parent.envelope, i);
            make_node(parent.cell.child(i), own, inside, winding_at_corner(winding, i, 0), std::move(start),
                      workspace, part);
        }
    }

    /// Bounds a node that the surface goes through, and makes it a leaf or leaves it open.
    void make_node(const Cell& cell, const std::vector<mesh::FaceIndex>& triangles, std::uint8_t inside,
                   std::int32_t winding_at_low, Polytope start, Workspace& workspace, Part& part) {
        workspace.content.gather(tree_.mesh, tree_.frame.box(cell), triangles, inside);
        Polytope envelope = std::move(start);
        const std::vector<BoundingPlane> planes = select_planes(
            workspace.content.points(), workspace.content.normals(), selection(cell.level), envelope);
        part.plane_counts.push_back(static_cast<std::uint32_t>(planes.size()));
        part.planes.insert(part.planes.end(), planes.begin(), planes.end());
        const double volume =
            envelope.volume() / (Polytope::cell_side * Polytope::cell_side * Polytope::cell_side);
        if (is_leaf(cell, triangles.size())) {
            part.nodes.push_back(Node::gray);
            part.gray_volume += volume;
            part.leaf_counts.push_back(static_cast<std::uint32_t>(triangles.size()));
            part.leaf_triangles.insert(part.leaf_triangles.end(), triangles.begin(), triangles.end());
            part.leaf_winding.push_back(winding_at_low);
            return;
        }
        part.nodes.push_back(Node::split);
        part.split_volume += volume;
        envelope.shrink_to_fit();
        part.open.push_back(
            {cell, part.open_triangles.size(), triangles.size(), winding_at_low, std::move(envelope)});
        part.open_triangles.insert(part.open_triangles.end(), triangles.begin(), triangles.end());
    }

    bool is_leaf(const Cell& cell, std::size_t triangles) const {
        if (cell.level == options_.depth) return true;
        switch (options_.coalescing) {
            case Coalescing::count:
                return triangles <= options_.leaf_triangles;
            case Coalescing::sum:
            case Coalescing::mean:
                return !std::binary_search(split_.begin(), split_.end(), cell.key());
            case Coalescing::none:
                break;
        }
        return false;
    }

    SelectionOptions selection(int level) const {
        SelectionOptions selection;
        // Powers of two on the least gain. Coarse levels have few planes that all later levels inherit: with these
        // they come within 1 % of the convex hulls of the cells. Below level 5 planes are many and each is worth
        // little: a quarter fewer of them at level 7 costs 0.1 % of volume.
        constexpr std::array<double, 9> finer{8, 7, 3.5, 2, 0, 0, 0, -2.4, -4};
        const std::size_t index = std::min(static_cast<std::size_t>(level), finer.size() - 1);
        selection.least_gain = options_.least_gain * std::exp2(-finer[index]);
        // The thesis has 1 % of the triangles at the root and half as many in each node of the next level; a fifth of
        // that for its smallest model is the limit here, and only level 1 comes near it.
        if (level == 1) selection.most_planes = 50;
        if (options_.planes != PlaneChoice::greedy) selection.most_planes = 0;
        const bool coarse = level < 4;
        selection.refine_steps = options_.quality == Quality::fast && !coarse ? 1 : coarse ? 4 : 3;
        selection.vertex_rounds = coarse ? 4 : options_.quality == Quality::fast ? 0 : 1;
        return selection;
    }

    /// Appends the new level to the tree; what is open becomes the input of the next.
    Status join(std::vector<Part>& parts, std::vector<OpenNode>& open,
                std::vector<mesh::FaceIndex>& triangles) {
        open.clear();
        triangles.clear();
        LevelFigures level;
        double split_volume = 0, gray_volume = 0;
        for (Part& part : parts) {
            std::size_t leaf = 0;
            for (std::size_t i = 0; i < part.nodes.size(); ++i) {
                const Node node = part.nodes[i];
                tree_.nodes.push_back(node);
                tree_.plane_begin.push_back(tree_.plane_begin.back() + part.plane_counts[i]);
                tree_.link.push_back(0);
                if (node == Node::split) {
                    tree_.link.back() = static_cast<std::uint32_t>(1 + 8 * splits_);
                    ++splits_, ++level.split;
                } else if (node == Node::gray) {
                    tree_.link.back() = static_cast<std::uint32_t>(tree_.leaf_count());
                    tree_.leaf_begin.push_back(tree_.leaf_begin.back() + part.leaf_counts[leaf++]);
                    ++level.gray;
                } else {
                    ++(node == Node::white ? level.white : level.black);
                }
            }
            append(tree_.planes, part.planes);
            append(tree_.leaf_triangles, part.leaf_triangles);
            append(tree_.leaf_winding, part.leaf_winding);
            for (OpenNode& node : part.open) {
                node.begin += triangles.size();
                open.push_back(std::move(node));
            }
            append(triangles, part.open_triangles);
            split_volume += part.split_volume;
            gray_volume += part.gray_volume;
            level.planes += part.planes.size();
            part = {};
            constexpr std::size_t most = 0xffffffff;
            if (1 + 8 * (splits_ + 1) > most || tree_.leaf_triangles.size() > most || triangles.size() > most)
                return Error{ErrorCode::limit, "the BP-octree needs more than 2^32 nodes or references", {}};
        }
        const int depth = static_cast<int>(tree_.levels.size());
        double cell = 1;
        for (int axis = 0; axis < 3; ++axis)
            cell *= std::ldexp(tree_.frame.side(axis, depth) * tree_.mesh.lattice.unit(), -1);
        settled_volume_ += (gray_volume + static_cast<double>(level.black)) * cell;
        level.volume = settled_volume_ + split_volume * cell;
        tree_.levels.push_back(level);
        tree_.level_begin.push_back(static_cast<NodeIndex>(tree_.nodes.size()));
        return Done{};
    }

    template <class T>
    static void append(std::vector<T>& to, const std::vector<T>& from) {
        to.insert(to.end(), from.begin(), from.end());
    }

    std::unique_ptr<Workspace> borrow() {
        const std::scoped_lock lock(pool_mutex_);
        if (pool_.empty()) return std::make_unique<Workspace>();
        std::unique_ptr<Workspace> workspace = std::move(pool_.back());
        pool_.pop_back();
        return workspace;
    }
    void give_back(std::unique_ptr<Workspace> workspace) {
        const std::scoped_lock lock(pool_mutex_);
        pool_.push_back(std::move(workspace));
    }

    BpOctree& tree_;
    const BuildOptions& options_;
    const Context& context_;
    std::vector<octree::CellKey> split_;  ///< for Coalescing::sum and mean
    std::uint64_t splits_ = 0;
    double settled_volume_ = 0;  ///< of leaves and black cells on the levels so far
    std::mutex pool_mutex_;
    std::vector<std::unique_ptr<Workspace>> pool_;
};

/// Points that no facet uses would only enlarge the frame.
mesh::LatticeMesh without_unused(mesh::LatticeMesh mesh) {
    const std::vector<bool> used = mesh::used_vertices(mesh.triangles, mesh.points.size());
    std::vector<mesh::VertexIndex> number(mesh.points.size());
    mesh::VertexIndex kept = 0;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i]) {
            mesh.points[kept] = mesh.points[i];
            number[i] = kept++;
        }
    mesh.points.resize(kept);
    for (mesh::Triangle& t : mesh.triangles) t = {number[t[0]], number[t[1]], number[t[2]]};
    return mesh;
}

/// The volume of every envelope is at most that of the root cell.
bool has_finite_volumes(const BpOctree& tree) {
    double root = 1;
    for (int axis = 0; axis < 3; ++axis)
        root *= std::ldexp(tree.frame.side(axis, 0) * tree.mesh.lattice.unit(), -1);
    return std::isfinite(root) && std::isfinite(tree.solid_volume);
}

}  // namespace

Result<BpOctree> build(const mesh::LatticeMesh& mesh, const BuildOptions& options, const Context& context) {
    OCTAVO_CHECK(options.depth >= 0 && options.depth <= max_depth, "the depth of a BP-octree is 0 to 18");
    OCTAVO_CHECK(options.leaf_triangles >= 1, "a leaf holds at least one triangle");
    OCTAVO_CHECK(options.least_mean > 0, "means of triangles are positive");
    if (mesh.triangles.empty()) return Error{ErrorCode::bad_input, "the mesh has no facets", {}};
    BpOctree tree;
    tree.mesh = without_unused(mesh::weld(mesh));
    tree.is_solid = classic::open_edges(tree.mesh).empty();
    if (tree.is_solid) {
        const double unit = mesh.lattice.unit();
        tree.solid_volume = static_cast<double>(mesh::exact_volume6(tree.mesh)) / 6 * unit * unit * unit;
    }
    tree.frame = Frame::around(tree.mesh.points, options.depth);
    if (!has_finite_volumes(tree))
        return Error{ErrorCode::limit, "has a volume beyond what a double can hold; scale it down", {}};
    if (Status built = Builder(tree, options, context).run(); !built) return built.error();
    if (options.planes == PlaneChoice::k_medoids)
        if (Status chosen = choose_by_k_medoids(tree, options.k_medoids, context); !chosen)
            return chosen.error();
    return tree;
}

}  // namespace octavo::bp_octree
