// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <octavo/base/check.hpp>
#include <octavo/csg/primitive.hpp>

// A CSG expression: primitives, affine maps and n-ary set operations.
//
// An Expr is a small value: copies share the nodes below, which never change, so one sub-expression may stand in
// many places and in many threads. Nothing is computed when one is built; `normal_form` simplifies, `compile`
// puts it on a lattice. Trees may be millions of levels deep: building and destroying one uses no recursion.
// Source: A. Requicha and H. Voelcker, Constructive solid geometry, 1977.

namespace octavo::csg {

enum class Operation : std::uint8_t {
    primitive,             ///< a leaf
    transform,             ///< an affine map of the one operand
    union_of,              ///< in any operand; of none it is the empty solid
    intersection,          ///< in all operands; of none it is all of space
    difference,            ///< in the first operand and in no other; of none it is the empty solid
    symmetric_difference,  ///< in an odd number of operands
    complement,            ///< outside the one operand
};

class Expr {
  public:
    struct Node;

    /// The empty solid.
    Expr();
    Expr(Primitive primitive);

    inline Operation operation() const;
    /// Of a leaf.
    inline const Primitive& primitive() const;
    /// Of a transform.
    inline const Affine& map() const;
    inline const std::vector<Expr>& operands() const;
    /// Equal for handles of one node.
    const void* identity() const { return node_.get(); }

  private:
    explicit Expr(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
    friend Expr combine(Operation operation, std::vector<Expr> operands);
    friend Expr transform(const Affine& map, Expr operand);

    std::shared_ptr<const Node> node_;
};

struct Expr::Node {
    Operation operation = Operation::union_of;
    Primitive primitive = Everything{};
    Affine map;
    std::vector<Expr> operands;

    Node() = default;
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;
    ~Node();
};

// Here, since a walk asks them of every node.
inline Operation Expr::operation() const { return node_->operation; }
inline const Primitive& Expr::primitive() const {
    OCTAVO_CHECK(node_->operation == Operation::primitive, "only a leaf has a primitive");
    return node_->primitive;
}
inline const Affine& Expr::map() const {
    OCTAVO_CHECK(node_->operation == Operation::transform, "only a transform has a map");
    return node_->map;
}
inline const std::vector<Expr>& Expr::operands() const { return node_->operands; }

/// Any set operation; `complement` takes exactly one operand.
Expr combine(Operation operation, std::vector<Expr> operands);

/// The image of a solid. A map that squeezes space flat gives the empty solid.
Expr transform(const Affine& map, Expr operand);

inline Expr unite(std::vector<Expr> operands) { return combine(Operation::union_of, std::move(operands)); }
inline Expr intersect(std::vector<Expr> operands) {
    return combine(Operation::intersection, std::move(operands));
}
/// The first without all others.
inline Expr subtract(std::vector<Expr> operands) {
    return combine(Operation::difference, std::move(operands));
}
inline Expr symmetric_difference(std::vector<Expr> operands) {
    return combine(Operation::symmetric_difference, std::move(operands));
}
inline Expr complement(Expr operand) { return combine(Operation::complement, {std::move(operand)}); }

inline Expr everything() { return Expr(Everything{}); }
inline Expr nothing() { return {}; }

}  // namespace octavo::csg
