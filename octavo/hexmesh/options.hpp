// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/base/vec3.hpp>
#include <octavo/classic/closed_surface.hpp>
#include <octavo/mesh/hex_mesh.hpp>
#include <octavo/octree/balance.hpp>

// What a mesh of hexahedra should look like.
//
// All lengths are absolute, in world units. Cells have sides that are powers of two and lie on the grid of
// their multiples, whatever the size or shape of the solids: a length asked for is met by the largest such side that
// is not greater, and the same part meshed beside another one gets the same cells.

namespace octavo::hexmesh {

/// Lengths of one solid that differ from the general ones; 0 leaves the general one.
struct SolidSize {
    mesh::SolidIndex solid = 0;
    double surface = 0;   ///< cells on its surface are at most this large
    double interior = 0;  ///< cells inside are at most this large
};

/// Cells that meet the box and are part of the mesh are at most this large.
struct BoxSize {
    Box3 box = {};
    double size = 0;
};

/// Where the surface bends, cells are smaller.
struct CurvatureSize {
    double smallest = 0;        ///< down to this length; 0 switches it off
    double angle_degrees = 30;  ///< a cell whose facets' normals differ by more is split
};

/// Where two sheets of surface face away from each other inside one cell (thin walls and gaps), cells are smaller.
struct ProximitySize {
    double smallest = 0;  ///< down to this length; 0 switches it off
};

/// Which cells belong to the mesh.
enum class Keep : std::uint8_t {
    touched,  ///< those in a solid, and those that a surface passes through
    /// Those at least half filled: inside or outside is decided for each cell, and a cell on the boundary of several
    /// solids goes to those that fill half of it, or else to the one that fills most. What fitting starts from.
    half,
    /// As `half`, and cells are added or left out where the boundary would touch itself or fold, and larger cells are
    /// split where smaller ones would cover a part of their side: what a layer of cells can be laid on
    /// (buffer_layer.hpp).
    manifold,
    all,  ///< those outside too
};

/// The part of each boundary cell that lies in a solid.
enum class Fractions : std::uint8_t { compute, skip };

/// Places where a solid overlaps itself: the winding number is greater than 1, or negative (inside out).
enum class OverlapPolicy : std::uint8_t {
    reject,  ///< name facets and stop: a union of the solid with nothing resolves it
    /// Inside means winding number > 0. Exact volumes and the fractions of boundary cells count what is covered twice
    /// twice; cells inside count once, so that a filled volume differs from the exact one.
    winding,
};

struct Options {
    double precision = 0;  ///< cells on a surface are at most this large; 0 asks for `level`
    int level = 7;  ///< used when precision is 0: cells on surfaces are about 1/2^level of the largest extent
    double largest = 0;  ///< no cell of the mesh is larger; 0 is no limit
    std::vector<SolidSize> solids = {};
    std::vector<BoxSize> boxes = {};
    CurvatureSize curvature = {};
    ProximitySize proximity = {};
    /// Cells that touch a boundary cell are no larger than it, and those that touch these, so many times. One layer
    /// keeps larger cells off the boundary under Keep::half and Keep::manifold.
    int layers = 0;
    /// A surface in the walls between cells asks for its size as well as one that passes through them (walls.hpp).
    /// Without that a box on the grid has as few cells as there can be.
    bool refine_at_walls = true;
    octree::Contact balance = octree::Contact::edge;
    Keep keep = Keep::touched;
    /// Rounds of splitting larger cells under Keep::manifold; a few are usual, and Report::cut_off_cells says when they
    /// were not enough.
    int splitting_rounds = 16;
    Fractions fractions = Fractions::compute;
    classic::OpenPolicy open = classic::OpenPolicy::reject;
    OverlapPolicy overlaps = OverlapPolicy::reject;
    /// An octree with more cells is refused, whether they belong to the mesh or not: 6.5 GB, at 65 bytes a cell.
    std::uint64_t max_cells = 100'000'000;
};

}  // namespace octavo::hexmesh
