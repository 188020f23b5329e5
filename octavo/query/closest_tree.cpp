// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include <octavo/base/parallel.hpp>
#include <octavo/query/closest_tree.hpp>
#include <octavo/query/turned_box.hpp>

namespace octavo::query {
namespace {

struct Box {
    std::array<std::int32_t, 3> low{INT32_MAX, INT32_MAX, INT32_MAX}, high{INT32_MIN, INT32_MIN, INT32_MIN};
    void add(const Box& box) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = std::min(low[axis], box.low[axis]);
            high[axis] = std::max(high[axis], box.high[axis]);
        }
    }
    /// Half the surface; 0 when empty.
    double half_area() const {
        if (low[0] > high[0]) return 0;
        const double x = high[0] - low[0], y = high[1] - low[1], z = high[2] - low[2];
        return x * y + y * z + z * x;
    }
    /// Twice the centre.
    std::int32_t middle(std::size_t axis) const { return low[axis] + high[axis]; }
};

/// The parts of a range of `order_` that become children.
struct Range {
    std::uint32_t begin = 0, end = 0;
    Box box;
    int depth = 0;
    std::uint32_t count() const { return end - begin; }
};

/// A part of the tree in arrays of its own, or a node with such parts for children.
struct Piece {
    ClosestTree tree;  ///< its root first; a lone leaf has no node
    TreeNode node{};
    std::vector<Piece> children;  ///< of `node`; empty where `tree` is all of the piece

    std::size_t node_count() const {
        std::size_t count = children.empty() ? tree.nodes.size() : 1;
        for (const Piece& child : children) count += child.node_count();
        return count;
    }
    std::size_t leaf_count() const {
        std::size_t count = tree.leaves.size();
        for (const Piece& child : children) count += child.leaf_count();
        return count;
    }

    /// Moves the piece to the end of `whole`; returns the number of its root there.
    std::uint32_t join(ClosestTree& whole) {
        const auto first_node = static_cast<std::uint32_t>(whole.nodes.size());
        const auto first_leaf = static_cast<std::uint32_t>(whole.leaves.size());
        if (!children.empty()) {
            whole.nodes.push_back(node);
            for (std::size_t i = 0; i < children.size(); ++i) {
                const std::uint32_t child = children[i].join(whole);
                whole.nodes[first_node].child[i] = child;
            }
            return first_node;
        }
        for (TreeNode& moved : tree.nodes) {
            for (std::uint32_t& child : moved.child)
                if (child != 0) child += (child & TreeNode::leaf_bit) != 0 ? first_leaf : first_node;
            whole.nodes.push_back(moved);
        }
        whole.leaves.insert(whole.leaves.end(), tree.leaves.begin(), tree.leaves.end());
        const bool lone_leaf = tree.nodes.empty();
        tree = {};  // so that the memory for two trees is never needed whole
        return lone_leaf ? first_leaf | TreeNode::leaf_bit : first_node;
    }
};

class TreeBuilder {
  public:
    TreeBuilder(const mesh::LatticeMesh& mesh, const Context& context)
        : mesh_(mesh), context_(context), boxes_(mesh.triangles.size()), order_(boxes_.size()) {
        // Tasks below stay within the threads of the caller's loop.
        if (context.threads != 1) context_.threads = 0;
    }

