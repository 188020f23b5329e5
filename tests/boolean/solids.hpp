// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <octavo/mesh/mesh.hpp>

// Small solids on an integer grid, made to touch and coincide, and what the results of set operations on them
// must be. Nothing here uses the code under test: convex bodies are kept as half-spaces, their intersections are
// found by trying all triples of planes in integer arithmetic.

namespace octavo::tests {

using Grid = std::array<int, 3>;

/// n · x <= d.
struct HalfSpace {
    Grid n;
    int d;
    friend auto operator<=>(const HalfSpace&, const HalfSpace&) = default;
};

/// A convex body, as half-spaces and as an outward mesh.
struct Convex {
    std::vector<HalfSpace> sides;
    mesh::Mesh mesh;
};

inline Grid minus(Grid a, Grid b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Grid cross(Grid a, Grid b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline int dot(Grid a, Grid b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline Convex from_triangles(const std::vector<Grid>& points, const std::vector<mesh::Triangle>& triangles) {
    Convex body;
    std::set<HalfSpace> sides;
    for (const mesh::Triangle& t : triangles) {
        Grid n = cross(minus(points[t[1]], points[t[0]]), minus(points[t[2]], points[t[0]]));
        const int divisor = std::gcd(std::gcd(n[0], n[1]), n[2]);
        for (int& part : n) part /= divisor;
        sides.insert({n, dot(n, points[t[0]])});
    }
    body.sides.assign(sides.begin(), sides.end());
    for (const Grid& p : points)
        body.mesh.vertices.push_back(
            {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])});
    body.mesh.triangles = triangles;
    return body;
}

inline Convex box(Grid low, Grid high, bool other_diagonals = false) {
    std::vector<Grid> points;
    for (int i = 0; i < 8; ++i)
        points.push_back({i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]});
    const std::array<std::array<std::uint32_t, 4>, 6> quads{
        {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
    std::vector<mesh::Triangle> triangles;
    for (const auto& q : quads) {
        const std::size_t s = other_diagonals ? 1 : 0;
        triangles.push_back({q[s], q[(s + 1) % 4], q[(s + 2) % 4]});
        triangles.push_back({q[s], q[(s + 2) % 4], q[(s + 3) % 4]});
    }
    return from_triangles(points, triangles);
}

inline Convex tetrahedron(std::array<Grid, 4> p) {
    if (dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), minus(p[3], p[0])) > 0) std::swap(p[1], p[2]);
    return from_triangles({p[0], p[1], p[2], p[3]}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}});
}

/// A triangle swept along `axis`.
inline Convex prism(int axis, std::array<std::array<int, 2>, 3> triangle, int low, int high) {
    const auto& [a, b, c] = triangle;
    if ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) < 0)
        std::swap(triangle[1], triangle[2]);
    std::vector<Grid> points;
    for (const int height : {low, high})
        for (const auto& p : triangle) {
            Grid point;
            point[static_cast<std::size_t>(axis)] = height;
            point[static_cast<std::size_t>((axis + 1) % 3)] = p[0];
            point[static_cast<std::size_t>((axis + 2) % 3)] = p[1];
            points.push_back(point);
        }
    return from_triangles(
        points, {{0, 2, 1}, {3, 4, 5}, {0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {2, 0, 3}, {2, 3, 5}});
}

template <class Random>
Convex random_convex(Random& random, int side) {
    const auto number = [&](int low, int high) {
        return std::uniform_int_distribution<int>(low, high)(random);
    };
    const int kind = number(0, 2);
    if (kind == 0) {
        Grid low, high;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low[axis] = number(0, side - 1);
            high[axis] = number(low[axis] + 1, side);
        }
        return box(low, high, number(0, 1) == 1);
    }
    if (kind == 1) {
        for (;;) {
            std::array<Grid, 4> p;
            for (Grid& point : p)
                for (int& coordinate : point) coordinate = number(0, side);
            if (dot(cross(minus(p[1], p[0]), minus(p[2], p[0])), minus(p[3], p[0])) != 0)
                return tetrahedron(p);
        }
    }
    for (;;) {
        std::array<std::array<int, 2>, 3> t;
        for (auto& point : t)
            for (int& coordinate : point) coordinate = number(0, side);
        if ((t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) == (t[1][1] - t[0][1]) * (t[2][0] - t[0][0])) continue;
        const int low = number(0, side - 1);
        return prism(number(0, 2), t, low, number(low + 1, side));
    }
}

