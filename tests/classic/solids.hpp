// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>
#include <vector>

#include <octavo/mesh/mesh.hpp>

// Closed surfaces for tests, on the lattice: boxes, tetrahedra, spheres, and bags of them that overlap, nest, touch
// and coincide.

namespace octavo::tests {

inline void append(mesh::LatticeMesh& mesh, const mesh::LatticeMesh& part) {
    const auto offset = static_cast<mesh::VertexIndex>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), part.points.begin(), part.points.end());
    for (const mesh::Triangle& t : part.triangles)
        mesh.triangles.push_back({t[0] + offset, t[1] + offset, t[2] + offset});
}

inline mesh::LatticeMesh reversed(mesh::LatticeMesh mesh) {
    for (mesh::Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
    return mesh;
}

inline mesh::LatticeMesh box(exact::Point low, exact::Point high) {
    mesh::LatticeMesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.points.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

inline mesh::LatticeMesh tetrahedron(std::array<exact::Point, 4> p) {
    mesh::LatticeMesh mesh;
    mesh.points.assign(p.begin(), p.end());
    mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    return mesh;
}

/// An octahedron whose facets are split in four `rounds` times, rounded to the lattice.
inline mesh::LatticeMesh sphere(exact::Point centre, std::int32_t radius, int rounds) {
    mesh::LatticeMesh mesh;
    std::vector<Vec3> directions{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int round = 0; round < rounds; ++round) {
        std::map<std::pair<mesh::VertexIndex, mesh::VertexIndex>, mesh::VertexIndex> middles;
        const auto middle = [&](mesh::VertexIndex a, mesh::VertexIndex b) {
            const auto [found, added] =
                middles.try_emplace(std::minmax(a, b), static_cast<mesh::VertexIndex>(directions.size()));
            if (added) {
                const Vec3 sum = directions[a] + directions[b];
                directions.push_back((1 / length(sum)) * sum);
            }
            return found->second;
        };
        std::vector<mesh::Triangle> finer;
        for (const auto& [a, b, c] : mesh.triangles) {
            const mesh::VertexIndex ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        mesh.triangles = finer;
    }
    for (const Vec3& d : directions)
        mesh.points.push_back({static_cast<std::int32_t>(std::lround(centre.x + radius * d.x)),
                               static_cast<std::int32_t>(std::lround(centre.y + radius * d.y)),
                               static_cast<std::int32_t>(std::lround(centre.z + radius * d.z))});
    return mesh;
}

/// Points of a coarse grid with pitch 2^26 / cells, so that many coincide and most lie in walls of cells.
class GridPoints {
  public:
    GridPoints(unsigned seed, int cells) : random_(seed), cells_(cells) {}
    exact::Point operator()() { return {one(), one(), one()}; }
    std::mt19937& random() { return random_; }
    std::int32_t one() {
        return std::min(exact::universe_side - 1,
                        static_cast<std::int32_t>(random_() % static_cast<unsigned>(cells_ + 1)) *
                            (exact::universe_side / cells_));
    }

  private:
    std::mt19937 random_;
    int cells_;
};

/// A few boxes and tetrahedra with corners on the grid, some inside out: overlapping, nested, touching, coinciding.
inline mesh::LatticeMesh random_bag(GridPoints& points) {
    mesh::LatticeMesh bag;
    const unsigned count = 1 + points.random()() % 4;
    for (unsigned i = 0; i < count; ++i) {
        mesh::LatticeMesh part;
        if (points.random()() % 2) {
            const exact::Point p = points(), q = points();
            part = box({std::min(p.x, q.x), std::min(p.y, q.y), std::min(p.z, q.z)},
                       {std::max(p.x, q.x), std::max(p.y, q.y), std::max(p.z, q.z)});
        } else {
            part = tetrahedron({points(), points(), points(), points()});
        }
        append(bag, points.random()() % 4 == 0 ? reversed(part) : part);
    }
    return bag;
}

/// Six times the signed volume, in cubic lattice units: 26-bit coordinates, 78 bits a facet and the sum of many.
__extension__ using Wide = __int128;
inline Wide six_volumes(const mesh::LatticeMesh& mesh) {
    Wide sum = 0;
    for (const mesh::Triangle& t : mesh.triangles) {
        const exact::Point a = mesh.points[t[0]], b = mesh.points[t[1]], c = mesh.points[t[2]];
        const auto minor = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) {
            return p * s - q * r;
        };
        sum += Wide{a.x} * minor(b.y, b.z, c.y, c.z) - Wide{a.y} * minor(b.x, b.z, c.x, c.z) +
               Wide{a.z} * minor(b.x, b.y, c.x, c.y);
    }
    return sum;
}

}  // namespace octavo::tests
