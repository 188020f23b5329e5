// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string_view>
#include <utility>
#include <vector>

#include <octavo/base/parallel.hpp>
#include <octavo/octree/cell.hpp>
#include <octavo/octree/descent_options.hpp>
#include <octavo/octree/df_code.hpp>

// The descent: the one recursion of Octavo.
//
// A description of something (a solid, several solids, a set of triangles) can be *restricted* to a cell: a
// CSG expression becomes what is still undecided there, a mesh the triangles that touch the cell. A problem
// says how; the descent visits the cells depth first, restricts, and hands nodes and leaves to an output in
// Morton order.
//
// A problem is a class with
//
//     struct Description;  // a restriction: small and copyable; bulk data lies in the workspace, by index ranges
//     class Workspace;     // scratch of one path from the root: one growing buffer a level, reused, see below
//     class Output;        // what is built; see below
//
//     int depth() const;   // the level below which nothing is split, ≤ 21
//     Workspace make_workspace() const;
//     Output make_output() const;
//     // The universe: a leaf, or split with a description.
//     Restricted<Description> root(Workspace&) const;
//     // For each octant a leaf's colour, or split.
//     void restrict_to_children(const Cell& parent, const Description&, Workspace&,
//                               Children<Description>&) const;
//     std::size_t weight(const Description&) const;   // how much work is in it: list or program length
//     // Copies the cell's bulk data to another workspace.
//     Description transfer(const Cell&, const Description&, const Workspace& from, Workspace& to) const;
//
// and perhaps
//
//     static constexpr int finished_levels = 2;            // cells this far above the last level are not split …
//     Node finish(const Cell&, const Description&, Workspace&, Output&) const;   // … but given to the output with
//                                                          // all below them; returns the common colour, or split
//                                                          // (the output then says how many `nodes()` it has)
//
// and an output one with
//
//     void split(const Cell&, const Description&, const Workspace&);   // a node; what lies in it follows
//     void leaf(const Cell&, const Restricted<Description>&, const Workspace&);
//     // Optional: eight leaves of the last level at once; returns their common colour, or split.
//     Node leaves(const Cell& parent, const Children<Description>&, const Workspace&);
//     // The eight octants of the cell, just given, are leaves of one decided colour: they and their parent become
//     // one leaf.
//     void merge(const Cell&, Color);
//     void append(Output&&);   // the output of the cells that follow in Morton order
//
// Buffers: while the octants of a cell of level L are visited, their descriptions must stay where they are;
// they belong in the buffer of level L + 1, which the next `restrict_to_children` of a level-L cell may
// overwrite. So memory is depth × description, nothing is allocated per cell once the buffers have grown, and
// a description given to `Output::leaf` is valid during that call only.
//
// Threads: sub-trees whose weight exceeds `fork_weight` are forked; each has its own workspace and output,
// and outputs are appended in Morton order. A problem whose answers depend on the description alone therefore
// gives the same bytes for any number of threads. `restrict_to_children` is called from several threads at
// once.
//
// Memory: a depth of 21 allows 8^21 nodes, so the nodes are counted and a limit stops the descent. Counted are nodes
// that stay, when the cell above them is done and they were not merged: their number is that of the result, the same
// for any number of threads, and what is held beside them is eight nodes a level.
//
// Small example, the cells of level ≤ 5 of the half space x < 1000 (no list, so nothing to store):
//
//     struct HalfSpace {
//         struct Description {};
//         struct Workspace {};
//         using Output = DfOutput;
//         int depth() const { return 5; }
//         Workspace make_workspace() const { return {}; }
//         Output make_output() const { return {}; }
//         Restricted<Description> root(Workspace&) const { return {Node::split, {}}; }
//         std::size_t weight(const Description&) const { return 1; }
//         Description transfer(const Cell&, const Description& d, const Workspace&, Workspace&) const {
//             return d;
//         }
//         void restrict_to_children(const Cell& parent, const Description&, Workspace&,
//                                   Children<Description>& children) const {
//             for (int i = 0; i < 8; ++i) {
//                 const Cell child = parent.child(i);
//                 children[i].node = child.high().x <= 1000 ? Node::black
//                                    : child.low.x >= 1000  ? Node::white
//                                                           : Node::split;
//             }
//         }
//     };
//     Result<DfOutput> built = descend(HalfSpace{});

