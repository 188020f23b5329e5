// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include <octavo/base/any_scale.hpp>
#include <octavo/render/cut_open.hpp>
#include <octavo/render/scene.hpp>

namespace octavo::render {
namespace {

struct EdgeUse {
    std::uint64_t ends;  // smaller vertex in the high half
    mesh::FaceIndex face;
};

std::vector<EdgeUse> edge_uses(const mesh::Mesh& mesh) {
    std::vector<EdgeUse> uses;
    uses.reserve(mesh.triangles.size() * 3);
    for (mesh::FaceIndex face = 0; face < mesh.triangles.size(); ++face)
        for (int side = 0; side < 3; ++side) {
            const std::uint64_t a = mesh.triangles[face][side], b = mesh.triangles[face][(side + 1) % 3];
            uses.push_back({a < b ? a << 32 | b : b << 32 | a, face});
        }
    std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
        return a.ends != b.ends ? a.ends < b.ends : a.face < b.face;
    });
    return uses;
}

/// Calls `visit(ends, faces)` for each edge, with the facets at it.
template <class Visit>
void for_each_edge(const std::vector<EdgeUse>& uses, const Visit& visit) {
    for (std::size_t begin = 0, end; begin < uses.size(); begin = end) {
        for (end = begin; end < uses.size() && uses[end].ends == uses[begin].ends;) ++end;
        visit(uses[begin].ends, std::span(uses).subspan(begin, end - begin));
    }
}

Line line_of(const mesh::Mesh& mesh, std::uint64_t ends) {
    return {mesh.vertices[ends >> 32], mesh.vertices[ends & 0xffffffffU]};
}

Facet facet_of(const mesh::Mesh& mesh, mesh::FaceIndex face, MeshColors colors) {
    const mesh::Triangle& t = mesh.triangles[face];
    Facet facet{{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]}};
    if (mesh.sources.empty()) return facet;
    const std::uint32_t operand = mesh.sources[face].operand;
    if (operand == cut_operand) {
        facet.front = facet.back = palette::inner;
        facet.is_cap = true;
    } else if (colors == MeshColors::source) {
        facet.front = palette::solids[operand % palette::solids.size()];
    }
    return facet;
}

Vec3 normal_of(const Facet& facet) {
    const Vec3 normal =
        cross_direction(facet.corners[1] - facet.corners[0], facet.corners[2] - facet.corners[0]);
    const double size = length(normal);
    return size > 0 ? 1 / size * normal : Vec3{};
}

}  // namespace

Box3 Scene::bounds() const {
    Box3 box;
    for (const Facet& facet : facets)
        for (const Vec3& corner : facet.corners) box.add(corner);
    for (const Line& line : lines) box.add(line.from), box.add(line.to);
    return box;
}

std::vector<Vec3> Scene::corners(int cut_axis, double cut_at) const {
    std::vector<Vec3> corners;
    // The start of a side, and where the side meets the cut.
    const auto add_side = [&](Vec3 from, Vec3 to) {
        const double a = from[cut_axis], b = to[cut_axis];
        if (a <= cut_at) corners.push_back(from);
        if ((a <= cut_at) != (b <= cut_at)) corners.push_back(from + (cut_at - a) / (b - a) * (to - from));
    };
    for (const Facet& facet : facets)
        for (std::size_t k = 0; k < 3; ++k) add_side(facet.corners[k], facet.corners[(k + 1) % 3]);
    for (const Line& line : lines) add_side(line.from, line.to), add_side(line.to, line.from);
    return corners;
}

Scene scene_of(const mesh::Mesh& mesh, const MeshSceneOptions& options) {
    Scene scene;
    scene.facets.reserve(mesh.triangles.size());
    for (mesh::FaceIndex face = 0; face < mesh.triangles.size(); ++face)
        scene.facets.push_back(facet_of(mesh, face, options.colors));
    if (options.edges == EdgeLines::none) return scene;

    const double least_cosine = std::cos(options.sharp_degrees * 3.14159265358979323846 / 180);
    for_each_edge(edge_uses(mesh), [&](std::uint64_t ends, std::span<const EdgeUse> uses) {
        const bool is_smooth = uses.size() == 2 && dot(normal_of(scene.facets[uses[0].face]),
                                                       normal_of(scene.facets[uses[1].face])) >= least_cosine;
        if (!is_smooth || options.edges == EdgeLines::all) scene.lines.push_back(line_of(mesh, ends));
    });
    return scene;
}

std::vector<Line> contours_of(const mesh::Mesh& mesh, const Camera& camera) {
    std::vector<char> is_front;
    for (const mesh::Triangle& t : mesh.triangles) {
        const Vec3 a = camera.project(mesh.vertices[t[0]]), b = camera.project(mesh.vertices[t[1]]),
                   c = camera.project(mesh.vertices[t[2]]);
        is_front.push_back((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y) < 0);
    }
    std::vector<Line> contours;
    for_each_edge(edge_uses(mesh), [&](std::uint64_t ends, std::span<const EdgeUse> uses) {
        if (uses.size() == 2 && is_front[uses[0].face] != is_front[uses[1].face])
            contours.push_back(line_of(mesh, ends));
    });
    return contours;
}

}  // namespace octavo::render
