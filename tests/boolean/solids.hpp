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

#include "unlimited.hpp"

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

/// An exact number. Volumes here are fractions of small denominators.

/// x / w, y / w, z / w, w > 0, without a common divisor.
using Corner = std::array<std::int64_t, 4>;

inline Corner reduced(Corner x) {
    const std::int64_t divisor = std::gcd(std::gcd(x[0], x[1]), std::gcd(x[2], x[3])) * (x[3] < 0 ? -1 : 1);
    for (std::int64_t& part : x) part /= divisor;
    return x;
}

/// Sums of determinants of corners, collected by denominator so that few fractions are added.
class VolumeSum {
  public:
    /// The volume of the tetrahedron of the origin and a triangle.
    void add(const Corner& a, const Corner& b, const Corner& c) {
        using Wide = __int128;
        const Wide determinant = Wide{a[0]} * (Wide{b[1]} * c[2] - Wide{b[2]} * c[1]) +
                                 Wide{a[1]} * (Wide{b[2]} * c[0] - Wide{b[0]} * c[2]) +
                                 Wide{a[2]} * (Wide{b[0]} * c[1] - Wide{b[1]} * c[0]);
        numerator_[Wide{a[3]} * b[3] * c[3]] += determinant;
    }
    Rational volume() const {
        Integer numerator = 0, denominator = 6;
        for (const auto& [part_denominator, part] : numerator_) {
            numerator *= part_denominator;
            numerator += part * denominator / 6;
            denominator *= part_denominator;
            const Integer divisor = gcd(numerator, denominator / 6);
            numerator /= divisor, denominator /= divisor;
        }
        return Rational(numerator, denominator);
    }

  private:
    std::map<__int128, __int128> numerator_;
};

/// The volume of the intersection of half-spaces that is bounded, exactly: its corners come from all triples of planes,
/// and only the order of corners round a face is found in doubles.
inline Rational exact_volume(std::vector<HalfSpace> sides) {
    std::sort(sides.begin(), sides.end());
    sides.erase(std::unique(sides.begin(), sides.end()), sides.end());
    std::set<Corner> corners;
    for (std::size_t i = 0; i < sides.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Grid line = cross(sides[i].n, sides[j].n);
            if (line == Grid{}) continue;
            for (std::size_t k = 0; k < j; ++k) {
                const std::int64_t w = dot(line, sides[k].n);
                if (w == 0) continue;
                const Grid jk = cross(sides[j].n, sides[k].n), ki = cross(sides[k].n, sides[i].n);
                Corner x;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    x[axis] = std::int64_t{sides[i].d} * jk[axis] + std::int64_t{sides[j].d} * ki[axis] +
                              std::int64_t{sides[k].d} * line[axis];
                x[3] = w;
                x = reduced(x);
                bool inside = true;
                for (const HalfSpace& side : sides)
                    inside =
                        inside && side.n[0] * x[0] + side.n[1] * x[1] + side.n[2] * x[2] <= side.d * x[3];
                if (inside) corners.insert(x);
            }
        }
    VolumeSum sum;
    for (const HalfSpace& side : sides) {
        struct Placed {
            double angle;
            Corner corner;
        };
        std::vector<Placed> face;
        const auto at = [](const Corner& x) {
            const double w = static_cast<double>(x[3]);
            return Vec3{static_cast<double>(x[0]) / w, static_cast<double>(x[1]) / w,
                        static_cast<double>(x[2]) / w};
        };
        for (const Corner& x : corners)
            if (side.n[0] * x[0] + side.n[1] * x[1] + side.n[2] * x[2] == side.d * x[3])
                face.push_back({0, x});
        if (face.size() < 3) continue;
        Vec3 middle;
        for (const Placed& each : face)
            middle = middle + (1.0 / static_cast<double>(face.size())) * at(each.corner);
        const Vec3 normal{static_cast<double>(side.n[0]), static_cast<double>(side.n[1]),
                          static_cast<double>(side.n[2])};
        const Vec3 first = at(face[0].corner) - middle, second = octavo::cross(normal, first);
        for (Placed& each : face)
            each.angle = std::atan2(octavo::dot(at(each.corner) - middle, second) / length(normal),
                                    octavo::dot(at(each.corner) - middle, first));
        std::sort(face.begin(), face.end(),
                  [](const Placed& a, const Placed& b) { return a.angle < b.angle; });
        for (std::size_t i = 1; i + 1 < face.size(); ++i)
            sum.add(face[0].corner, face[i].corner, face[i + 1].corner);
    }
    return sum.volume();
}