namespace octavo::octree {

/// A description restricted to a cell: a decided leaf, a gray leaf, or split, that is to be looked into
/// further. The description of a white or black leaf may be left as it is.
template <class Description>
struct Restricted {
    Node node = Node::white;
    Description description{};
};

template <class Description>
using Children = std::array<Restricted<Description>, 8>;

template <class P>
concept DescentProblem = requires(const P& problem, const Cell& cell, typename P::Workspace& workspace,
                                  typename P::Output& output, const typename P::Description& description,
                                  Children<typename P::Description>& children) {
    { problem.depth() } -> std::convertible_to<int>;
    { problem.make_workspace() } -> std::same_as<typename P::Workspace>;
    { problem.make_output() } -> std::same_as<typename P::Output>;
    { problem.root(workspace) } -> std::same_as<Restricted<typename P::Description>>;
    problem.restrict_to_children(cell, description, workspace, children);
    { problem.weight(description) } -> std::convertible_to<std::size_t>;
    { problem.transfer(cell, description, workspace, workspace) } -> std::same_as<typename P::Description>;
    output.split(cell, description, workspace);
    output.leaf(cell, children[0], workspace);
    output.merge(cell, Color::white);
    output.append(std::move(output));
};

/// The usual output: the nodes as a DF code, white and black siblings merged.
class DfOutput {
  public:
    template <class Description, class Workspace>
    void split(const Cell&, const Description&, const Workspace&) {
        code_.append(Node::split);
    }
    template <class Description, class Workspace>
    void leaf(const Cell&, const Restricted<Description>& leaf, const Workspace&) {
        code_.append(leaf.node);
    }
    /// Eight leaves; returns their colour when they share one, else split.
    template <class Description, class Workspace>
    Node leaves(const Cell&, const Children<Description>& leaves, const Workspace&) {
        std::uint64_t nodes = 0;
        for (std::size_t i = 0; i < 8; ++i) nodes |= static_cast<std::uint64_t>(leaves[i].node) << (2 * i);
        code_.append(nodes, 8);
        return nodes == 0 ? Node::white : nodes == 0x5555 ? Node::black : Node::split;
    }
    /// A cell with all that is two levels below it; returns as `leaves` does.
    Node finish(const GrandchildColors& colors) { return code_.append(colors); }
    void merge(const Cell&, Color color) {
        code_.truncate(code_.size() - 9);
        code_.append(leaf_of(color));
    }
    void append(DfOutput&& next) { code_.append(next.code_); }

    std::size_t nodes() const { return code_.size(); }
    const DfCode& code() const { return code_; }
    DfCode take_code() { return std::move(code_); }

  private:
    DfCode code_;
};

namespace descend_detail {

/// Adds up how much of the work is done and reports it, from one thread at a time and not too often.
class Progress {
  public:
    Progress(const Context& context, std::string_view phase) : context_(context), phase_(phase) {}

    void add(double share) {
        if (!context_.on_progress) return;
        const std::scoped_lock lock(mutex_);
        done_ = std::fmin(1.0, done_ + share);
        if (done_ < reported_ + 1.0 / 2048) return;
        reported_ = done_;
        context_.report(phase_, done_);
    }
    void start() { context_.report(phase_, 0.0); }
    void finish() { context_.report(phase_, 1.0); }

  private:
    const Context& context_;
    std::string_view phase_;
    std::mutex mutex_;
    double done_ = 0, reported_ = 0;
};

template <DescentProblem Problem>
class Descent {
  public:
    using Description = typename Problem::Description;
    using Workspace = typename Problem::Workspace;
    using Output = typename Problem::Output;

