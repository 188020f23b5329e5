// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bp_octree/to_mesh.hpp>

namespace octavo::bp_octree {
namespace {

using octree::Cell;
using octree::Node;

class Drawing {
  public:
    Drawing(const BpOctree& tree, const ToMeshOptions& options, const Context& context)
        : tree_(tree), options_(options), context_(context) {}

    mesh::Mesh run() {
        Polytope cell;
        cell.make_cell();
        visit(0, Cell::root(), std::move(cell));
        return std::move(mesh_);
    }

  private:
    void visit(NodeIndex node, const Cell& cell, Polytope shape) {
        const Node kind = tree_.nodes[node];
        if (kind == Node::white || context_.cancelled()) return;
        // A black cell lies in the solid, so all of it lies within the envelopes above.
        for (const BoundingPlane& plane : tree_.planes_of(node))
            shape.clip(plane.half_space(), Polytope::cell_faces);
        if (kind != Node::split || cell.level >= options_.level) {
            add(node, cell, shape);
            return;
        }
        for (int i = 0; i < 8; ++i) {
            const NodeIndex child = tree_.link[node] + static_cast<unsigned>(i);
            Polytope part;
            if (tree_.nodes[child] == Node::black)
                part.make_cell();
            else
                part.assign_octant(shape, i);
            visit(child, cell.child(i), std::move(part));
        }
    }

    void add(NodeIndex node, const Cell& cell, const Polytope& shape) {
        const CellBox box = tree_.frame.box(cell);
        const exact::Lattice& lattice = tree_.mesh.lattice;
        const auto base = static_cast<mesh::VertexIndex>(mesh_.vertices.size());
        for (const Vec3& x : shape.vertices()) {
            Vec3 world;
            for (int axis = 0; axis < 3; ++axis) {
                const double place = 0.5 * (box.low[axis] + x[axis] / Polytope::cell_side * box.side(axis));
                world[axis] = (static_cast<double>(lattice.origin()[axis]) + place) * lattice.unit();
            }
            mesh_.vertices.push_back(world);
        }
        for (std::size_t face = 0; face < shape.face_count(); ++face) {
            if (!options_.cell_faces && shape.label(face) < Polytope::cell_faces) continue;
            const std::uint32_t* first = shape.begin(face);
            for (const std::uint32_t* p = first + 1; p + 1 < shape.end(face); ++p) {
                mesh_.triangles.push_back({base + *first, base + p[0], base + p[1]});
                mesh_.sources.push_back({0, node});
            }
        }
    }

    const BpOctree& tree_;
    const ToMeshOptions& options_;
    const Context& context_;
    mesh::Mesh mesh_;
};

}  // namespace

mesh::Mesh to_mesh(const BpOctree& tree, const ToMeshOptions& options, const Context& context) {
    return Drawing(tree, options, context).run();
}

mesh::Mesh exact_mesh(const BpOctree& tree) {
    mesh::Mesh mesh;
    mesh.vertices.reserve(tree.mesh.points.size());
    for (const exact::Point p : tree.mesh.points) mesh.vertices.push_back(tree.mesh.lattice.to_world(p));
    mesh.triangles = tree.mesh.triangles;
    return mesh;
}

}  // namespace octavo::bp_octree
