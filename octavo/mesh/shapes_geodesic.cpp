// SPDX-License-Identifier: Apache-2.0
// Spheres from regular solids, and the rough sphere made of one.
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <octavo/base/check.hpp>
#include <octavo/mesh/shapes.hpp>

namespace octavo::mesh {
namespace {

/// A regular solid with triangular faces.
struct Base {
    std::vector<Vec3> vertices;
    std::vector<Triangle> faces;
};

Base octahedron() {
    return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
            {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

Base icosahedron() {
    const double g = std::numbers::phi;
    return {{{-1, g, 0},
             {1, g, 0},
             {-1, -g, 0},
             {1, -g, 0},
             {0, -1, g},
             {0, 1, g},
             {0, -1, -g},
             {0, 1, -g},
             {g, 0, -1},
             {g, 0, 1},
             {-g, 0, -1},
             {-g, 0, 1}},
            {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
             {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
             {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}}};
}

/// Numbers the grid points of the subdivided faces so that faces share those on common edges.
class Subdivision {
  public:
    Subdivision(const Base& base, std::uint32_t frequency) : base_(base), frequency_(frequency) {
        mesh_.vertices = base.vertices;
    }

    Mesh run() {
        for (const Triangle& face : base_.faces) subdivide(face);
        return std::move(mesh_);
    }

  private:
    /// The point i/f of the way from a to b. Summed from the lower-numbered end, so that both faces at an
    /// edge get the same bits.
    VertexIndex edge_point(VertexIndex a, VertexIndex b, std::uint32_t i) {
        if (i == 0) return a;
        if (i == frequency_) return b;
        if (a > b) return edge_point(b, a, frequency_ - i);
        auto [entry, added] =
            edge_start_.try_emplace({a, b}, static_cast<VertexIndex>(mesh_.vertices.size()));
        if (added)
            for (std::uint32_t k = 1; k < frequency_; ++k)
                mesh_.vertices.push_back(static_cast<double>(frequency_ - k) * base_.vertices[a] +
                                         static_cast<double>(k) * base_.vertices[b]);
        return entry->second + i - 1;
    }

    void subdivide(const Triangle& face) {
        const std::uint32_t f = frequency_;
        // Row j has f − j + 1 points: from a + (c − a) j/f towards b + (c − b) j/f.
        std::vector<std::vector<VertexIndex>> rows(f + 1);
        for (std::uint32_t j = 0; j <= f; ++j)
            for (std::uint32_t i = 0; i + j <= f; ++i) rows[j].push_back(grid_point(face, i, j));
        for (std::uint32_t j = 0; j < f; ++j)
            for (std::uint32_t i = 0; i + j < f; ++i) {
                mesh_.triangles.push_back({rows[j][i], rows[j][i + 1], rows[j + 1][i]});
                if (i + j + 1 < f)
                    mesh_.triangles.push_back({rows[j][i + 1], rows[j + 1][i + 1], rows[j + 1][i]});
            }
    }

    VertexIndex grid_point(const Triangle& face, std::uint32_t i, std::uint32_t j) {
        const auto [a, b, c] = face;
        const std::uint32_t f = frequency_;
        if (j == 0) return edge_point(a, b, i);
        if (i == 0) return edge_point(a, c, j);
        if (i + j == f) return edge_point(b, c, j);
        mesh_.vertices.push_back(static_cast<double>(f - i - j) * base_.vertices[a] +
                                 static_cast<double>(i) * base_.vertices[b] +
                                 static_cast<double>(j) * base_.vertices[c]);
        return static_cast<VertexIndex>(mesh_.vertices.size() - 1);
    }

    const Base& base_;
    std::uint32_t frequency_;
    Mesh mesh_;
    std::map<std::pair<VertexIndex, VertexIndex>, VertexIndex> edge_start_;
};

Mesh geodesic(const Base& base, double radius, std::uint32_t frequency) {
    OCTAVO_CHECK(radius > 0 && frequency >= 1, "a sphere needs a positive radius and frequency");
    Mesh mesh = Subdivision(base, frequency).run();
    for (Vec3& vertex : mesh.vertices) vertex = (radius / length(vertex)) * vertex;
    return mesh;
}

/// A number in [−1, 1] from the seed and a grid point.
double lattice_noise(std::uint64_t seed, std::int64_t x, std::int64_t y, std::int64_t z) {
    std::uint64_t h = seed * 0x9e3779b97f4a7c15ULL;
    for (const std::int64_t coordinate : {x, y, z}) {
        h = (h ^ static_cast<std::uint64_t>(coordinate)) * 0xbf58476d1ce4e5b9ULL;
        h ^= h >> 29;
    }
    h *= 0x94d049bb133111ebULL;
    return static_cast<double>(h >> 11) * 0x1p-52 - 1;
}

/// Value noise: grid values blended by a polynomial with continuous second derivative. Only +, − and ×, so
/// the same bits everywhere.
double smooth_noise(std::uint64_t seed, Vec3 p) {
    std::array<std::int64_t, 3> cell{};
    std::array<double, 3> t{};
    for (int axis = 0; axis < 3; ++axis) {
        const double floor = std::floor(p[axis]), u = p[axis] - floor;
        cell[axis] = static_cast<std::int64_t>(floor);
        t[axis] = u * u * u * (u * (u * 6 - 15) + 10);
    }
    double sum = 0;
    for (int corner = 0; corner < 8; ++corner) {
        double weight = 1;
        std::array<std::int64_t, 3> at{};
        for (int axis = 0; axis < 3; ++axis) {
            const int bit = corner >> axis & 1;
            at[axis] = cell[axis] + bit;
            weight *= bit ? t[axis] : 1 - t[axis];
        }
        sum += weight * lattice_noise(seed, at[0], at[1], at[2]);
    }
    return sum;
}

}  // namespace

Mesh octasphere(double radius, std::uint32_t frequency) { return geodesic(octahedron(), radius, frequency); }

Mesh icosphere(double radius, std::uint32_t frequency) { return geodesic(icosahedron(), radius, frequency); }

Mesh displaced_sphere(std::uint32_t frequency, const DisplacementOptions& options) {
    OCTAVO_CHECK(options.amplitude >= 0 && options.amplitude < 0.5,
                 "the amplitude must be below half the radius, or the sphere turns inside out");
    Mesh mesh = geodesic(icosahedron(), 1, frequency);
    for (Vec3& vertex : mesh.vertices) {
        double radius = 1, amplitude = options.amplitude, scale = options.frequency;
        for (std::uint32_t octave = 0; octave < options.octaves; ++octave) {
            radius += amplitude * smooth_noise(options.seed + octave, scale * vertex);
            amplitude *= 0.5, scale *= 2;
        }
        vertex = radius * vertex;
    }
    return mesh;
}

}  // namespace octavo::mesh
