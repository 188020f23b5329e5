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
// a corner of a facet, inside it, along an axis to the outside. "Infinitely near" is symbolic: the point is
// v + ε (a - v) + ε² (b - v), so that it is on no plane and under no edge but its own facet's.
//
// Invariant, checked at every patch: a region reached twice has the same winding numbers (a 64-bit sum of random
// multiples of them is compared).
// Cost: linear in patches times the depth of the expression; one ray a component.

namespace octavo::boolean {

enum class Role : std::int8_t {
    dropped = 0,
    kept = 1,      ///< bounds the result, its front outside
    reversed = -1  ///< bounds the result, its front inside
};

struct Classification {
    std::vector<Role> of_patch;
    std::size_t components = 0;  ///< one ray each
};

/// Errors: internal when winding numbers contradict each other; bad_input when the result would be unbounded.
Result<Classification> classify(const Complex& complex, const PointTable& points, const FacetTree& tree,
                                const Patches& patches, const Program& program, const Context& context);

}  // namespace octavo::boolean