/// The fraction nearest to `number` among those of small denominators; what solids on a small grid have as coordinates
/// differs by far more than doubles round.
inline std::array<std::int64_t, 2> fraction_of(double number) {
    std::int64_t p[2] = {1, 0}, q[2] = {0, 1};  // the last convergents, newest first
    double rest = number;
    for (;;) {
        const double whole = std::floor(rest + 1e-9);
        const auto term = static_cast<std::int64_t>(whole);
        const std::int64_t next_p = term * p[0] + p[1], next_q = term * q[0] + q[1];
        p[1] = p[0], q[1] = q[0], p[0] = next_p, q[0] = next_q;
        if (std::fabs(static_cast<double>(p[0]) / static_cast<double>(q[0]) - number) < 1e-13 ||
            q[0] > 10000000)
            return {p[0], q[0]};
        rest = 1 / (rest - whole);
    }
}

/// The volume of a result on a small grid, with its vertices taken to the fractions that they were rounded from.
inline Rational exact_volume(const mesh::Mesh& mesh) {
    std::vector<Corner> corners;
    for (const Vec3& v : mesh.vertices) {
        const auto x = fraction_of(v.x), y = fraction_of(v.y), z = fraction_of(v.z);
        const std::int64_t w = std::lcm(std::lcm(x[1], y[1]), z[1]);
        corners.push_back({x[0] * (w / x[1]), y[0] * (w / y[1]), z[0] * (w / z[1]), w});
    }
    VolumeSum sum;
    for (const mesh::Triangle& t : mesh.triangles) sum.add(corners[t[0]], corners[t[1]], corners[t[2]]);
    return sum.volume();
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

/// The unit sphere with 8 `segments`² triangles: an octahedron's sides cut up and blown up.
inline mesh::Mesh octahedral_sphere(int segments) {
    mesh::Mesh sphere;
    std::map<Grid, std::uint32_t> number;
    for (int sides = 0; sides < 8; ++sides) {
        const int sx = sides & 1 ? -1 : 1, sy = sides & 2 ? -1 : 1, sz = sides & 4 ? -1 : 1;
        const auto at = [&](int a, int b) {
            const Grid grid{sx * (segments - a - b), sy * a, sz * b};
            const auto [place, is_new] =
                number.try_emplace(grid, static_cast<std::uint32_t>(sphere.vertices.size()));
            const Vec3 way{static_cast<double>(grid[0]), static_cast<double>(grid[1]),
                           static_cast<double>(grid[2])};
            if (is_new) sphere.vertices.push_back((1 / length(way)) * way);
            return place->second;
        };
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            sphere.triangles.push_back(sx * sy * sz > 0 ? mesh::Triangle{a, b, c} : mesh::Triangle{a, c, b});
        };
        for (int i = 0; i < segments; ++i)
            for (int j = 0; j < segments - i; ++j) {
                add(at(i, j), at(i + 1, j), at(i, j + 1));
                if (i + j + 1 < segments) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
            }
    }
    return sphere;
}

/// Several bodies as one operand, which then intersects itself.
inline mesh::Mesh joined(const std::vector<Convex>& bodies) {
    mesh::Mesh all;
    for (const Convex& body : bodies) {
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
        all.vertices.insert(all.vertices.end(), body.mesh.vertices.begin(), body.mesh.vertices.end());
        for (const mesh::Triangle& t : body.mesh.triangles)
            all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    }
    return all;
}

/// Of the facets from `first` on.
inline double area_of(const mesh::Mesh& mesh, std::size_t first = 0) {
    double area = 0;
    for (std::size_t i = first; i < mesh.triangles.size(); ++i) {
        const mesh::Triangle& t = mesh.triangles[i];
        area += length(cross(mesh.vertices[t[1]] - mesh.vertices[t[0]],
                             mesh.vertices[t[2]] - mesh.vertices[t[0]])) /
                2;
    }
    return area;
}

}  // namespace octavo::tests
