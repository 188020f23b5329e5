// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/bp_octree/plane.hpp>
#include <octavo/bp_octree/support.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/octree/df_code.hpp>

// A solid as nested convex envelopes: an octree whose split and gray nodes carry bounding planes.
//
// The envelope of a node is  E(node) = E(parent) ∩ cell(node) ∩ planes of the node,  with E = everything above the
// root. Every plane of a node has all of solid ∩ cell on its inner side (proved on the lattice when it was made,
// see support.hpp), hence so has the envelope, by induction, and an envelope lies within its parent's: volumes
// shrink from level to level, whatever planes were chosen. The thesis bounds each node on its own, and its volumes
// can grow (its table 4.3, model Angelo). Source: F. J. Melero, BP-Octree, doctoral thesis, Granada 2008.
//
// Level L of the tree is the union of the envelopes of its nodes on level L and of the leaves above, the black
// cells whole. White cells hold nothing.
//
// Layout: nodes breadth-first, Morton order within a level; the children of a split node are eight in a row.

namespace octavo::bp_octree {

using NodeIndex = std::uint32_t;

/// What is known of one level; volumes are of the union up to this level, in world units.
struct LevelFigures {
    std::uint64_t split = 0, gray = 0, white = 0, black = 0;  ///< nodes on this level
    std::uint64_t planes = 0;                                 ///< bounding planes of nodes on this level
    double volume = 0;
    friend bool operator==(const LevelFigures&, const LevelFigures&) = default;
};

struct BpOctree {
    mesh::LatticeMesh mesh;  ///< points without repetition
    Frame frame;
    /// False when the facets do not close: then there are no black cells and only the surface is enveloped.
    bool is_solid = true;
    double solid_volume = 0;  ///< signed volume of the facets in world units; 0 when they do not close

    std::vector<octree::Node> nodes;
    std::vector<NodeIndex> level_begin;      ///< first node of each level, and one past the last
    std::vector<std::uint32_t> link;         ///< per node; split: its first child; gray: its number as a leaf
    std::vector<std::uint32_t> plane_begin;  ///< per node, and one past the last
    std::vector<BoundingPlane> planes;
    std::vector<std::uint32_t> leaf_begin;  ///< per gray leaf, and one past the last: into leaf_triangles
    std::vector<mesh::FaceIndex> leaf_triangles;  ///< all facets that meet the closed cell, ascending
    /// Per gray leaf: the winding number at the low corner of its cell, moved as in crossing.hpp. That and the leaf's
    /// triangles tell what is inside everywhere in the cell.
    std::vector<std::int32_t> leaf_winding;
    std::vector<LevelFigures> levels;

    /// Levels 0 to deepest() have nodes.
    int deepest() const { return static_cast<int>(levels.size()) - 1; }
    std::span<const BoundingPlane> planes_of(NodeIndex node) const {
        return {planes.data() + plane_begin[node], plane_begin[node + 1] - plane_begin[node]};
    }
    std::span<const mesh::FaceIndex> triangles_of(NodeIndex gray) const {
        const std::uint32_t leaf = link[gray];
        return {leaf_triangles.data() + leaf_begin[leaf], leaf_begin[leaf + 1] - leaf_begin[leaf]};
    }
    std::size_t leaf_count() const { return leaf_begin.size() - 1; }
};

}  // namespace octavo::bp_octree
