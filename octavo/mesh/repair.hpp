// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/mesh/mesh.hpp>

// Mends what can be mended without guessing, and says what it did.
//
// No vertex moves, no hole is filled and nothing is cut: the surface stays the same set of points, but for walls and
// flaps of no thickness. What is closed stays closed. In this order:
//
//  1. Vertices at bit-equal positions become one; facets that then name a vertex twice are dropped.
//  2. Of facets with the same corners, pairs that face each other cancel, and of those that face the same way one
//     stays, unless edges need the others: two bodies may share a facet (drop_repeated.cpp). A last pair back to back
//     goes where other facets go on at every edge of the wall's rim (a wall inside) or at some (a flap, the commonest
//     defect of parts for printing) and stay closed without it; sheets that are double-sided as a whole stay, as no one
//     knows what they mean.
//  3. A facet without area is a vertex on the long side of its neighbour: the side is flipped, which splits the
//     neighbour at the vertex and opens nothing. Where that side has no or several neighbours the facet stays.
//  4. Facets are turned so that neighbours agree, as few as possible; surfaces with one side only stay.
//  5. Shells and parts of them that are inside out are turned, together with what is in them: where winding numbers
//     were negative they become positive, elsewhere they stay (turn_shells.cpp).
//  6. If that has turned anything, 2 to 5 once more: what faces each other now may cancel.
//  7. Edges with four facets and more are separated into pairs, if their facets alternate round the edge: then it is
//     certain which bound the same solid. Surfaces that touch in a vertex get one each. Both repeat positions.
//  8. Vertices that no facet uses are dropped.
//
// Invariant: repair(repair(x)) is repair(x). A solid without negative winding numbers and repeated facets stays the
// same solid.

namespace octavo::mesh {

enum class RepairKind : std::uint8_t {
    merged_vertices,
    dropped_collapsed_facets,  ///< they named a vertex twice
    dropped_duplicate_facets,
    dropped_inner_walls,  ///< facets that were back to back
    dropped_flaps,        ///< likewise, with a rim where no other facet is
    flipped_edges,        ///< at facets without area
    turned_facets,
    separated_edges,
    separated_vertices,
    turned_shells,
    dropped_vertices,
};

/// "merged_vertices" and so on.
std::string_view name_of(RepairKind kind);

struct RepairStep {
    RepairKind kind = RepairKind::merged_vertices;
    std::uint64_t count = 0;
    std::vector<FaceIndex>
        faces;  ///< facets of the input that were concerned, ascending; empty where vertices were
    std::string sentence;
};

struct RepairReport {
    std::vector<RepairStep> steps;  ///< those that did something, in order; empty when nothing was to be done

    std::uint64_t count(RepairKind kind) const {
        for (const RepairStep& step : steps)
            if (step.kind == kind) return step.count;
        return 0;
    }
    std::string describe() const;
};

struct Repaired {
    Mesh mesh;  ///< `sources` are those of the input, or {0, facet of the input}
    RepairReport report;
};

/// Errors: as validate(); cancelled.
Result<Repaired> repair(const Mesh& mesh, const Context& context = {});

}  // namespace octavo::mesh
