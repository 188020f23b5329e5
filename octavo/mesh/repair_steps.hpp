// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <octavo/mesh/mesh.hpp>

// The single steps of repair(); each takes a soup apart from all others and is tested on its own. They work on
// triangles whose `origin` says which facet of the input each was.

namespace octavo::mesh {

struct RepairSoup {
    std::vector<Vec3> vertices;
    std::vector<exact::Point> points;  ///< the vertices on the lattice
    std::vector<Triangle> triangles;
    std::vector<FaceIndex> origin;

    /// Keeps the triangles that are marked.
    void keep_only(const std::vector<bool>& kept);
};

/// What a step did to which facets of the input.
struct RepairDone {
    std::uint64_t count = 0;
    std::vector<FaceIndex> faces;
};

RepairDone drop_collapsed_facets(RepairSoup& soup);
RepairDone drop_duplicate_facets(RepairSoup& soup);
/// Drops facets back to back, of walls inside and of flaps, which `flaps` gets.
RepairDone drop_walls(RepairSoup& soup, RepairDone& flaps);
RepairDone flip_needles(RepairSoup& soup);
/// Turns facets until neighbours agree. `mixed` gets true for facets of surfaces in which some were turned.
RepairDone orient_neighbours(RepairSoup& soup, std::vector<bool>& mixed);
RepairDone separate_edges(RepairSoup& soup, RepairDone& vertices);
RepairDone turn_shells(RepairSoup& soup, const std::vector<bool>& mixed);

}  // namespace octavo::mesh
