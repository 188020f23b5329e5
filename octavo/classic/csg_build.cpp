// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <octavo/classic/csg_build.hpp>
#include <octavo/classic/csg_by_primitive.hpp>
#include <octavo/classic/csg_descent.hpp>

namespace octavo::classic {
namespace {

using octree::DfCode;
using octree::Node;

/// The second look of the classic method: a descent that follows an octree's own nodes, prunes the expression on
/// the way, and resolves the gray cells it arrives at. Decided cells stay as they are.
class GrayCells {
  public:
    struct Description {
        CsgDescent::Description words;
        std::size_t node = 0;  // of the cell in the code
    };
    using Workspace = CsgDescent::Workspace;
    using Output = CsgDescent::Output;

    GrayCells(const CsgDescent& descent, const DfCode& code) : descent_(descent), code_(code) {}

    int depth() const { return descent_.depth(); }
    Workspace make_workspace() const { return descent_.make_workspace(); }
    Output make_output() const { return {}; }
    std::size_t weight(const Description& d) const { return descent_.weight(d.words); }
    Description transfer(const octree::Cell& cell, const Description& d, const Workspace& from,
                         Workspace& to) const {
        return {descent_.transfer(cell, d.words, from, to), d.node};
    }
    octree::Restricted<Description> root(Workspace& workspace) const {
        if (is_leaf(code_[0])) return {code_[0], {}};
        return {Node::split, {descent_.root(workspace).description, 0}};
    }

    void restrict_to_children(const octree::Cell& parent, const Description& d, Workspace& workspace,
                              octree::Children<Description>& children) const {
        octree::Children<CsgDescent::Description> pruned;
        descent_.restrict_to_children(parent, d.words, workspace, pruned);
        std::size_t node = d.node + 1;
        for (std::size_t i = 0; i < 8; ++i) {
            const Node known = code_[node];
            const bool open = known == Node::split || known == Node::gray;
            // Pruning is three-valued logic as well: it decides what combining octrees does, and what is out of reach.
            children[i] = {open ? pruned[i].node : known, {pruned[i].description, node}};
            for (std::size_t pending = 1; pending > 0;)
                pending += code_[node++] == Node::split ? 7 : std::size_t(-1);
        }
    }

    static constexpr int finished_levels = CsgDescent::finished_levels;
    Node finish(const octree::Cell& cell, const Description& d, Workspace& workspace, Output& output) const {
        CsgDescent::Octants known;
        unsigned open = 0;
        std::size_t node = d.node + 1;
        for (unsigned i = 0; i < 8; ++i) {
            known[i].node = code_[node];
            if (known[i].node == Node::split) {
                open |= 1U << i;
                known[i].colors = colors_below(node);
            } else {
                ++node;
            }
        }
        CsgDescent::Octants seen = descent_.color_octants(cell, d.words, open, workspace);
        for (std::size_t i = 0; i < 8; ++i) {
            if (!(open >> i & 1))
                seen[i].node = known[i].node;
            else if (seen[i].node == Node::split)
                seen[i].colors = joined(known[i].colors, seen[i].colors);
        }
        return CsgDescent::write(cell, seen, d.words, workspace, output);
    }

  private:
    /// What is not known from the octree is as seen.
    static octree::GrandchildColors joined(const octree::GrandchildColors& known,
                                           const octree::GrandchildColors& seen) {
        const std::uint64_t open = ~(known.white | known.black);
        return {known.white | (seen.white & open), known.black | (seen.black & open)};
    }

    /// Of the octants of a split node and theirs. Moves on to the node after them.
    octree::GrandchildColors colors_below(std::size_t& node) const {
        octree::GrandchildColors colors;
        const auto add = [&](Node leaf, std::uint64_t cells) {
            if (leaf == Node::white) colors.white |= cells;
            if (leaf == Node::black) colors.black |= cells;
        };
        ++node;
        for (int outer = 0; outer < 8; ++outer) {
            const Node octant = code_[node++];
            if (is_leaf(octant)) {
                add(octant, std::uint64_t{0xFF} << (8 * outer));
                continue;
            }
            for (int inner = 0; inner < 8; ++inner)
                add(code_[node++], std::uint64_t{1} << (8 * outer + inner));
        }
        return colors;
    }

