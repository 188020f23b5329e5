// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include <octavo/hexmesh/pieces.hpp>
#include <octavo/mesh/disjoint_sets.hpp>

namespace octavo::hexmesh {

std::uint64_t count_pieces(const mesh::HexMesh& mesh) {
    mesh::DisjointSets nodes(mesh.node_count());
    for (const std::array<mesh::NodeIndex, 8>& cell : mesh.corners)
        for (std::size_t i = 1; i < 8; ++i) nodes.unite(cell[0], cell[i]);
    for (const mesh::EdgeHangingNode& hanging : mesh.edge_hanging)
        for (const mesh::NodeIndex master : hanging.masters) nodes.unite(hanging.node, master);
    for (const mesh::FaceHangingNode& hanging : mesh.face_hanging)
        for (const mesh::NodeIndex master : hanging.masters) nodes.unite(hanging.node, master);
    std::vector<bool> seen(mesh.node_count(), false);
    std::uint64_t pieces = 0;
    for (const std::array<mesh::NodeIndex, 8>& cell : mesh.corners) {
        const std::uint32_t piece = nodes.find(cell[0]);
        pieces += !seen[piece];
        seen[piece] = true;
    }
    return pieces;
}

}  // namespace octavo::hexmesh
