// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/hexmesh/quality.hpp>
#include <octavo/mesh/hex_mesh.hpp>
#include <octavo/mesh/mesh.hpp>

// Draws the boundary of a mesh, and the interfaces between its materials, onto the surfaces of the solids.
//
// Idea: a layer of cells between the steps of the mesh and the surface (buffer_layer.hpp); then rounds of small moves,
// each of which is taken back unless every cell that it changes stays good. A node on the boundary wants to be at the
// point nearest to the mean of its neighbours there, on the surface of the solids that separate its cells
// (separating_surface.hpp); a node a few layers inside wants to be in the middle of its neighbours. It moves there, or
// half the way, a quarter, an eighth. Hanging nodes follow their masters, so that constraints stay what they were.
// Where the surface turns by more than 30 degrees between a node and its neighbours, the node goes to the surface
// without smoothing, which would round edges off.
//
// Guaranteed: no cell gets a scaled Jacobian below `least_quality` (or below what it had, if that was less), and the
// map of every cell that was positive everywhere stays so: quality.hpp proves it for every move. Whatever the
// surface looks like, the mesh is valid.
// Not guaranteed: that every node reaches the surface, nor that sharp edges are met: nodes stay behind where a
// cell would get worse than allowed, and the report says how many and how far. Start from Keep::manifold with one of
// `layers`, whose steps are at most about half a cell off; without the layer of cells a third of the nodes stay behind.
// Cost: about 10 µs a round and boundary node. The same bytes for any number of threads.

namespace octavo::hexmesh {

/// Whether a layer of cells is laid between the mesh and the surface first (buffer_layer.hpp).
enum class BufferLayer : std::uint8_t { where_possible, none };

struct FitOptions {
    BufferLayer buffer_layer = BufferLayer::where_possible;
    int rounds = 8;  ///< more than ten change little
    int layers = 3;  ///< of nodes below the surface that may move
    double least_quality =
        0.2;  ///< scaled Jacobian; below 0.1 solvers suffer, above 0.3 nodes stay behind at edges
};

struct FitReport {
    bool has_buffer_layer = false;
    std::size_t boundary_nodes = 0;    ///< that were to be drawn to a surface
    std::size_t nodes_on_surface = 0;  ///< of these, closer than a millionth of the largest extent
    double mean_distance = 0, largest_distance = 0;  ///< of them to the surface, world units
    double mean_distance_before = 0, largest_distance_before = 0;
};

/// Moves nodes of the mesh of these solids: sets `mesh.positions`; with a layer the mesh has more cells and is no
/// octree any more. Empties `mesh.fractions`, which are no longer true. Open solids are closed as OpenPolicy::winding
/// does for meshing. Errors: bad_input for a mesh without direct constraints; those of query::ClosestQuery; limit as
/// check_size(); cancelled.
Result<FitReport> fit(mesh::HexMesh& mesh, std::span<const mesh::Mesh> solids, const FitOptions& options = {},
                      const Context& context = {});

}  // namespace octavo::hexmesh
