// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/base/check.hpp>
#include <octavo/mesh/rings.hpp>
#include <octavo/mesh/triangulate.hpp>

namespace octavo::mesh {
namespace {

/// Corners of the face in contours, the outer one first.
struct Contours {
    std::vector<VertexIndex> corners;
    std::vector<std::uint32_t> begin{0};

    void add(Ring ring) {
        for (std::uint32_t i = 0; i < ring.count; ++i) corners.push_back(ring[i]);
        begin.push_back(static_cast<std::uint32_t>(corners.size()));
    }
};

std::span<const Triangle> cover(Triangulator& triangulator, const Mesh& mesh, Ring outer,
                                std::span<const Ring> holes) {
    Contours contours;
    contours.add(outer);
    for (const Ring& hole : holes) contours.add(hole);
    const Triangulation face = triangulator(mesh.vertices, contours.corners, contours.begin);
    OCTAVO_CHECK(face.shape == PolygonShape::simple, "the outlines of a generated solid cross or touch");
    return face.triangles;
}

}  // namespace

Ring RingBuilder::add_ring(const Outline& outline, double z) {
    const Ring ring{static_cast<VertexIndex>(mesh_.vertices.size()),
                    static_cast<std::uint32_t>(outline.size())};
    for (const Point2D& p : outline) mesh_.vertices.push_back({p.x, p.y, z});
    return ring;
}

VertexIndex RingBuilder::add_vertex(Vec3 position) {
    mesh_.vertices.push_back(position);
    return static_cast<VertexIndex>(mesh_.vertices.size() - 1);
}

void RingBuilder::add_wall(Ring from, Ring to) {
    OCTAVO_CHECK(from.count == to.count, "a wall joins rings of equal count");
    for (std::uint32_t i = 0; i < from.count; ++i) {
        add_triangle(from[i], from[i + 1], to[i + 1]);
        add_triangle(from[i], to[i + 1], to[i]);
    }
}

void RingBuilder::add_fan(Ring from, VertexIndex apex) {
    for (std::uint32_t i = 0; i < from.count; ++i) add_triangle(from[i], from[i + 1], apex);
}

void RingBuilder::add_ceiling(Ring outer, std::span<const Ring> holes) {
    Triangulator triangulator;
    for (const Triangle& t : cover(triangulator, mesh_, outer, holes)) add_triangle(t[0], t[1], t[2]);
}

void RingBuilder::add_floor(Ring outer, std::span<const Ring> holes) {
    Triangulator triangulator;
    for (const Triangle& t : cover(triangulator, mesh_, outer, holes)) add_triangle(t[0], t[2], t[1]);
}

void RingBuilder::add_triangle(VertexIndex a, VertexIndex b, VertexIndex c) {
    mesh_.triangles.push_back({a, b, c});
}

}  // namespace octavo::mesh
