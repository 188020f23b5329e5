// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/uninitialised.hpp>
#include <octavo/boolean/soup.hpp>

// Coordinates along and across a bundle of slivers.
//
// Problem: where a long thin part is triangulated, fans of slivers lie beside each other in bundles, thousands along
// one skew line and no thicker altogether than a thousandth of their length. Upright boxes of any two of them meet, and
// so do those of the nodes of a tree of them. Idea: seen along the bundle each is small. An axis of a turned frame runs
// along the bundle, the two others across it, the first of these where the bundle is widest; each is stretched for
// itself so that the bundle fills the universe. Boxes in these coordinates are thin in the lattice, and a Morton order
// of them divides the bundle across as well as along, so that the nodes of a tree are bundles in turn.
//
// Conservative: places are rounded down, which keeps the order along each axis, so boxes of facets that meet do meet
// here. `margin` is what boxes must grow by on every side to meet when facets come within a reach; it allows for the
// rounding of doubles too: stretched by 2^19 at most, a place is off by less than 2^19 · 2^26 · 16 · 2^-53 units, half
// of one.
//
// Bundles are found by the directions of longest edges: the fullest cell of the cube of directions gives one, with all
// that run nearly like it. Whether its frame pays is told by a sample of boxes. In the worst pair of fans that we have
// a sliver's upright box meets those of half of all 31 000 facets, its box in the frame a sixth; the search for
// contacts takes a fifth of the time. Cost: some 0.1 µs a long facet to look for bundles, 0.1 µs a facet of the soup
// for each bundle that pays.

namespace octavo::boolean {

struct TurnedFrame {
    /// Of a point x: stretch[k] (axis[k] · x) − origin[k]. The axes are orthonormal but for rounding.
    double axis[3][3], stretch[3], origin[3];
    std::array<std::int32_t, 3> margin;

    /// Within [0, universe side); what lies outside of the bundle's box is moved to its sides.
    exact::Point place(exact::Point point) const;
    /// Whether what fills the box of places from `low` to `high` is beyond the reach of all facets of the bundle.
    static bool is_outside(exact::Point low, exact::Point high) {
        constexpr std::int32_t last = exact::universe_side - 1;
        return high.x == 0 || high.y == 0 || high.z == 0 || low.x == last || low.y == last || low.z == last;
    }
};

/// Slivers that run in nearly one direction.
struct Bundle {
    TurnedFrame frame;
    std::vector<std::uint32_t> facets;
};

/// The bundles among the facets `slivers` in which a search for the facets that they may meet (within `reach`) would
/// save more time than a tree costs. Most of the facets may be in none.
std::vector<Bundle> bundles_among(const Soup& soup, std::span<const std::uint32_t> slivers, double reach);

}  // namespace octavo::boolean
