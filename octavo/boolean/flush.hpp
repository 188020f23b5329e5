// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/boolean/soup.hpp>

// Faces that were meant to be flush become flush: what is nearer than a tolerance is joined, before anything is cut.
//
// Problem: parts that touch face to face no longer do once a rotation has been rounded; the exact result then keeps
// slabs, slits and slivers a lattice unit thick. Idea: work on the operands, not on the result. Vertices near each
// other become one; an edge that passes near vertices, or near another edge, is bent through them; a facet near
// vertices is bent to them; and facets that then lie on each other within the tolerance (a *sheet*) are subdivided
// together, seen along one axis, so that they consist of the same triangles. Equal triangles are one facet from then
// on, whose winding changes add up or cancel, exactly as if the parts had been flush all along. Rounds follow until
// nothing is near that does not touch.
//
// Why nothing can open, cross or turn over: every step is a subdivision, which all facets at an edge share, or moves a
// vertex for all facets that have it. Both keep the surface of every operand closed, so it is an operand like any
// other, and what is evaluated is exact, closed and manifold as ever. Where a surface closes by T-junctions, facets are
// split there before anything moves (t_junctions.hpp). No point of a surface moves by more than the
// tolerance a round, so winding numbers farther from all surfaces than the moves are what they were: the result
// differs only there, by a volume of at most displacement times area.
// A sheet that cannot be subdivided so (a folded one, one that is not plane within three tolerances) is left to its
// facets one by one: the surface stays closed and slivers remain. Where that goes on round after round, all is taken
// back and done again without those facets: what cannot be joined stays as it was.
//
// Not joined: what is near only to a line or point in which facets cut each other; where that leaves a thin shell,
// thin_shells.hpp takes it away.
//
// Cost: a search for pairs as that for contacts; the rest is linear in what is near.
// Source: the sheets are ours; joining by tolerance as in M. Segal, Using tolerances to guarantee valid polyhedral
// modeling results, 1990, whose tolerances grow where ours only move a lattice point.

namespace octavo::boolean {

struct FlushReport {
    double tolerance = 0;  ///< in world units
    std::size_t rounds = 0;
    std::size_t merged_vertices = 0;
    std::size_t bent_edges = 0;      ///< through vertices near them
    std::size_t bent_facets = 0;     ///< to vertices near their inside
    std::size_t added_vertices = 0;  ///< where edges pass each other
    std::size_t joined_facets = 0;   ///< subdivided together with others that they lie on
    std::size_t removed_facets =
        0;  ///< slivers that vanished, and triangles that became one with or cancelled another
    double largest_move = 0;         ///< of a point of a surface in one round, in world units
    std::size_t removed_shells = 0;  ///< of the result, thinner than the tolerance (thin_shells.hpp)
    std::size_t folded_facets = 0;   ///< could not be subdivided together in the last round
    std::size_t left_alone = 0;      ///< input facets that are near others but could not be joined to them
    bool settled = true;             ///< else nothing was joined
    std::vector<mesh::Source> first_removed;  ///< up to 8
};

/// Joins what is not farther apart than `tolerance`, in lattice units, which must be positive.
FlushReport make_flush(Soup& soup, double tolerance, const Context& context);

}  // namespace octavo::boolean
