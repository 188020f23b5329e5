// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/exact/int128.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/mesh/topology.hpp>

// Shells, and which lies in which.
//
// A shell is what facets are joined to by shared edges. A closed, consistently oriented one has a volume and an
// inside; a solid may consist of several: bodies side by side, cavities in them, bodies in cavities. Whether a
// shell is the right way round depends on where it lies: the winding number of the space just inside it must not
// be negative. So a shell with negative volume is inside out in free space and a cavity inside of a body.
//
// Where a shell lies is asked at one of its vertices: a ray from there to the left counts how the other shells are
// crossed. Should the vertex lie on another shell, another vertex is tried. Exact: the ray's start is moved by
// symbolic steps (x by −ε, then y by +δ, then z by +δ², each far smaller than the one before; H. Edelsbrunner,
// E. Mücke, "Simulation of simplicity", 1990), so it meets no edge and no vertex. Facets look up the starts in a
// grid over y and z: linear unless all facets are large and the shells many.
//
// Not guaranteed: where shells cross each other, "inside" depends on the vertex; and when all vertices tried lie
// on other shells, the answer is that of the point a step to the left.

namespace octavo::mesh {

struct Enclosure {
    std::uint32_t shell = 0;
    std::int32_t winding = 0;  ///< of that shell, round the place; not 0
    friend bool operator==(const Enclosure&, const Enclosure&) = default;
};

struct Shell {
    std::uint32_t faces = 0;
    bool closed = false;                ///< every edge is run along equally often both ways
    exact::int128 volume6 = 0;          ///< six times the signed volume in lattice units
    std::vector<Enclosure> enclosures;  ///< closed shells round a closed one, ascending

    /// Winding number of the space round the shell, by all other shells.
    std::int32_t winding_around() const {
        std::int32_t sum = 0;
        for (const Enclosure& enclosure : enclosures) sum += enclosure.winding;
        return sum;
    }
    bool inside_out() const { return closed && volume6 < 0 && winding_around() <= 0; }
    bool cavity() const { return closed && volume6 < 0 && winding_around() > 0; }
    /// A double sheet, or a body too thin for the lattice.
    bool flat() const { return closed && volume6 == 0; }
    /// Space in it is enclosed by another shell already.
    bool nested_body() const { return closed && volume6 > 0 && winding_around() > 0; }
};

struct Shells {
    std::vector<std::uint32_t> of_face;  ///< no_index for facets that repeat a vertex
    std::vector<Shell> shells;
};

/// Equal points must have equal indices.
Shells find_shells(std::span<const exact::Point> points, std::span<const Triangle> triangles,
                   const EdgeTable& edges);

}  // namespace octavo::mesh