    Descent(const Problem& problem, const DescentOptions& options, const Context& context)
        : problem_(problem),
          options_(options),
          context_(context),
          progress_(context, options.phase),
          depth_(problem.depth()) {
        OCTAVO_CHECK(depth_ >= 0 && depth_ <= max_level, "the depth of a descent is 0 to 21");
    }

    Result<Output> run() {
        progress_.start();
        Output output = problem_.make_output();
        std::unique_ptr<Path> path = borrow();
        Restricted<Description> root = problem_.root(path->workspace);
        if (root.node == Node::split && depth_ == 0) root.node = Node::gray;
        if (is_leaf(root.node))
            output.leaf(Cell::root(), root, path->workspace);
        else if (context_.threads == 1)
            visit<false>(Cell::root(), root.description, *path, output, 1.0);
        else
            within_threads(context_,
                           [&] { visit<true>(Cell::root(), root.description, *path, output, 1.0); });
        count(*path);
        if (has_too_many_nodes_) return too_many_nodes(options_.max_nodes, depth_);
        if (stopped_) return Context::cancelled_error();
        progress_.finish();
        return output;
    }

  private:
    // A share of all work smaller than this is not reported on its own, nor split further. An hour's work still
    // moves its bar every half second.
    static constexpr double least_share = 1.0 / 8192;
    static constexpr bool takes_all_leaves =
        requires(Output & output, const Cell& cell, const Children<Description>& children,
                 const Workspace& workspace) {
        { output.leaves(cell, children, workspace) } -> std::same_as<Node>;
    };

    static constexpr bool finishes = requires { Problem::finished_levels; };

    /// What a thread needs on its way through a sub-tree.
    struct Path {
        Workspace workspace;
        std::uint64_t kept_nodes = 0;  ///< not yet added to those of all paths
    };

    /// Nodes that stay. They are added up in portions: the sum is shared by all threads.
    void keep(std::uint64_t nodes, Path& path) {
        constexpr std::uint64_t portion = 4096;
        path.kept_nodes += nodes;
        if (path.kept_nodes >= portion) count(path);
    }
    void count(Path& path) {
        const std::uint64_t before = kept_nodes_.fetch_add(path.kept_nodes, std::memory_order_relaxed);
        if (before + path.kept_nodes > options_.max_nodes) has_too_many_nodes_ = stopped_ = true;
        path.kept_nodes = 0;
    }

    /// Visits a cell that is split; returns the colour of all of it when its leaves could be merged, else
    /// split.
    template <bool may_fork>
    Node visit(const Cell& cell, const Description& description, Path& path, Output& output, double share) {
        if (stopped_.load(std::memory_order_relaxed)) return Node::split;
        if (context_.cancelled()) {
            stopped_ = true;
            return Node::split;
        }
        Workspace& workspace = path.workspace;
        if constexpr (finishes) {
            if (cell.level + Problem::finished_levels == depth_) {
                if (share != 0) progress_.add(share);
                const std::size_t before = output.nodes();
                const Node common = problem_.finish(cell, description, workspace, output);
                keep(output.nodes() - before - 1, path);  // the cell itself is kept with its siblings
                return common;
            }
        }
        Children<Description> children;
        output.split(cell, description, workspace);
        problem_.restrict_to_children(cell, description, workspace, children);
        if (cell.level + 1 == depth_) {
            for (Restricted<Description>& child : children)
                if (child.node == Node::split) child.node = Node::gray;
            if constexpr (takes_all_leaves) return leaves(cell, children, path, output, share);
        }
        const bool fork = may_fork && problem_.weight(description) > options_.fork_weight;
        const Node merged = fork ? visit_octants_apart(cell, children, path, output, share)
                                 : visit_octants<may_fork>(cell, children, path, output, share);
        return merge_or_keep(cell, merged, path, output);
    }

    /// `common` is the colour that all octants share, or split.
    Node merge_or_keep(const Cell& cell, Node common, Path& path, Output& output) {
        if (common == Node::white || common == Node::black) {
            output.merge(cell, color_of(common));
            return common;
        }
        keep(8, path);
        return Node::split;
    }

