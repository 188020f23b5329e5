// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/boolean/soup.hpp>

// Triangles of a plane and how they hang together: what a Subdivision knows without asking where its vertices are.
//
// Vertices are numbers from 0 on. A vertex goes into a triangle or onto an edge, or an edge between two triangles turns
// into the other diagonal of both; the caller makes sure that this leaves every triangle turned the same way.
//
// Invariants: neighbours name each other; every vertex that is connected names a triangle that has it; both triangles
// at an edge have the same owner for it. Parts of a split edge keep its owner, new edges have none.

namespace octavo::boolean {

class Triangulation {
  public:
    using VertexId = std::uint32_t;
    using TriangleId = std::uint32_t;

    struct Triangle {
        VertexId v[3];
        TriangleId neighbour[3];  ///< across the edge from v[k] to v[k + 1]; no_index outside
        std::uint32_t owner[3];   ///< of that edge, as the caller numbers them; 0: it has none
    };
    /// Edge k of a triangle; no_index where there is none.
    struct Edge {
        TriangleId triangle;
        int k;
    };

    /// Starts with the triangle (0, 1, 2), or with the quadrilateral (0, 1, 2, 3) cut along (0, 2).
    void begin(std::size_t corners);

    std::size_t size() const { return triangles_.size(); }
    std::span<const Triangle> triangles() const { return triangles_; }
    const Triangle& operator[](TriangleId triangle) const { return triangles_[triangle]; }

    /// Connects the vertex to the corners of a triangle.
    void split_triangle(TriangleId triangle, VertexId vertex);
    /// Puts the vertex onto edge k of a triangle.
    void split_edge(Edge edge, VertexId vertex);
    /// Replaces an edge with a triangle on either side by the other diagonal of the two.
    void flip(Edge edge);
    void set_owner(Edge edge, std::uint32_t owner);

    VertexId from(Edge edge) const { return triangles_[edge.triangle].v[edge.k]; }
    VertexId to(Edge edge) const { return triangles_[edge.triangle].v[(edge.k + 1) % 3]; }
    VertexId apex(Edge edge) const { return triangles_[edge.triangle].v[(edge.k + 2) % 3]; }
    std::uint32_t owner(Edge edge) const { return triangles_[edge.triangle].owner[edge.k]; }
    /// The same edge seen from the other side; its triangle is no_index outside.
    Edge across(Edge edge) const {
        const TriangleId other = triangles_[edge.triangle].neighbour[edge.k];
        return {other, other == no_index ? 0 : back_index(other, edge.triangle)};
    }
    int index_in(TriangleId triangle, VertexId vertex) const {
        const Triangle& t = triangles_[triangle];
        return t.v[0] == vertex ? 0 : t.v[1] == vertex ? 1 : 2;
    }

    /// Calls visit(triangle, k) for the triangles that have `vertex` as corner k until it returns true.
    template <class Visit>
    bool any_around(VertexId vertex, const Visit& visit) const {
        const TriangleId start = triangle_at_[vertex];
        TriangleId at = start;
        do {  // counter-clockwise: out through the edge that ends at the vertex
            const int k = index_in(at, vertex);
            if (visit(at, k)) return true;
            at = triangles_[at].neighbour[(k + 2) % 3];
        } while (at != no_index && at != start);
        if (at == start) return false;
        for (at = triangles_[start].neighbour[index_in(start, vertex)]; at != no_index;) {
            const int k = index_in(at, vertex);
            if (visit(at, k)) return true;
            at = triangles_[at].neighbour[k];
        }
        return false;
    }

    /// The edge, seen from the triangle that has it as from → to, or else from the other one.
    Edge find_edge(VertexId from, VertexId to) const;

  private:
    int back_index(TriangleId triangle, TriangleId neighbour) const {
        const Triangle& t = triangles_[triangle];
        return t.neighbour[0] == neighbour ? 0 : t.neighbour[1] == neighbour ? 1 : 2;
    }
    void relink(TriangleId triangle, TriangleId before, TriangleId now) {
        if (triangle != no_index) triangles_[triangle].neighbour[back_index(triangle, before)] = now;
    }
    void connect(VertexId vertex, TriangleId triangle) {
        if (vertex >= triangle_at_.size()) triangle_at_.resize(vertex + 1, no_index);
        triangle_at_[vertex] = triangle;
    }

    std::vector<Triangle> triangles_;
    std::vector<TriangleId> triangle_at_;  ///< per vertex, one that has it as a corner
};

}  // namespace octavo::boolean