/// The volume of the intersection of half-spaces that is bounded. Its corners are found exactly (all triples of
/// planes, 64-bit homogeneous coordinates); only the final sum is in doubles.
inline double volume_of(std::vector<HalfSpace> sides) {
    std::sort(sides.begin(), sides.end());
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
    using Corner = std::array<std::int64_t, 4>;
    std::set<Corner> corners;
    for (std::size_t i = 0; i < sides.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Grid line = cross(sides[i].n, sides[j].n);
            if (line == Grid{}) continue;
            for (std::size_t k = 0; k < j; ++k) {
                std::int64_t w = dot(line, sides[k].n);
                if (w == 0) continue;
                const Grid jk = cross(sides[j].n, sides[k].n), ki = cross(sides[k].n, sides[i].n);
                Corner x;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    x[axis] = std::int64_t{sides[i].d} * jk[axis] + std::int64_t{sides[j].d} * ki[axis] +
                              std::int64_t{sides[k].d} * line[axis];
                x[3] = w;
                if (w < 0)
                    for (std::int64_t& part : x) part = -part;
                const std::int64_t divisor = std::gcd(std::gcd(x[0], x[1]), std::gcd(x[2], x[3]));
                for (std::int64_t& part : x) part /= divisor;
                bool inside = true;
                for (const HalfSpace& side : sides)
                    inside =
                        inside && side.n[0] * x[0] + side.n[1] * x[1] + side.n[2] * x[2] <= side.d * x[3];
                if (inside) corners.insert(x);
            }
        }
    double volume = 0;
    for (const HalfSpace& side : sides) {
        std::vector<Vec3> face;
        for (const Corner& x : corners)
            if (side.n[0] * x[0] + side.n[1] * x[1] + side.n[2] * x[2] == side.d * x[3]) {
                const double w = static_cast<double>(x[3]);
                face.push_back({static_cast<double>(x[0]) / w, static_cast<double>(x[1]) / w,
                                static_cast<double>(x[2]) / w});
            }
        if (face.size() < 3) continue;
        Vec3 middle;
        for (const Vec3& p : face) middle = middle + (1.0 / static_cast<double>(face.size())) * p;
        const Vec3 normal{static_cast<double>(side.n[0]), static_cast<double>(side.n[1]),
                          static_cast<double>(side.n[2])};
        const Vec3 first = face[0] - middle, second = octavo::cross(normal, first);
        std::sort(face.begin(), face.end(), [&](const Vec3& a, const Vec3& b) {
            const auto angle = [&](const Vec3& p) {
                return std::atan2(octavo::dot(p - middle, second) / length(normal),
                                  octavo::dot(p - middle, first));
            };
            return angle(a) < angle(b);
        });
        for (std::size_t i = 0; i < face.size(); ++i)
            volume += octavo::dot(middle, octavo::cross(face[i], face[(i + 1) % face.size()])) / 6;
    }
    return volume;
}

inline double volume_of(const mesh::Mesh& mesh) {
    double volume = 0;
    for (const mesh::Triangle& t : mesh.triangles)
        volume +=
            octavo::dot(mesh.vertices[t[0]], octavo::cross(mesh.vertices[t[1]], mesh.vertices[t[2]])) / 6;
    return volume;
}

/// Empty when every edge has two facets that run opposite ways, every vertex one fan, and every vertex is used;
/// else what is wrong.
inline std::string manifold_defect(const mesh::Mesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> next;  // directed edge → third corner
    std::vector<std::uint32_t> corners(mesh.vertices.size(), 0);
    for (const mesh::Triangle& t : mesh.triangles)
        for (std::size_t k = 0; k < 3; ++k) {
            if (t[k] >= mesh.vertices.size()) return "a corner does not exist";
            ++corners[t[k]];
            if (t[k] == t[(k + 1) % 3]) return "a facet repeats a corner";
            if (!next.emplace(std::pair{t[k], t[(k + 1) % 3]}, t[(k + 2) % 3]).second)
                return "a directed edge occurs twice";
        }
    std::vector<char> seen(mesh.vertices.size(), 0);
    for (const auto& [edge, third] : next) {
        if (!next.count({edge.second, edge.first})) return "an edge is open";
        if (seen[edge.first]) continue;
        seen[edge.first] = 1;
        // Round the vertex: from the edge v → a with third corner b on to the edge v → b.
        std::uint32_t fan = 0, at = edge.second;
        do {
            const auto place = next.find({edge.first, at});
            if (place == next.end()) return "a fan is open";
            at = place->second;
            ++fan;
        } while (at != edge.second && fan <= corners[edge.first]);
        if (fan != corners[edge.first]) return "a vertex has more than one fan";
    }
    for (const std::uint32_t count : corners)
        if (count == 0) return "a vertex is not used";
    return "";
}

}  // namespace octavo::tests
