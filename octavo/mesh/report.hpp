// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <octavo/mesh/mesh.hpp>

// What validate() says about a mesh. Not a yes or no: which facets, how many, and in words.

namespace octavo::mesh {

/// Kinds of problems; docs/methods/validate.md defines each. Those before `note` in this list keep a mesh from
/// being a solid.
enum class ProblemKind : std::uint8_t {
    empty,                     ///< there is no facet with area
    open_edges,                ///< edges with one facet
    inconsistent_orientation,  ///< edges with several facets, not as many one way as the other
    self_intersections,  ///< pairs of facets: an edge of one runs strictly through the interior of the other
    penetrations,        ///< pairs whose interiors cross, but only through edges and vertices
    overlaps,            ///< pairs in one plane with common area
    duplicate_facets,    ///< facets with the same vertices as an earlier one
    inside_out_shells,   ///< closed shells inside of which the winding number is negative
    flat_shells,         ///< closed shells that enclose no volume on the lattice
    // From here on: worth knowing, but a solid may have them.
    non_manifold_edges,     ///< edges with more than two facets
    non_manifold_vertices,  ///< vertices at which surfaces only touch
    zero_area_facets,       ///< facets whose corners are collinear or equal
    touching_facets,        ///< pairs that meet in points or segments without sharing them by index
    snapped_facets,         ///< facets that lose their area when snapped to the lattice
    unused_vertices,        ///< vertices of no facet
};

/// "open_edges" and so on: the name in JSON and in other languages.
std::string_view name_of(ProblemKind kind);

/// Does one such problem mean that the mesh bounds no solid?
constexpr bool is_error(ProblemKind kind) { return kind < ProblemKind::non_manifold_edges; }

struct Problem {
    ProblemKind kind = ProblemKind::empty;
    std::uint64_t count = 0;  ///< of edges, vertices, facets, pairs or shells, as the kind says
    std::vector<FaceIndex>
        faces;             ///< facets concerned, ascending, each once; at most ValidateOptions::most_faces
    std::string sentence;  ///< for people: "12 edges have only one facet"
};

struct Report {
    /// Errors first, in the order of ProblemKind; no kind twice.
    std::vector<Problem> problems;

    // After merging vertices at equal positions:
    bool closed = false;    ///< every edge has exactly two facets
    bool oriented = false;  ///< facets run along every edge that is not open equally often both ways
    bool manifold = false;  ///< closed, and every vertex has one fan of facets
    bool solid = false;     ///< there are no errors: the mesh bounds a solid

    bool closed_as_stored = false;  ///< closed without merging anything

    std::uint64_t vertices = 0;         ///< as stored
    std::uint64_t merged_vertices = 0;  ///< of different positions
    std::uint64_t facets = 0;
    std::uint32_t components = 0;         ///< joined by shared vertices, as stored
    std::uint32_t merged_components = 0;  ///< after merging
    std::uint32_t shells = 0;             ///< joined by shared edges, after merging
    std::uint32_t cavities = 0;           ///< closed shells that look inwards, rightly
    std::uint32_t nested_bodies =
        0;  ///< closed shells inside others, both outwards: legal, but they wind twice
    double largest_displacement = 0;  ///< how far the lattice moves a vertex at most, in units of the file

    /// The number of problems of the kind; 0 when there is none.
    std::uint64_t count(ProblemKind kind) const {
        for (const Problem& problem : problems)
            if (problem.kind == kind) return problem.count;
        return 0;
    }

    /// A few sentences: the verdict, then a line a problem.
    std::string describe() const;
};

}  // namespace octavo::mesh
