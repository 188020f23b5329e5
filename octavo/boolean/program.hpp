// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

// A set expression over numbered operands, in the form in which classification evaluates it.
//
// Problem: the indicator of an expression of thousands of operands is asked for once per region of space, and
// neighbouring regions differ in one or two operands. Idea: each node counts its true inputs; a change of one
// operand climbs only as far as values change. Cost of a change: at most the depth of the expression, usually
// one or two nodes; memory: one counter per node.

namespace octavo::boolean {

enum class Gate : std::uint8_t { any, all, odd };  ///< union, intersection, symmetric difference

/// A tree of gates over operands, which alone may have several parents. Inputs come before their gate; the last
/// node is the root.
class Program {
  public:
    using NodeId = std::uint32_t;

    /// The node that stands for an operand; asking twice for one operand gives one node.
    NodeId operand(std::uint32_t index);
    /// A gate over `inputs`; where `negated[i]`, the complement of input i counts. `negated` may be empty.
    NodeId gate(Gate gate, std::span<const NodeId> inputs, std::span<const bool> negated = {});

    static Program union_of(std::uint32_t operands);
    static Program intersection(std::uint32_t operands);
    /// Operand 0 without all others.
    static Program difference(std::uint32_t operands);
    static Program symmetric_difference(std::uint32_t operands);

    /// Number of operands named, at least one more than the greatest index.
    std::uint32_t operands() const { return static_cast<std::uint32_t>(node_of_operand_.size()); }
    std::size_t nodes() const { return nodes_.size(); }

  private:
    friend class Indicator;
    struct Node {
        Gate gate = Gate::any;
        std::uint32_t arity = 0;
        std::vector<std::uint32_t> parents;  ///< 2 · parent + (this input is negated)
    };
    static constexpr NodeId none = ~NodeId{0};

    std::vector<Node> nodes_;
    std::vector<NodeId> node_of_operand_;
};

/// The value of a program while operands change one by one. At first all operands are out.
class Indicator {
  public:
    explicit Indicator(const Program& program);

    void set(std::uint32_t operand, bool inside);
    /// Whether the point is in the result.
    bool value() const { return value_.empty() ? false : value_.back() != 0; }

  private:
    void change(Program::NodeId operand, bool inside);
    bool evaluate(Program::NodeId node) const;

    const Program& program_;
    std::vector<std::uint32_t> true_inputs_;
    std::vector<char> value_;
    std::vector<std::pair<Program::NodeId, bool>> changed_;  ///< and what they have become
};

}  // namespace octavo::boolean
