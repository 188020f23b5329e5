// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/mesh/mesh.hpp>

// How often closed shells wind round places right beside facets, exactly.
//
// Problem: winding numbers are constant where no facet is, and change at facets alone; so what there is to know about
// them is known in front of every facet and behind it. But places on a surface are where every degenerate case is:
// other shells touch there, lie flush, share edges or coincide.
// Idea: a place is the middle of a facet, moved by a symbolic step off the facet that is smaller than anything else,
// and from there a ray to the left counts its crossings. Further, far smaller steps to the left, along y and along z
// make it general, so it meets no edge and no vertex: signs are those of the value, or of the derivative along the
// first step that is not zero (H. Edelsbrunner, E. P. Mücke, "Simulation of simplicity", 1990). Invariant: facets that
// share an edge agree about it, so that every closed shell has one winding number at a place. Cost: facets look up the
// places in a grid over y and z: linear, unless the facets are large and the places many.

namespace octavo::mesh {

/// Right in front of the middle of a facet, or right behind it. The facet must have area on the lattice.
struct PlaceBeside {
    FaceIndex face = 0;
    bool behind = false;
};

struct PlaceWinding {
    std::uint32_t place = 0;   ///< which of the places
    std::uint32_t shell = 0;   ///< what winds round it
    std::int32_t winding = 0;  ///< how often; not 0
    friend auto operator<=>(const PlaceWinding&, const PlaceWinding&) = default;
};

/// Which shells are counted: that of the place's own facet, or all but that.
enum class Winders : std::uint8_t { own, others };

/// Sorted by place and shell. `shell_of_face` is no_index for facets that do not count; the facets of each shell that
/// does must close.
std::vector<PlaceWinding> windings_beside(std::span<const exact::Point> points,
                                          std::span<const Triangle> triangles,
                                          std::span<const std::uint32_t> shell_of_face,
                                          std::span<const PlaceBeside> places, Winders winders);

}  // namespace octavo::mesh