    /// Hands over the octants of a cell above the last level in one call, where the output has one for it.
    Node leaves(const Cell& cell, const Children<Description>& children, Path& path, Output& output,
                double share) {
        if (share != 0) progress_.add(share);
        const Node common = output.leaves(cell, children, path.workspace);
        return merge_or_keep(cell, common, path, output);
    }

    template <bool may_fork>
    Node visit_octants(const Cell& cell, const Children<Description>& children, Path& path, Output& output,
                       double share) {
        const double child_share = share < least_share ? 0 : share / weight_of_split(children);
        Node common = children[0].node;
        for (int i = 0; i < 8; ++i) {
            const Restricted<Description>& child = children[static_cast<std::size_t>(i)];
            Node node = child.node;
            if (is_leaf(node))
                output.leaf(cell.child(i), child, path.workspace);
            else
                node = visit<may_fork>(cell.child(i), child.description, path, output,
                                       child_share * weight_of(child));
            if (i == 0) common = node;
            if (node != common) common = Node::split;
        }
        if (child_share == 0 && share != 0) progress_.add(share);
        return common == Node::gray ? Node::split : common;
    }

    Node visit_octants_apart(const Cell& cell, const Children<Description>& children, Path& path,
                             Output& output, double share) {
        const double child_share = share / weight_of_split(children);
        std::array<Node, 8> nodes;
        std::vector<Output> outputs;
        outputs.reserve(8);
        for (int i = 0; i < 8; ++i) outputs.push_back(problem_.make_output());
        run_tasks(8, [&](std::size_t octant) {
            const int i = static_cast<int>(octant);
            const Restricted<Description>& child = children[octant];
            nodes[octant] = child.node;
            if (is_leaf(child.node)) {
                outputs[octant].leaf(cell.child(i), child, path.workspace);
                return;
            }
            std::unique_ptr<Path> own = borrow();
            const Description moved =
                problem_.transfer(cell.child(i), child.description, path.workspace, own->workspace);
            nodes[octant] =
                visit<true>(cell.child(i), moved, *own, outputs[octant], child_share * weight_of(child));
            give_back(std::move(own));
        });
        for (Output& part : outputs) output.append(std::move(part));
        for (const Node node : nodes)
            if (node != nodes[0] || node == Node::gray) return Node::split;
        return nodes[0];
    }

    double weight_of(const Restricted<Description>& child) const {
        return static_cast<double>(problem_.weight(child.description)) + 1;
    }
    double weight_of_split(const Children<Description>& children) const {
        double sum = 0;
        for (const Restricted<Description>& child : children)
            if (!is_leaf(child.node)) sum += weight_of(child);
        return sum > 0 ? sum : 1;
    }

    // Paths are pooled, not thread-local: a thread that waits for its octants may run another sub-tree.
    std::unique_ptr<Path> borrow() {
        const std::scoped_lock lock(pool_mutex_);
        if (pool_.empty()) return std::make_unique<Path>(Path{problem_.make_workspace()});
        std::unique_ptr<Path> path = std::move(pool_.back());
        pool_.pop_back();
        return path;
    }
    void give_back(std::unique_ptr<Path> path) {
        count(*path);
        const std::scoped_lock lock(pool_mutex_);
        pool_.push_back(std::move(path));
    }

    const Problem& problem_;
    const DescentOptions& options_;
    const Context& context_;
    Progress progress_;
    const int depth_;
    std::atomic<bool> stopped_{false}, has_too_many_nodes_{false};
    std::atomic<std::uint64_t> kept_nodes_{1};  // the root
    std::mutex pool_mutex_;
    std::vector<std::unique_ptr<Path>> pool_;
};

}  // namespace descend_detail

/// Runs the descent of `problem` from the universe. The result does not depend on the number of threads.
/// Errors: limit (more than `options.max_nodes`), cancelled.
template <DescentProblem Problem>
Result<typename Problem::Output> descend(const Problem& problem, const Context& context = {},
                                         const DescentOptions& options = {}) {
    return descend_detail::Descent<Problem>(problem, options, context).run();
}

}  // namespace octavo::octree
