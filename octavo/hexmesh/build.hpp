// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/hexmesh/half_filled.hpp>
#include <octavo/hexmesh/options.hpp>
#include <octavo/mesh/hex_mesh.hpp>
#include <octavo/mesh/mesh.hpp>

// Solids → a balanced mesh of hexahedra with constraints, ready for a solver.
//
// Refine (one descent of all solids), balance 2:1, drop the cells outside, number the nodes. A refinement that
// balancing had to continue through boundary cells is classified once more; with one size for all surfaces it never is.
//
// Guaranteed: cells inside and fraction-weighted boundary cells add up to the exact volume of each snapped solid, to
// about 1e-12 relative (tested to 1e-9); the same bytes for any number of threads.

namespace octavo::hexmesh {

/// How one solid fills the mesh, in world units. The `filled_volume` of a solid that does not overlap itself equals
/// `exact_volume` but for rounding.
struct SolidReport {
    std::uint64_t inside_cells = 0, boundary_cells = 0;
    double inside_volume = 0;    ///< of the cells inside
    double boundary_volume = 0;  ///< of the whole boundary cells
    double filled_volume =
        0;                    ///< inside + fraction-weighted boundary cells; only when fractions are computed
    double exact_volume = 0;  ///< of the snapped triangles, by the divergence theorem in integers
    double largest_displacement = 0;  ///< that snapping to the lattice moved a vertex
    std::vector<std::uint32_t>
        open_facets;  ///< facets at holes that were closed; only under OpenPolicy::winding
};

struct Report {
    std::uint64_t tree_cells = 0;      ///< of the balanced octree, those outside included
    std::uint64_t inside_cells = 0;    ///< of the mesh: in some solid, and no surface passes
    std::uint64_t boundary_cells = 0;  ///< of the mesh: a surface passes
    std::array<std::uint64_t, octree::max_level + 1> cells_of_level{};  ///< of the mesh
    double smallest_cell = 0, largest_cell = 0;                         ///< sides, in world units
    std::vector<SolidReport> solids;
    HalfFilled half_filled;  ///< cells that Keep::manifold added and left out
    /// Cells that Keep::manifold would have split in the next of Options::splitting_rounds; they make a layer of cells
    /// impossible (buffer_layer.hpp).
    std::uint64_t cut_off_cells = 0;
    bool overlaps = false;  ///< a solid overlaps itself; only under OverlapPolicy::winding
    std::vector<std::size_t>
        missed_boxes;  ///< of Options::boxes, those that no solid reaches; not under Keep::all
};

struct Built {
    mesh::HexMesh mesh;
    Report report;
};

/// Meshes the solids, which may overlap, touch or lie in each other.
/// Errors: bad_input (indices, coordinates, options; no cell belongs to the mesh); not_a_solid (open, overlapping
/// itself or inside out, under the rejecting policies) with facets of the solid `Place::file` "solid N" when there are
/// several; limit; cancelled.
Result<Built> build(std::span<const mesh::Mesh> solids, const Options& options = {},
                    const Context& context = {});

/// The error of a mesh without cells: a solid is inside out (not_a_solid), or too small for the cells (bad_input).
Error empty_error(std::span<const SolidReport> solids);

}  // namespace octavo::hexmesh
