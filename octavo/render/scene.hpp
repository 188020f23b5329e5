// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <span>
#include <vector>

#include <octavo/base/vec3.hpp>
#include <octavo/mesh/hex_mesh.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/octree/octree.hpp>
#include <octavo/render/camera.hpp>
#include <octavo/render/image.hpp>
#include <octavo/render/palette.hpp>

// What there is to draw: facets with a colour on either side, and lines. Made from a mesh or from an octree's cells.

namespace octavo::render {

struct Facet {
    std::array<Vec3, 3> corners;  ///< counter-clockwise seen from the front
    Color front = palette::solid;
    Color back = palette::inner;
    bool is_cap = false;  ///< where a solid was cut open: not lit
};

struct Line {
    Vec3 from, to;
    Color color = palette::ink;
};

struct Scene {
    std::vector<Facet> facets;
    std::vector<Line> lines;

    Box3 bounds() const;

    /// The corners of what is left of the facets and lines where position[cut_axis] <= cut_at: what a camera must see.
    std::vector<Vec3> corners(int cut_axis = 0, double cut_at = Box3::infinity) const;
};

/// Which edges of a mesh become lines.
enum class EdgeLines { none, sharp, all };

enum class MeshColors {
    solid,   ///< all facets alike
    source,  ///< by the operand that a facet came from
};

struct MeshSceneOptions {
    EdgeLines edges = EdgeLines::sharp;
    double sharp_degrees = 30;  ///< `sharp` edges turn by more than this, or have not exactly two facets
    MeshColors colors = MeshColors::solid;
};

/// Facets whose source is a cut (cut_open.hpp) are caps.
Scene scene_of(const mesh::Mesh& mesh, const MeshSceneOptions& options = {});

/// The edges between a facet that looks at the viewer and one that does not: where round things end.
std::vector<Line> contours_of(const mesh::Mesh& mesh, const Camera& camera);

struct OctreeSceneOptions {
    Box3 removed = {};                 ///< cells whose centre lies inside are left out
    EdgeLines edges = EdgeLines::all;  ///< `none` leaves out the cells' outlines
};

/// The walls of the black and gray leaves that a viewer can see: those towards a white leaf, a removed one or the
/// outside.
Scene scene_of(const octree::Octree& tree, const OctreeSceneOptions& options = {});

struct HexMeshSceneOptions {
    /// A number for each cell, shown from blue (the least) to red (the greatest); without them cells have the colours
    /// of their solids.
    std::span<const double> values = {};
    EdgeLines edges = EdgeLines::all;  ///< `none` leaves out the cells' outlines
};

/// The sides of cells on the boundary of a mesh of hexahedra.
Scene scene_of(const mesh::HexMesh& mesh, const HexMeshSceneOptions& options = {});

}  // namespace octavo::render