    ClosestTree run() {
        if (boxes_.empty()) return {};
        parallel_chunks(context_, boxes_.size(), piece_triangles, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) boxes_[i] = box_of(mesh_.triangles[i]);
        });
        std::iota(order_.begin(), order_.end(), 0U);
        Range all{0, static_cast<std::uint32_t>(boxes_.size()), {}, 0};
        for (const Box& box : boxes_) all.box.add(box);
        Piece piece = build_node(all);
        ClosestTree tree;
        if (context_.cancelled()) return tree;
        tree.nodes.reserve(piece.node_count());
        tree.leaves.reserve(piece.leaf_count());
        piece.join(tree);
        return tree;
    }

  private:
    // Bins a split; more find no better splits of scanned surfaces.
    static constexpr int bins = 16;
    // Below this depth of binary splits halves are taken instead, so that no input makes the tree deep.
    static constexpr int area_depth = 48;
    // A range of so many triangles is built by one task, in about a hundredth of a second.
    static constexpr std::uint32_t piece_triangles = 1U << 14;

    Box box_of(const mesh::Triangle& triangle) const {
        Box box;
        for (const mesh::VertexIndex vertex : triangle) {
            const exact::Point p = mesh_.points[vertex];
            box.add({{p.x, p.y, p.z}, {p.x, p.y, p.z}});
        }
        return box;
    }

    /// The tree of a range that is a node.
    Piece build_node(const Range& range) {
        Piece piece;
        if (range.count() <= piece_triangles) {
            if (!context_.cancelled()) add_node(range, piece.tree);
            return piece;
        }
        std::array<Range, tree_width> parts;
        const std::size_t count = divide(range, parts);
        piece.node = frame_of(range.box);
        piece.children.resize(count);
        std::array<TurnedBox, tree_width> boxes;
        parallel_chunks(context_, count, 1, [&](std::size_t i, std::size_t) {
            boxes[i] = box_in(piece.node, parts[i]);
            if (parts[i].count() <= tree_width)
                add_leaf(parts[i], piece.children[i].tree);
            else
                piece.children[i] = build_node(parts[i]);
        });
        for (std::size_t i = 0; i < count; ++i) set_child(piece.node, i, boxes[i], 0);
        return piece;
    }

    std::uint32_t add_node(const Range& range, ClosestTree& tree) {
        const auto index = static_cast<std::uint32_t>(tree.nodes.size());
        std::array<Range, tree_width> parts;
        const std::size_t count = divide(range, parts);
        tree.nodes.push_back(frame_of(range.box));
        for (std::size_t i = 0; i < count; ++i) {
            const TurnedBox box = box_in(tree.nodes[index], parts[i]);
            const std::uint32_t child =
                parts[i].count() <= tree_width ? add_leaf(parts[i], tree) : add_node(parts[i], tree);
            set_child(tree.nodes[index], i, box, child);
        }
        return index;
    }

    /// The parts of the range that its node holds; returns how many.
    std::size_t divide(const Range& range, std::array<Range, tree_width>& parts) {
        parts[0] = range;
        std::size_t count = 1;
        while (count < tree_width) {
            std::size_t largest = count;
            double most = -1;
            for (std::size_t i = 0; i < count; ++i) {
                const double weight = (parts[i].box.half_area() + 1) * parts[i].count();
                if (parts[i].count() > tree_width && weight > most) most = weight, largest = i;
            }
            if (largest == count) break;
            const auto [first, second] = split(parts[largest]);
            parts[largest] = first;
            parts[count++] = second;
        }
        return count;
    }

    /// A node without children, in whose frame boxes within `whole` are rounded.
    static TreeNode frame_of(const Box& whole) {
        TreeNode node{};
        std::int32_t half_side = 0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            node.origin[axis] = whole.low[axis] + (whole.high[axis] - whole.low[axis]) / 2;
            half_side = std::max(half_side, whole.high[axis] - node.origin[axis]);
        }
        node.step = std::nextafter(static_cast<float>((half_side + 1) / TurnedBox::reach), 1e30F);
        return node;
    }

    TurnedBox box_in(const TreeNode& frame, const Range& part) const {
        return TurnedBox::round(mesh_, std::span(order_).subspan(part.begin, part.count()), frame.origin,
                                frame.step);
    }

    static void set_child(TreeNode& node, std::size_t i, const TurnedBox& box, std::uint32_t child) {
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t axis = 0; axis < 3; ++axis) node.axes[k][axis][i] = box.axes[k][axis];
            node.low[k][i] = box.low[k];
            node.high[k][i] = box.high[k];
        }
        node.child[i] = child;
    }

    struct Bin {
        Box box;
        std::uint32_t count = 0;
    };
    static double leaves_of(std::uint32_t count) { return (count + tree_width - 1) / tree_width; }

    std::array<Range, 2> split(const Range& range) {
        Box centres;
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            const Box& box = boxes_[order_[i]];
            const std::array<std::int32_t, 3> c{box.middle(0), box.middle(1), box.middle(2)};
            centres.add({c, c});
        }
        double best_cost = std::numeric_limits<double>::infinity();
        std::size_t best_axis = 0;
        int best_bin = 0;
        for (std::size_t axis = 0; axis < 3 && range.depth < area_depth; ++axis) {
            if (centres.low[axis] == centres.high[axis]) continue;
            std::array<Bin, bins> all{};
            for (std::uint32_t i = range.begin; i < range.end; ++i) {
                const Box& box = boxes_[order_[i]];
                Bin& bin = all[static_cast<std::size_t>(bin_of(box, centres, axis))];
                bin.box.add(box);
                ++bin.count;
            }
            std::array<double, bins> above_cost{};
            Bin right;
            for (int i = bins - 1; i > 0; --i) {
                right.box.add(all[static_cast<std::size_t>(i)].box);
                right.count += all[static_cast<std::size_t>(i)].count;
                above_cost[static_cast<std::size_t>(i)] = right.box.half_area() * leaves_of(right.count);
            }
            Bin left;
            for (int i = 1; i < bins; ++i) {
                left.box.add(all[static_cast<std::size_t>(i - 1)].box);
                left.count += all[static_cast<std::size_t>(i - 1)].count;
                const double cost =
                    left.box.half_area() * leaves_of(left.count) + above_cost[static_cast<std::size_t>(i)];
                if (left.count > 0 && left.count < range.count() && cost < best_cost)
                    best_cost = cost, best_axis = axis, best_bin = i;
            }
        }
        const auto begin = order_.begin() + range.begin, end = order_.begin() + range.end;
        auto middle = begin + range.count() / 2;
        if (best_bin > 0) {
            middle = std::partition(begin, end, [&](std::uint32_t i) {
                return bin_of(boxes_[i], centres, best_axis) < best_bin;
            });
        } else {
            std::size_t axis = 0;
            for (std::size_t k = 1; k < 3; ++k)
                if (centres.high[k] - centres.low[k] > centres.high[axis] - centres.low[axis]) axis = k;
            std::nth_element(begin, middle, end, [&](std::uint32_t i, std::uint32_t j) {
                const std::int32_t a = boxes_[i].middle(axis), b = boxes_[j].middle(axis);
                return a != b ? a < b : i < j;
            });
        }
        const auto cut = static_cast<std::uint32_t>(middle - order_.begin());
        std::array<Range, 2> parts{Range{range.begin, cut, {}, range.depth + 1},
                                   Range{cut, range.end, {}, range.depth + 1}};
        for (Range& part : parts)
            for (std::uint32_t i = part.begin; i < part.end; ++i) part.box.add(boxes_[order_[i]]);
        return parts;
    }

    static int bin_of(const Box& box, const Box& centres, std::size_t axis) {
        const std::int64_t span = std::int64_t{centres.high[axis]} - centres.low[axis] + 1;
        return static_cast<int>((std::int64_t{box.middle(axis)} - centres.low[axis]) * bins / span);
    }

    std::uint32_t add_leaf(const Range& range, ClosestTree& tree) {
        TreeLeaf leaf{};
        std::sort(order_.begin() + range.begin, order_.begin() + range.end);
        for (std::size_t i = 0; i < tree_width; ++i) {
            const std::uint32_t place = std::min(range.begin + static_cast<std::uint32_t>(i), range.end - 1);
            leaf.face[i] = i < range.count() ? order_[place] : TreeLeaf::no_face;
            const mesh::Triangle& t = mesh_.triangles[order_[place]];
            for (int axis = 0; axis < 3; ++axis) {
                const auto k = static_cast<std::size_t>(axis);
                const std::int32_t a = mesh_.points[t[0]][axis];
                leaf.a[k][i] = a;
                leaf.u[k][i] = mesh_.points[t[1]][axis] - a;
                leaf.v[k][i] = mesh_.points[t[2]][axis] - a;
            }
        }
        tree.leaves.push_back(leaf);
        return static_cast<std::uint32_t>(tree.leaves.size() - 1) | TreeNode::leaf_bit;
    }

    const mesh::LatticeMesh& mesh_;
    Context context_;
    std::vector<Box> boxes_;
    std::vector<std::uint32_t> order_;
};

}  // namespace

ClosestTree ClosestTree::build(const mesh::LatticeMesh& mesh, const Context& context) {
    ClosestTree tree;
    if (context.threads == 1) return TreeBuilder(mesh, context).run();
    within_threads(context, [&] { tree = TreeBuilder(mesh, context).run(); });
    return tree;
}

}  // namespace octavo::query
