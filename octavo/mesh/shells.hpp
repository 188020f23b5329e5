// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/exact/int128.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/mesh/topology.hpp>

// Shells, which lies in which, and how often space winds beside their facets.
//
// A shell is what facets are joined to by shared edges. A closed, consistently oriented one has a volume and an
// inside; a solid may consist of several: bodies side by side, cavities in them, bodies in cavities. Whether a
// shell is the right way round depends on where it lies: no winding number beside it may be negative. So a shell with
// negative volume is inside out in free space and a cavity inside of a body.
//
// A shell that shares its edges two by two is one surface, and the sign of its volume says which side of it is inside.
// One in which more facets meet at an edge is made of patches, and may be bodies that hang together there, one of them
// inside out: the volume says nothing then, and each patch is asked (windings_beside.hpp).
//
// One shell lies in another when a place right inside one of its facets does, and the other one is the larger. So
// shells may lie flush against each other, touch and coincide: of what is equal, the first is the larger.
//
// Not guaranteed: where shells cross each other, or facets overlap in a plane, the answers depend on the facet asked:
// the first in the order of the positions of corners, which no numbering changes.

namespace octavo::mesh {

struct Enclosure {
    std::uint32_t shell = 0;
    std::int32_t winding = 0;  ///< of that shell, round the place; not 0
    friend bool operator==(const Enclosure&, const Enclosure&) = default;
};

struct Shell {
    std::uint32_t faces = 0;
    bool closed = false;        ///< every edge is run along equally often both ways
    bool crowded = false;       ///< more than two facets meet at one of its edges
    exact::int128 volume6 = 0;  ///< six times the signed volume in lattice units
    std::int32_t lowest = 0,
                 highest = 0;  ///< least and greatest winding number beside a closed one, by itself alone
    std::vector<Enclosure> enclosures;  ///< closed shells round a closed one, ascending

    /// Winding number of the space round the shell, by all other shells.
    std::int32_t winding_around() const {
        std::int32_t sum = 0;
        for (const Enclosure& enclosure : enclosures) sum += enclosure.winding;
        return sum;
    }
    /// The shell, or a part of it, makes a winding number negative.
    bool inside_out() const { return closed && lowest < 0 && winding_around() + lowest < 0; }
    bool cavity() const { return closed && lowest < 0 && winding_around() + lowest >= 0; }
    /// A double sheet, or a body too thin for the lattice.
    bool flat() const { return closed && lowest == 0 && highest == 0; }
    /// Space in it is enclosed by another shell already.
    bool nested_body() const { return closed && highest > 0 && winding_around() > 0; }
    /// Winding numbers beside it are 0 and 1.
    bool separates() const {
        return closed && winding_around() + lowest == 0 && winding_around() + highest == 1;
    }
};

struct Shells {
    std::vector<std::uint32_t> of_face;  ///< no_index for facets that repeat a vertex
    std::vector<Shell> shells;
    /// The winding number right in front of each facet of a closed shell, by that shell alone. Of facets on the same
    /// corners each has its own, as if they lay one behind the other.
    std::vector<std::int32_t> in_front;
    /// The closed shells, larger ones first: a shell lies only in such that come before it.
    std::vector<std::uint32_t> by_size;
};

/// Equal points must have equal indices.
Shells find_shells(std::span<const exact::Point> points, std::span<const Triangle> triangles,
                   const EdgeTable& edges);

}  // namespace octavo::mesh
