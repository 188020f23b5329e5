// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/classic/built.hpp>
#include <octavo/classic/closed_surface.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/octree/descent_options.hpp>

// Triangles → classic octree.
//
// Problem: colour the cells of a regular subdivision white (outside), black (inside) and gray (the surface passes),
// exactly, for any closed surface: nested, self-intersecting, touching itself. Idea: a mesh restricted to a cell is
// the list of facets that touch it *and the winding number of one reference point*, the cell's low corner displaced
// by an infinitely small (ε₁, ε₂, ε₃). The reference of an octant follows from its parent's by at most three
// axis-parallel steps inside the parent, counting crossings with the parent's own list. So an octant without facets
// knows its colour at once, exactly and in parallel; nothing is flooded, nothing can leak.
//
// A cell of the last level is gray when a facet meets its *interior*. A facet in a wall between two cells makes
// neither gray, so boxes aligned with cells have no gray cells at all. Inside means winding number > 0. Facets inside
// the solid, where shells overlap, are gray too: they are surface of the input, and this builder does not resolve
// overlaps.
//
// Guaranteed: volume of black leaves ≤ volume of the snapped solid ≤ black + gray, in exact integers.
// Cost: one overlap test a pair of facet and cell that meet, about 20 ns; memory: 64 bytes a facet, the lists of one
// path and the tree at two bits a node.
// Source: J. I. López and others, Modelización de sólidos mediante estructura octree, who expand the colours from seeds
// cell by cell; docs/decisions/0002-colours-by-descent.md says why we do not.

namespace octavo::classic {

struct BuildOptions {
    int depth = 8;  ///< the deepest level, 0 to 21: gray leaves have side 2^(26 − depth) lattice units
    OpenPolicy open = OpenPolicy::reject;
    std::uint64_t max_nodes = octree::DescentOptions::default_max_nodes;
};

/// The classic octree of a snapped mesh.
/// Errors: bad_input (indices, a depth out of range), not_a_solid (open, under OpenPolicy::reject; no facet has area),
/// limit (more than `max_nodes`), cancelled.
Result<Built> build(const mesh::LatticeMesh& mesh, const BuildOptions& options = {},
                    const Context& context = {});

/// The same of a mesh, snapped to the finest lattice that holds it. Errors: also those of snapping.
Result<Built> build(const mesh::Mesh& mesh, const BuildOptions& options = {}, const Context& context = {});

}  // namespace octavo::classic
