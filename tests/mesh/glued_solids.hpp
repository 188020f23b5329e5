// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <vector>

#include <octavo/mesh/mesh.hpp>

// Random meshes that are wrong in every way at once, on a small grid so that most of them touch, coincide and share
// facets; and slow answers about them.

namespace octavo::tests {

class GluedSolids {
  public:
    explicit GluedSolids(unsigned seed) : random_(seed) {}

    mesh::Mesh next() {
        mesh_ = {};
        const int kind = below(4), parts = 1 + below(5);
        grid_ = 1 + below(4);
        for (int i = 0; i < parts; ++i)
            kind == 0 ? add_tetrahedron() : kind == 1 ? add_nested_box(i) : add_box();
        if (below(3) == 0) double_facets();
        if (below(3) == 0) add_flap();
        if (below(4) == 0) turn_some();
        if (below(6) == 0) drop_some();
        if (below(4) == 0) add_needle();
        if (below(4) == 0) std::shuffle(mesh_.triangles.begin(), mesh_.triangles.end(), random_);
        return mesh_;
    }

    int below(int bound) { return static_cast<int>(random_() % static_cast<unsigned>(bound)); }
    /// A place that lies on no grid plane and on none through few grid points.
    Vec3 place() {
        const auto coordinate = [&] {
            return -0.5 + 6 * std::ldexp(static_cast<double>(random_() % 1048573), -20);
        };
        return {coordinate(), coordinate() + 1e-3, coordinate() - 2e-3};
    }

  private:
    using VertexIndex = mesh::VertexIndex;

    VertexIndex add(Vec3 position) {
        mesh_.vertices.push_back(position);
        return static_cast<VertexIndex>(mesh_.vertices.size() - 1);
    }

    /// With its diagonals at random, and inside out once in three.
    void add_box_between(std::array<int, 3> low, std::array<int, 3> high) {
        const auto first = static_cast<VertexIndex>(mesh_.vertices.size());
        for (int i = 0; i < 8; ++i)
            add({static_cast<double>(i & 1 ? high[0] : low[0]), static_cast<double>(i & 2 ? high[1] : low[1]),
                 static_cast<double>(i & 4 ? high[2] : low[2])});
        constexpr std::array<std::array<VertexIndex, 4>, 6> sides{
            {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
        const bool is_inside_out = below(3) == 0;
        for (std::array<VertexIndex, 4> side : sides) {
            for (VertexIndex& v : side) v += first;
            if (is_inside_out) std::reverse(side.begin(), side.end());
            const auto [a, b, c, d] = side;
            if (below(2) == 0)
                mesh_.triangles.insert(mesh_.triangles.end(), {{a, b, c}, {a, c, d}});
            else
                mesh_.triangles.insert(mesh_.triangles.end(), {{a, b, d}, {b, c, d}});
        }
    }
    void add_box() {
        std::array<int, 3> low{}, high{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = below(grid_);
            high[axis] = low[axis] + 1 + below(grid_ - low[axis]);
        }
        add_box_between(low, high);
    }
    void add_nested_box(int depth) {
        add_box_between({depth, depth, depth}, {12 - depth, 12 - depth, 12 - depth});
    }

    void add_tetrahedron() {
        const auto first = static_cast<VertexIndex>(mesh_.vertices.size());
        for (int i = 0; i < 4; ++i)
            add({static_cast<double>(below(grid_ + 1)), static_cast<double>(below(grid_ + 1)),
                 static_cast<double>(below(grid_ + 1))});
        for (const mesh::Triangle& t : {mesh::Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
            mesh_.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }

    mesh::Triangle& any_triangle() {
        return mesh_.triangles[static_cast<std::size_t>(below(static_cast<int>(mesh_.triangles.size())))];
    }
    void double_facets() {
        for (int i = below(4); i >= 0; --i) {
            mesh::Triangle t = any_triangle();
            if (below(3) == 0) std::swap(t[0], t[1]);
            mesh_.triangles.push_back(t);
        }
    }
    void add_flap() {
        const mesh::Triangle t = any_triangle();
        const VertexIndex tip = add({static_cast<double>(below(5)), static_cast<double>(below(5)), 0.5});
        mesh_.triangles.push_back({t[0], t[1], tip});
        mesh_.triangles.push_back({t[1], t[0], tip});
    }
    void turn_some() {
        for (mesh::Triangle& t : mesh_.triangles)
            if (below(12) == 0) std::swap(t[1], t[2]);
    }
    void drop_some() {
        for (int i = 0; i < 2 && mesh_.triangles.size() > 4; ++i) {
            any_triangle() = mesh_.triangles.back();
            mesh_.triangles.pop_back();
        }
    }
    /// Cuts an edge of one of its facets.
    void add_needle() {
        const mesh::Triangle t = any_triangle();
        const VertexIndex middle = add(0.5 * (mesh_.vertices[t[0]] + mesh_.vertices[t[1]]));
        any_triangle();
        for (mesh::Triangle& other : mesh_.triangles) {
            if (other != t) continue;
            other = {t[0], middle, t[2]};
            break;
        }
        mesh_.triangles.push_back({middle, t[1], t[2]});
        mesh_.triangles.push_back({t[0], t[1], middle});
    }

    std::mt19937 random_;
    mesh::Mesh mesh_;
    int grid_ = 1;
};

/// Whether every edge between positions is run along equally often both ways.
inline bool every_edge_balances(const mesh::Mesh& mesh) {
    const auto less = [](const Vec3& p, const Vec3& q) {
        return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
    };
    const auto less_pair = [&](const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
        return less(a[0], b[0]) || (!less(b[0], a[0]) && less(a[1], b[1]));
    };
    std::map<std::array<Vec3, 2>, int, decltype(less_pair)> balance(less_pair);
    for (const mesh::Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 from = mesh.vertices[t[k]], to = mesh.vertices[t[(k + 1) % 3]];
            if (less(from, to)) ++balance[{from, to}];
            if (less(to, from)) --balance[{to, from}];
        }
    return std::all_of(balance.begin(), balance.end(), [](const auto& entry) { return entry.second == 0; });
}

/// By solid angles, for places far from the surface beside the rounding of doubles.
inline int winding_number(const mesh::Mesh& mesh, Vec3 place) {
    double turns = 0;
    for (const mesh::Triangle& t : mesh.triangles) {
        const Vec3 a = mesh.vertices[t[0]] - place, b = mesh.vertices[t[1]] - place,
                   c = mesh.vertices[t[2]] - place;
        const double la = length(a), lb = length(b), lc = length(c);
        turns += 2 * std::atan2(dot(a, cross(b, c)),
                                la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    }
    return static_cast<int>(std::lround(turns / (4 * 3.14159265358979323846)));
}

}  // namespace octavo::tests
