// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/boolean/soup.hpp>

// Facets with the same three corners become one, the first, which carries the sum of their winding changes; where that
// is nothing, they vanish.
//
// Facets are dealt out by ranges of their least corners. Meshes are mostly numbered in some order, so that a range has
// few facets that lie far apart, and a hash table for them fits the second-level cache. Ranges are independent, but new
// sums are numbered one after another. Cost: about 12 ns a facet.

namespace octavo::boolean {

/// Cancellation leaves coincident facets.
void merge_coincident(Soup& soup, const Context& context);

}  // namespace octavo::boolean
