// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/boolean/contacts.hpp>
#include <octavo/exact/plane.hpp>

// The planes of the facets that cut others, each once.
//
// Boxes side by side have thousands of facets in one plane. Named by their plane, the cuts that they make in a
// facet lie on one line, and that points are on it is known without looking at their coordinates.
// Cost: about 0.3 µs a cutting facet, for the primitive form of its plane.

namespace octavo::boolean {

struct CutPlanes {
    std::vector<exact::Plane> planes;
    /// Where in `planes`, for facets that cut others, else no_index.
    UninitialisedVector<std::uint32_t> of_facet;
};

CutPlanes find_cut_planes(const Soup& soup, const Contacts& contacts, const Context& context);

}  // namespace octavo::boolean
