// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

#include <octavo/mesh/mesh.hpp>
#include <octavo/mesh/shapes.hpp>

// Building blocks of the generated solids: rings of vertices, walls between rings, plane caps with holes. A
// solid made of them is closed when each ring is used once from either side.

namespace octavo::mesh {

/// Consecutive vertices that go round once.
struct Ring {
    VertexIndex first = 0;
    std::uint32_t count = 0;
    VertexIndex operator[](std::uint32_t i) const { return first + i % count; }
};

class RingBuilder {
  public:
    Ring add_ring(const Outline& outline, double z);
    VertexIndex add_vertex(Vec3 position);

    /// The wall between two rings of equal count. Facets look to the right of the walk along `from` with `to`
    /// above: outwards, when `from` runs counter-clockwise below `to`.
    void add_wall(Ring from, Ring to);

    /// Triangles from a ring to a point, looking as a wall to a ring above would.
    void add_fan(Ring from, VertexIndex apex);

    /// The plane face inside `outer` and outside `holes` that looks up, all rings counter-clockwise seen from
    /// above; `add_floor` looks down.
    void add_ceiling(Ring outer, std::span<const Ring> holes = {});
    void add_floor(Ring outer, std::span<const Ring> holes = {});

    void add_triangle(VertexIndex a, VertexIndex b, VertexIndex c);

    Mesh take() { return std::move(mesh_); }

  private:
    Mesh mesh_;
};

}  // namespace octavo::mesh
