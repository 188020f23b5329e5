// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/csg/convex_piece.hpp>
#include <octavo/csg/expression.hpp>
#include <octavo/csg/region.hpp>

// A solid of flat primitives taken apart into convex pieces, for what is easy on convex bodies only: hulls, Minkowski
// sums, shadows and sections.
//
// Idea: restrict the expression to a convex cell, the bounding box at first. A convex leaf clips the cell; the
// complement of one leaves a piece outside each of its planes in turn; an intersection restricts the pieces of one
// operand to the next; a union gathers (pieces may overlap, which none of the uses mind). A mesh that is not convex
// cuts the cell by the planes of its facets (a BSP) until none is left in it, and the winding number of a point
// says what the rest is. Source: W. Thibault and B. Naylor, Set operations on polyhedra using BSP trees, 1987.
// Not exact: doubles with a tolerance of 2^-36 of the solid's extent.

namespace octavo::csg {

struct ConvexPiecesOptions {
    /// More pieces than this, or more facets in a mesh that is not convex, is ErrorCode::limit.
    std::size_t most_pieces = 200'000;
    std::size_t most_facets = 20'000;
};

/// Errors: unsupported for curved primitives, symmetric differences and unbounded solids; limit; cancelled.
Result<std::vector<ConvexPiece>> convex_pieces(const Expr& expression,
                                               const ConvexPiecesOptions& options = {},
                                               const Context& context = {});

/// Whether the expression is only unions and maps of flat primitives, so that its hull is that of their corners.
/// Then these are the corners.
Result<std::vector<Vec3>> corners_of(const Expr& expression, const Context& context = {});

/// The solid seen from above, on the plane z = 0.
Result<Region> shadow(const Expr& expression, const Context& context = {});
/// The solid's section with the plane z = 0; a face in that plane counts.
Result<Region> section(const Expr& expression, const Context& context = {});

/// All sums of a point of `a` and one of `b`.
Result<Expr> minkowski_sum(const Expr& a, const Expr& b, const Context& context = {});

/// The bounds of the solid itself, not of its operands.
Result<Box3> tight_bounds(const Expr& expression, const Context& context = {});

}  // namespace octavo::csg
