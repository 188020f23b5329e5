// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <octavo/base/vec3.hpp>

// Cells bounded by polygons, as finite-volume codes store them: faces with the cell on either side.

namespace octavo::mesh {

struct PolyhedralMesh {
    std::vector<Vec3> points;
    /// Corners of face f are face_points[face_begin[f] .. face_begin[f + 1]). The normal points out of the owner.
    std::vector<std::uint32_t> face_begin{0};
    std::vector<std::uint32_t> face_points;
    std::vector<std::uint32_t> owner;      ///< cell per face
    std::vector<std::uint32_t> neighbour;  ///< per inner face, greater than the owner; inner faces come first
    std::uint32_t cells = 0;

    struct Patch {
        std::string name;
        std::uint32_t first_face = 0, faces = 0;
    };
    std::vector<Patch> patches;  ///< of all boundary faces, in their order

    struct Zone {
        std::string name;
        std::vector<std::uint32_t> cells;
    };
    std::vector<Zone> zones;  ///< disjoint

    std::vector<int> cell_level;  ///< depth of refinement per cell; empty when they are no octants
};

}  // namespace octavo::mesh
