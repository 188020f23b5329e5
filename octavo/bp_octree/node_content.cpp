// SPDX-License-Identifier: Apache-2.0
#include <octavo/bp_octree/node_content.hpp>

namespace octavo::bp_octree {

void NodeContent::gather(const mesh::LatticeMesh& mesh, const CellBox& box,
                         std::span<const mesh::FaceIndex> triangles, std::uint8_t inside) {
    points_.clear();
    normals_.clear();
    if (seen_by_.size() != mesh.points.size() || ++cell_ == 0) {
        seen_by_.assign(mesh.points.size(), 0);
        cell_ = 1;
    }
    CellContent content(box, points_);
    for (const mesh::FaceIndex face : triangles) {
        const mesh::Triangle& t = mesh.triangles[face];
        bool all_within = true;
        for (const mesh::VertexIndex vertex : t) {
            if (!content.contains(mesh.points[vertex])) {
                all_within = false;
            } else if (seen_by_[vertex] != cell_) {
                seen_by_[vertex] = cell_;
                content.add_vertex(mesh.points[vertex]);
            }
        }
        const exact::Point p = mesh.points[t[0]], q = mesh.points[t[1]], r = mesh.points[t[2]];
        if (!all_within) content.add_cuts(p, q, r);
        const auto difference = [](exact::Point a, exact::Point b) {
            return Vec3{static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y),
                        static_cast<double>(b.z - a.z)};
        };
        const Vec3 n = cross(difference(p, q), difference(p, r));
        normals_.push_back({n.x * box.side(0), n.y * box.side(1), n.z * box.side(2)});
    }
    for (int corner = 0; corner < 8; ++corner)
        if (inside >> corner & 1) content.add_corner(corner);
}

}  // namespace octavo::bp_octree
