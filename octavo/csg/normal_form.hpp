// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/csg/expression.hpp>

// The positive normal form of an expression: unions, intersections and symmetric differences of leaves that may
// be complemented, in one flat array.
//
// Idea: a complement moves down by De Morgan's rules until it is a flag of a leaf, A − B is A ∩ ¬B, and affine
// maps are multiplied down to the leaves. What is left has only operations that are commutative and know nothing
// of order, so nested ones of one kind melt into one n-ary node, and constants disappear. A symmetric difference
// keeps one flag: its complement counts an even number of operands.
//
// The array is in prefix order: an operation is followed by its operands, each with all that is below it, and
// knows how many tokens that is. Every later stage (bounds, compiling, pruning) is one pass over such an array
// with a small stack. Invariant: an operation has at least two operands, none of them of its own kind (except
// symmetric differences) and none constant; the whole may be one constant.
// Cost: linear, without recursion. Source: R. Goldfeather and others, Near real-time CSG rendering using tree
// normalization and geometric pruning, 1989, without their sum of products, which grows exponentially.

namespace octavo::csg {

enum class NormalKind : std::uint8_t { leaf, union_of, intersection, symmetric_difference, constant };

struct NormalToken {
    NormalKind kind = NormalKind::leaf;
    /// Of a leaf or a symmetric difference: it stands for its complement. Of a constant: it is everything.
    bool complemented = false;
    std::uint32_t size = 1;  ///< tokens of the sub-tree, this one included
    std::uint32_t leaf = 0;  ///< index into `leaves`

    friend bool operator==(const NormalToken&, const NormalToken&) = default;
};

/// A primitive of the expression, which it points into, and where it is.
struct PlacedPrimitive {
    const Primitive* primitive;
    Affine place;
};

struct NormalForm {
    std::vector<NormalToken> tokens;
    /// Each occurrence of a primitive in the expression that is still there.
    std::vector<PlacedPrimitive> leaves;
    /// Keeps the primitives.
    Expr expression;

    bool is_constant() const { return tokens.front().kind == NormalKind::constant; }
};

struct NormalFormOptions {
    /// A shared sub-expression counts wherever it stands, so few nodes can mean many leaves; more than this many
    /// is ErrorCode::limit. The default needs about 10 GB.
    std::uint64_t max_leaves = std::uint64_t{1} << 26;
};

/// Errors: bad_input when a parameter or a matrix is not finite; limit.
Result<NormalForm> normal_form(const Expr& expression, const NormalFormOptions& options = {});

}  // namespace octavo::csg
