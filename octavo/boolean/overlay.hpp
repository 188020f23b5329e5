// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include <octavo/boolean/soup.hpp>

// Whether two facets lie on each other within a tolerance: seen along the normal they share an area, and over all of
// it they are not farther apart.

namespace octavo::boolean {

/// `tolerance` in lattice units. Measured in doubles: nearness is a wish, not a decision about geometry.
bool lie_on_each_other(const Soup& soup, std::uint32_t first, std::uint32_t second, double tolerance);

}  // namespace octavo::boolean
