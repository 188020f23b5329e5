// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <octavo/mesh/mesh.hpp>
#include <octavo/mesh/topology.hpp>

// The single steps of repair(); each takes a soup apart from all others and is tested on its own. They work on
// triangles whose `origin` says which facet of the input each was.
//
// Invariant of all steps: an edge that is run along equally often both ways stays so. What is closed stays closed.

namespace octavo::mesh {

/// What a step did to which facets of the input.
struct RepairDone {
    std::uint64_t count = 0;
    std::vector<FaceIndex> faces;

    void add(const RepairDone& more) {
        count += more.count;
        faces.insert(faces.end(), more.faces.begin(), more.faces.end());
    }
};

struct RepairSoup {
    std::vector<Vec3> vertices;
    std::vector<exact::Point> points;  ///< the vertices on the lattice
    std::vector<Triangle> triangles;
    std::vector<FaceIndex> origin;

    EdgeTable edges() const { return build_edges(triangles, vertices.size()); }
    /// Drops the triangles that are marked.
    RepairDone drop(const std::vector<bool>& dropped);
};

RepairDone drop_collapsed_facets(RepairSoup& soup);
RepairDone drop_duplicate_facets(RepairSoup& soup);
/// Facets back to back that were dropped: of walls inside a solid, and of flaps on it.
struct DroppedWalls {
    RepairDone inner, flaps;
};
DroppedWalls drop_walls(RepairSoup& soup);
RepairDone flip_needles(RepairSoup& soup);
/// Turns facets until neighbours agree. `mixed` gets true for facets of surfaces in which some were turned.
RepairDone orient_neighbours(RepairSoup& soup, std::vector<bool>& mixed);
/// Turns closed shells, or parts of them, until no winding number is negative; counts shells.
RepairDone turn_shells(RepairSoup& soup, const std::vector<bool>& mixed);
RepairDone separate_edges(RepairSoup& soup, RepairDone& vertices);

}  // namespace octavo::mesh
