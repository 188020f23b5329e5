// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/boolean/arrangement.hpp>
#include <octavo/boolean/facet_tree.hpp>
#include <octavo/boolean/patches.hpp>
#include <octavo/boolean/program.hpp>

// Which patches bound the result.
//
// The sides of patches that look at one region of space are one node of a graph; a patch joins the regions in
// front of it and behind it and knows how the winding numbers change. One depth-first walk carries a single vector
// of winding numbers through the graph, changing an operand or two at every step and the expression's value with
// them, and takes the changes back on the way out. So thousands of operands cost one vector, not one a patch.
//
// Each connected part of the graph starts from one ray, in exact arithmetic: from a point that lies infinitely near
// a corner of a triangle, inside it, along an axis to the outside. "Infinitely near" is symbolic: the point is
// v + ε (a - v) + ε² (b - v), so that it is on no plane and under no edge but its own triangle's.
//
// A patch may belong to the result although neither side of it does: where closed operands share a face, both hold on
// it and nowhere next to it. Such patches are *dangling*; regularised results do without them.
//
// Invariant, checked at every patch: a region reached twice has the same winding numbers (a 64-bit sum of random
// multiples of them is compared).
// Cost: linear in patches times the depth of the expression; one ray a component.

namespace octavo::boolean {

enum class Role : std::int8_t {
    dropped = 0,
    kept = 1,       ///< bounds the result, its front outside
    reversed = -1,  ///< bounds the result, its front inside
    dangling = 2    ///< in the result, with neither side of it
};

enum class Dangling : std::uint8_t {
    dropped,  ///< results are regularised
    kept,
};

struct Classification {
    std::vector<Role> of_patch;
    std::size_t components = 0;  ///< one ray each
};

/// An operand holds on a patch when it holds on either side of it.
/// Errors: internal when winding numbers contradict each other; bad_input when the result would be unbounded.
Result<Classification> classify(const Complex& complex, const PointTable& points, const FacetTree& tree,
                                const Patches& patches, const Program& program, Dangling dangling,
                                const Context& context);

}  // namespace octavo::boolean
