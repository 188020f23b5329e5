// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/classic/facet.hpp>
#include <octavo/hexmesh/size_field.hpp>
#include <octavo/mesh/hex_mesh.hpp>
#include <octavo/octree/morton.hpp>

// The cells of several solids at once: one descent that carries, for each solid not yet left behind, the facets that
// touch the cell and the winding number of its low corner.
//
// The winding number of an octant follows from its parent's by steps that count crossings (classic/facet_lists.hpp), so
// every cell knows exactly which solids it lies in, which surfaces pass through it and how much of it each fills; an
// overlap or an interface of solids is simply a cell with two of them. This is the expansion of J. I. López and
// others (Modelización de sólidos mediante estructura octree, after Samet) from one reference point instead of from
// neighbour to neighbour: it cannot leak, and needs no neighbours.

namespace octavo::hexmesh {

/// Cells that fill the universe.
struct ClassifiedCells {
    std::vector<octree::CellKey> keys;  ///< sorted
    std::vector<mesh::SolidSet>
        sets;  ///< in the order in which they first occur; the first is empty: outside
    std::vector<std::uint16_t> set_of_cell;  ///< per cell
    std::vector<double> fractions;           ///< per cell and solid whose surface passes through it; or empty
    /// Facets round a place where a solid overlaps itself or is inside out, and that solid; empty when there is none.
    std::vector<std::uint32_t> overlap;
    mesh::SolidIndex overlapping_solid = 0;
};

struct SolidFacets {
    std::vector<classic::Facet> facets;
};

/// The error of an octree that has more cells than Options::max_cells.
Error too_many_cells(std::uint64_t max_cells);

/// Cells number their sets of solids with 16 bits: so many at most, or it is an error.
inline constexpr std::size_t most_sets = 0x10000;
Error too_many_sets();

/// Refines as the size field asks, and classifies. Errors: limit beyond 2^16 sets of solids, `options.max_cells` or
/// 2^31 − 2 cells; cancelled.
Result<ClassifiedCells> refine(std::span<const SolidFacets> solids, const SizeField& sizes,
                               const Options& options, const Context& context);

/// Classifies the cells `keys`, which fill the universe and are sorted.
Result<ClassifiedCells> classify(std::span<const SolidFacets> solids, std::span<const octree::CellKey> keys,
                                 const Options& options, const Context& context);

}  // namespace octavo::hexmesh
