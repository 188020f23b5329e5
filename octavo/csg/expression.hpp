// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

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

    Operation operation() const;
    /// Of a leaf.
    const Primitive& primitive() const;
    /// Of a transform.
    const Affine& map() const;
    const std::vector<Expr>& operands() const;
    /// Equal for handles of one node.
    const void* identity() const { return node_.get(); }

  private:
    explicit Expr(std::shared_ptr<const Node> node) : node_(std::move(node)) {}
    friend Expr combine(Operation operation, std::vector<Expr> operands);
    friend Expr transform(const Affine& map, Expr operand);

    std::shared_ptr<const Node> node_;
};

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