    const CsgDescent& descent_;
    const DfCode& code_;
};

void add(CsgBuildStats& stats, const CsgDescent::Counters& counters) {
    stats.octants += counters.octants;
    stats.primitive_tests += counters.tests;
    stats.resolved += counters.resolved;
}

Result<DfCode> build_top_down(const csg::Program& program, const CsgBuildOptions& options,
                              CsgBuildStats& stats, const Context& context) {
    CsgDescent::Counters counters;
    const CsgDescent problem(program, program.words, {options.depth, CsgDescentOptions::LastLevel::resolve},
                             counters);
    Result<CsgDescent::Output> built =
        octree::descend(problem, context, {.phase = "top-down", .max_nodes = options.max_nodes});
    if (!built) return built.error();
    add(stats, counters);
    stats.peak_nodes = built->peak();
    DfCode code = built->take_code();
    stats.peak_bytes = code.memory_bytes() + counters.program_bytes;
    return code;
}

/// An octree of each leaf of `primitives`; gray cells are looked at again by `program`, which may have fewer.
Result<DfCode> build_classic(const csg::Program& primitives, const csg::Program& program,
                             const CsgBuildOptions& options, CsgBuildStats& stats, const Context& context) {
    Result<PrimitivewiseOctree> combined = build_by_primitive(primitives, options, context);
    if (!combined) return combined.error();
    const std::uint64_t count = stats.primitives;
    stats = combined->stats;
    stats.primitives = count;
    CsgDescent::Counters counters;
    const CsgDescent descent(program, program.words, {options.depth, CsgDescentOptions::LastLevel::resolve},
                             counters);
    Result<CsgDescent::Output> resolved = octree::descend(
        GrayCells(descent, combined->code), context, {.phase = "gray cells", .max_nodes = options.max_nodes});
    if (!resolved) return resolved.error();
    stats.resolved = counters.resolved;
    // The second look reads one octree, writes another and prunes programs on the way.
    const std::uint64_t nodes = combined->code.size() + resolved->peak();
    DfCode code = resolved->take_code();
    stats.peak_nodes = std::max(stats.peak_nodes, nodes);
    stats.peak_bytes = std::max<std::uint64_t>(
        stats.peak_bytes, combined->code.memory_bytes() + code.memory_bytes() + counters.program_bytes);
    return code;
}

/// The level whose cells have at most this side in the world; none when that is below the last.
std::optional<int> depth_for(double precision, const exact::Lattice& lattice) {
    for (int depth = 0; depth <= octree::max_level; ++depth)
        if (lattice.unit() * octree::cell_side(depth) <= precision) return depth;
    return {};
}

/// `primitives` are those of the classic method.
Result<CsgOctree> build_either(const csg::Program& program, const csg::Program& primitives,
                               CsgBuildOptions options, const Context& context) {
    int& depth = options.depth;
    if (!(options.precision >= 0) || !std::isfinite(options.precision))
        return Error{ErrorCode::bad_input, "the precision is not a positive number", {}};
    if (options.precision > 0) {
        const std::optional<int> needed = depth_for(options.precision, program.lattice);
        if (!needed)
            return Error{ErrorCode::limit, "the precision asks for more than 21 levels of octants", {}};
        depth = *needed;
    }
    if (depth < 0 || depth > octree::max_level)
        return Error{ErrorCode::bad_input,
                     "the depth of the octree is " + std::to_string(depth) + ", not in 0 to 21",
                     {}};
    CsgBuildStats stats;
    stats.primitives = program.primitives;
    if (program.words.empty()) {
        DfCode code;
        code.append(program.constant ? Node::black : Node::white);
        stats.peak_nodes = 1;
        return CsgOctree{octree::Octree(program.lattice, depth, std::move(code)), stats};
    }
    Result<DfCode> code = options.method == CsgMethod::top_down
                              ? build_top_down(program, options, stats, context)
                              : build_classic(primitives, program, options, stats, context);
    if (!code) return code.error();
    return CsgOctree{octree::Octree(program.lattice, depth, std::move(*code)), stats};
}

}  // namespace

Result<CsgOctree> build(const csg::Program& program, const CsgBuildOptions& options, const Context& context) {
    return build_either(program, program, options, context);
}

Result<CsgOctree> build(const csg::Expr& expression, const CsgBuildOptions& options, const Context& context) {
    csg::CompileOptions compile_options;
    compile_options.universe = options.universe;
    Result<csg::Program> program = csg::compile(expression, compile_options, context);
    if (!program) return program.error();
    if (options.method == CsgMethod::top_down) return build_either(*program, *program, options, context);
    // The classic method knows nothing of what is around a primitive: it colours them all.
    compile_options.primitives = csg::CompileOptions::Primitives::all;
    const Result<csg::Program> primitives = csg::compile(expression, compile_options, context);
    if (!primitives) return primitives.error();
    return build_either(*program, *primitives, options, context);
}

}  // namespace octavo::classic
