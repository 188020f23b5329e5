// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/hexmesh/to_octree.hpp>

namespace octavo::hexmesh {
namespace {

using octree::CellKey;
using octree::Node;

class OctreeWriter {
  public:
    explicit OctreeWriter(const mesh::HexMesh& mesh) : mesh_(mesh) { write(CellKey::root()); }
    octree::DfCode take() { return std::move(code_); }

  private:
    void write(CellKey cell) {
        if (next_ == mesh_.cells.size() || cell.last_descendant() < mesh_.cells[next_])
            code_.append(Node::white);
        else if (mesh_.cells[next_] == cell)
            code_.append(color_of(static_cast<mesh::CellIndex>(next_++)));
        else {
            code_.append(Node::split);
            for (int octant = 0; octant < 8; ++octant) write(cell.child(octant));
        }
    }
    Node color_of(mesh::CellIndex cell) const {
        const mesh::SolidSet& set = mesh_.set_of(cell);
        return !set.boundary.empty() ? Node::gray : !set.inside.empty() ? Node::black : Node::white;
    }

    const mesh::HexMesh& mesh_;
    octree::DfCode code_;
    std::size_t next_ = 0;
};

}  // namespace

octree::Octree to_octree(const mesh::HexMesh& mesh) {
    OCTAVO_CHECK(mesh.is_octree(), "only a mesh of octants is an octree");
    int depth = 0;
    for (const CellKey cell : mesh.cells) depth = std::max(depth, cell.level());
    return {mesh.lattice, depth, OctreeWriter(mesh).take()};
}

}  // namespace octavo::hexmesh
