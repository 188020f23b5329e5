// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octavo/exact/lattice.hpp>
#include <octavo/octree/morton.hpp>

// A mesh of cubes from an octree: cells, nodes, constraints of hanging nodes, and which solids each cell belongs to.
//
// Corners of a cell and octants have one order: bit 0 of the number is the high side of x, bit 1 of y, bit 2 of z.
// (VTK's hexahedron and Abaqus' C3D8 run round the bottom and then round the top: 0 1 3 2 4 5 7 6.)
//
// A node *hangs* when it lies inside an edge or a face of a larger cell. A field that is linear along edges is
// continuous only if the value of such a node is the mean of that edge's 2 or that face's 4 corners, its masters.
// Under balance by edge or corner no master hangs itself.
//
// A mesh may leave the grid: nodes drawn to the surface keep cells and lattice points and get `positions`; a conforming
// mesh, whose cells are no octants, has positions only.

namespace octavo::mesh {

using NodeIndex = std::uint32_t;
using CellIndex = std::uint32_t;
using SolidIndex = std::uint32_t;

/// A node inside an edge of a larger cell, and the ends of that edge.
struct EdgeHangingNode {
    NodeIndex node;
    std::array<NodeIndex, 2> masters;
    friend bool operator==(const EdgeHangingNode&, const EdgeHangingNode&) = default;
};

/// A node in the middle of a face of a larger cell, and the corners of that face.
struct FaceHangingNode {
    NodeIndex node;
    std::array<NodeIndex, 4> masters;
    friend bool operator==(const FaceHangingNode&, const FaceHangingNode&) = default;
};

/// Where a cell lies with respect to the solids; ascending indices.
struct SolidSet {
    std::vector<SolidIndex> inside;    ///< the whole cell lies in these
    std::vector<SolidIndex> boundary;  ///< the surface of these passes through the cell
    friend bool operator==(const SolidSet&, const SolidSet&) = default;
};

struct HexMesh {
    exact::Lattice lattice;
    std::vector<octree::CellKey> cells;             ///< sorted in Morton order; empty for a conforming mesh
    std::vector<std::array<NodeIndex, 8>> corners;  ///< per cell
    std::vector<exact::Point> nodes;                ///< on the lattice; coordinates go up to 2^26
    std::vector<Vec3> positions;  ///< per node, where they are not those of the lattice; or empty
    std::vector<EdgeHangingNode> edge_hanging;  ///< each node at most once in both lists
    std::vector<FaceHangingNode> face_hanging;
    /// True when no master hangs itself, so that the constraints can be used as they are: balanced by edge or corner.
    bool constraints_are_direct = true;

    std::vector<SolidSet> sets;              ///< all that occur, without repetition
    std::vector<std::uint16_t> set_of_cell;  ///< per cell, index into `sets`

    /// For each cell and each solid of its set's `boundary`, in the order of the cells, the part of the cell's volume
    /// that lies in the solid. Empty when nobody asked.
    std::vector<double> fractions;

    const SolidSet& set_of(CellIndex cell) const { return sets[set_of_cell[cell]]; }
    Vec3 position(NodeIndex node) const {
        return positions.empty() ? lattice.to_world(nodes[node]) : positions[node];
    }
    std::size_t cell_count() const { return corners.size(); }
    std::size_t node_count() const { return positions.empty() ? nodes.size() : positions.size(); }
    bool is_octree() const { return cells.size() == corners.size(); }
    /// Number of nodes that hang.
    std::size_t hanging_nodes() const { return edge_hanging.size() + face_hanging.size(); }
};

}  // namespace octavo::mesh
