// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include <octavo/classic/facet.hpp>

// A filter without branches for the test of a point against the facets of a leaf.
//
// It walks the same path as leaf_test.hpp (low corner R, then along x, y and z to the point) for four facets at a
// time in doubles, and either knows the change of the winding number for certain or says that it does not; then the
// exact test decides.
//
// Bounds, with u = 2^-53 and L a bound of all coordinates relative to R, of corners and of the point. Corners are
// exact, the point rounds once or twice, by u L in all. An edge function is two products of differences (2L, off by 3 u
// L) and their difference: off by 40 u L² at most. A component of the normal (8 L²) is off by 16 u L², the plane's
// value at R by 112 u L³, and each step adds 64, 72 and 80 u L³. 64 and 512 are used.

namespace octavo::query {

/// The change of the winding number from the leaf's displaced low corner to the point `offset` from it, as far as these
/// facets cause it; none when rounding leaves a doubt, as for every point on a facet. `extent` is L.
/// Four bytes after the last facet must be readable.
std::optional<int> winding_change(std::span<const std::uint32_t> references,
                                  std::span<const classic::FacetCorners> facets,
                                  const std::array<std::int32_t, 3>& low, double extent,
                                  const std::array<double, 3>& offset);

}  // namespace octavo::query
