// SPDX-License-Identifier: Apache-2.0
#include <octavo/bsp/classify.hpp>
#include <octavo/bsp_octree/meet.hpp>

namespace octavo::bsp_octree {
namespace {

using bsp::FragmentPool;

/// Labels of cells without faces of an intersection: those of both trees.
class TreeColors {
  public:
    struct State {};

    TreeColors(const Store& store, NodeRef first, NodeRef second)
        : store_(store), first_(first), second_(second) {}

    std::array<State, 8> octants(const octree::Cell&, std::span<const bsp::Fragment>, State) { return {}; }

    bsp::Label label(const octree::Cell& cell, State) const {
        const bool in =
            bsp::label_of_uniform_cell(store_.tree(first_), cell, store_.planes) == bsp::Label::in &&
            bsp::label_of_uniform_cell(store_.tree(second_), cell, store_.planes) == bsp::Label::in;
        return in ? bsp::Label::in : bsp::Label::out;
    }

    NodeRef leaf(Workspace& workspace, const octree::Cell&, std::span<const bsp::Fragment> fragments,
                 State) const {
        return workspace.make_leaf(fragments);
    }

  private:
    const Store& store_;
    NodeRef first_, second_;
};

}  // namespace

NodeRef Meet::operator()(NodeRef first, NodeRef second) {
    Operand a{first}, b{second};
    return meet(octree::Cell::root(), a, b).node;
}

Meet::Outcome Meet::meet(const octree::Cell& cell, Operand& first, Operand& second) {
    if (workspace_.cancelled()) return {};
    std::optional<Outcome> outcome = settle(first, second);
    if (outcome)
        workspace_.finish(cell);
    else if (first.node.is_gray() || second.node.is_gray())
        return meet_octants(cell, first, second);
    else
        outcome = meet_leaves(cell, first, second);
    if (edit_ && !outcome->unchanged) edit_->changed.push_back(cell);
    return *outcome;
}

std::optional<Meet::Outcome> Meet::settle(Operand& first, Operand& second) {
    const bool are_nodes = !first.is_part && !second.is_part;
    if (first.node.is_white() || second.node.is_black() || (are_nodes && first.node == second.node))
        return Outcome{first.node, true};
    if (second.node.is_white() || (are_nodes && first.node == second.node.complement()))
        return Outcome{NodeRef::white()};
    if (first.node.is_black()) return Outcome{node_of(second)};
    return std::nullopt;
}

Meet::Outcome Meet::meet_octants(const octree::Cell& cell, Operand& first, Operand& second) {
    const FragmentPool::Mark mark = workspace_.pool().mark();
    const std::size_t changed_before = edit_ ? edit_->changed.size() : 0;
    std::array<Operand, 8> firsts = octants(cell, first), seconds = octants(cell, second);
    std::array<Outcome, 8> outcomes;
    bool unchanged = true;
    for (int i = 0; i < 8; ++i) {
        const auto octant = static_cast<std::size_t>(i);
        outcomes[octant] = meet(cell.child(i), firsts[octant], seconds[octant]);
        unchanged = unchanged && outcomes[octant].unchanged;
    }
    Outcome result{first.node, unchanged};
    if (!unchanged) {
        Octants nodes;
        for (std::size_t i = 0; i < 8; ++i)
            nodes[i] = outcomes[i].unchanged ? node_of(firsts[i]) : outcomes[i].node;
        result.node = workspace_.make_gray(cell, nodes);
        // A cell that is one leaf now has changed as a whole; so has a leaf that is split now.
        if (edit_ && (!first.node.is_gray() || !result.node.is_gray())) {
            edit_->changed.resize(changed_before);
            edit_->changed.push_back(cell);
        }
    }
    workspace_.pool().release(mark);
    return result;
}

Meet::Outcome Meet::meet_leaves(const octree::Cell& cell, Operand& first, Operand& second) {
    const FragmentPool::Mark mark = workspace_.pool().mark();
    load_faces(cell, first), load_faces(cell, second);
    std::optional<Outcome> outcome = settle(first, second);
    if (outcome)
        workspace_.finish(cell);
    else
        outcome = meet_faces(cell, first, second);
    workspace_.pool().release(mark);
    return *outcome;
}

Meet::Outcome Meet::meet_faces(const octree::Cell& cell, Operand& first, Operand& second) {
    if (edit_) ++edit_->merged_cells;
    const Store& store = workspace_.store();
    Fragments faces;
    const bsp::Intersection met = bsp::intersect(workspace_.pool(), first.faces, store.tree(first.node),
                                                 second.faces, store.tree(second.node), clipper_, faces);
    Outcome outcome;
    if (faces.empty()) {
        // Where the first has a face, it has an outside, which is outside of the result; and nothing separates any two
        // points.
        outcome.node = NodeRef::white();
    } else if (met.all_of_first && met.none_of_second) {
        outcome = {first.node, true};
    } else if (met.all_of_second && met.none_of_first) {
        outcome.node = node_of(second);
    } else {
        Subdivider<TreeColors> subdivide(workspace_, TreeColors(store, first.node, second.node));
        return {subdivide(cell, faces, {})};
    }
    workspace_.finish(cell);
    return outcome;
}

NodeRef Meet::node_of(Operand& operand) {
    return operand.is_part ? workspace_.make_leaf(operand.faces) : operand.node;
}

std::array<Meet::Operand, 8> Meet::octants(const octree::Cell& cell, Operand& operand) {
    std::array<Operand, 8> parts;
    load_faces(cell, operand);
    if (!operand.node.is_bsp()) {
        Octants nodes;
        if (operand.node.is_gray())
            nodes = workspace_.store().octants(operand.node);
        else
            nodes.fill(operand.node);
        for (std::size_t i = 0; i < 8; ++i) parts[i].node = nodes[i];
        return parts;
    }
    const std::array<Fragments, 8>& faces = workspace_.distribute(cell, operand.faces);
    const bsp::Tree tree = workspace_.store().tree(operand.node);
    for (int i = 0; i < 8; ++i) {
        Operand& part = parts[static_cast<std::size_t>(i)];
        part.faces = faces[static_cast<std::size_t>(i)];
        if (part.faces.empty())
            part.node =
                NodeRef::uniform(bsp::label_of_uniform_cell(tree, cell.child(i), workspace_.store().planes));
        else
            part.node = operand.node, part.is_part = true;
    }
    return parts;
}

void Meet::load_faces(const octree::Cell& cell, Operand& operand) {
    if (!operand.node.is_bsp() || operand.is_part || !operand.faces.empty()) return;
    workspace_.extract(cell, operand.node, operand.faces);
    // A file may hold trees whose planes pass by the cell.
    const Store& store = workspace_.store();
    if (operand.faces.empty())
        operand.node =
            NodeRef::uniform(bsp::label_of_uniform_cell(store.tree(operand.node), cell, store.planes));
}

}  // namespace octavo::bsp_octree
