// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include <octavo/base/check.hpp>
#include <octavo/boolean/program.hpp>

namespace octavo::boolean {

Program::NodeId Program::operand(std::uint32_t index) {
    if (index >= node_of_operand_.size()) node_of_operand_.resize(index + 1, none);
    if (node_of_operand_[index] == none) {
        node_of_operand_[index] = static_cast<NodeId>(nodes_.size());
        nodes_.emplace_back();
    }
    return node_of_operand_[index];
}

Program::NodeId Program::gate(Gate gate, std::span<const NodeId> inputs, std::span<const bool> negated) {
    const NodeId id = static_cast<NodeId>(nodes_.size());
    nodes_.push_back({gate, static_cast<std::uint32_t>(inputs.size()), {}});
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        OCTAVO_CHECK(inputs[i] < id, "a gate's inputs come before it");
        nodes_[inputs[i]].parents.push_back(2 * id + (!negated.empty() && negated[i] ? 1 : 0));
    }
    return id;
}

namespace {

Program flat(Gate gate, std::uint32_t operands, bool negate_all_but_first) {
    Program program;
    std::vector<Program::NodeId> inputs;
    const auto negated = std::make_unique<bool[]>(operands);
    for (std::uint32_t i = 0; i < operands; ++i) {
        inputs.push_back(program.operand(i));
        negated[i] = negate_all_but_first && i > 0;
    }
    program.gate(gate, inputs, {negated.get(), operands});
    return program;
}

}  // namespace

Program Program::union_of(std::uint32_t operands) { return flat(Gate::any, operands, false); }
Program Program::intersection(std::uint32_t operands) { return flat(Gate::all, operands, false); }
Program Program::difference(std::uint32_t operands) { return flat(Gate::all, operands, true); }
Program Program::symmetric_difference(std::uint32_t operands) { return flat(Gate::odd, operands, false); }

Indicator::Indicator(const Program& program)
    : program_(program), true_inputs_(program.nodes_.size(), 0), value_(program.nodes_.size(), 0) {
    for (Program::NodeId node = 0; node < program.nodes_.size(); ++node) {
        value_[node] = program.nodes_[node].arity == 0 ? 0 : evaluate(node);
        for (const std::uint32_t parent : program.nodes_[node].parents)
            true_inputs_[parent / 2] += (value_[node] != 0) != (parent % 2 != 0);
    }
}

bool Indicator::evaluate(Program::NodeId node) const {
    switch (program_.nodes_[node].gate) {
        case Gate::any:
            return true_inputs_[node] > 0;
        case Gate::all:
            return true_inputs_[node] == program_.nodes_[node].arity;
        case Gate::odd:
            return true_inputs_[node] % 2 == 1;
    }
    return false;
}

void Indicator::set(std::uint32_t operand, bool inside) {
    if (operand >= program_.node_of_operand_.size()) return;
    const Program::NodeId node = program_.node_of_operand_[operand];
    if (node != Program::none && (value_[node] != 0) != inside) change(node, inside);
}

void Indicator::change(Program::NodeId operand, bool inside) {
    // Depth first with an explicit stack: expressions may be a million levels deep. Each change goes up with its
    // direction: an operand that stands twice in one gate may turn it on and off before either change is passed on.
    value_[operand] = inside;
    changed_.assign(1, {operand, inside});
    while (!changed_.empty()) {
        const auto [node, value] = changed_.back();
        changed_.pop_back();
        for (const std::uint32_t parent : program_.nodes_[node].parents) {
            const bool negated = parent % 2 != 0;
            true_inputs_[parent / 2] += value != negated ? 1u : ~0u;
            const bool now = evaluate(parent / 2);
            if ((value_[parent / 2] != 0) == now) continue;
            value_[parent / 2] = now;
            changed_.push_back({parent / 2, now});
        }
    }
}

}  // namespace octavo::boolean
