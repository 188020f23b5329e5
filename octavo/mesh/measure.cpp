// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <tuple>

#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/topology.hpp>

namespace octavo::mesh {
namespace {

/// Sums of `width` series at once whose result does not depend on the order of the terms. Terms must not
/// exceed 2^term_exponent in magnitude.
///
/// (t + s) − s with s = 1.5 · 2^(52 + g) rounds t to a multiple of 2^g exactly, and t minus that is exact. If
/// g leaves room for `count` terms below 2^53 · 2^g, adding the slices is exact too. The third slice is
/// 3 · 53 − 2 log2(count) − … bits below the largest term: more than a double can show of the total.
template <int width>
class ReproducibleSums {
  public:
    static constexpr int term_exponent = 6;

    explicit ReproducibleSums(std::size_t count) {
        const int room = std::bit_width(count);
        int largest = term_exponent;
        for (double& shift : shifts_) {
            const int grid = largest + room - 53;
            shift = std::ldexp(1.5, 52 + grid);
            largest = grid;  // what is left of a term is at most half of this
        }
    }

    void add(const std::array<double, width>& terms) {
        for (int i = 0; i < width; ++i) {
            double rest = terms[i];
            for (int slice = 0; slice < slices; ++slice) {
                const double part = (rest + shifts_[slice]) - shifts_[slice];
                sums_[slice][i] += part;
                rest -= part;
            }
        }
    }

    double operator[](int i) const { return (sums_[2][i] + sums_[1][i]) + sums_[0][i]; }

  private:
    static constexpr int slices = 3;
    std::array<double, slices> shifts_{};
    std::array<std::array<double, width>, slices> sums_{};
};

enum Moment { six_volume, twice_area, m_x, m_y, m_z, m_xx, m_yy, m_zz, m_xy, m_yz, m_zx, moment_count };
using MomentSums = ReproducibleSums<moment_count>;

bool lexicographically_less(Vec3 a, Vec3 b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// The moments of the tetrahedron (0, a, b, c), each up to the constant that `measures_of` divides by. All
/// coordinates lie in [−1, 1], so that |det| ≤ 6 and no term exceeds 2^6.
std::array<double, moment_count> moments_of(Vec3 a, Vec3 b, Vec3 c) {
    // Start at the least corner: the same facet gives the same bits whichever corner it is stored from.
    if (lexicographically_less(b, a) && !lexicographically_less(c, b))
        std::tie(a, b, c) = std::tuple(b, c, a);
    else if (lexicographically_less(c, a))
        std::tie(a, b, c) = std::tuple(c, a, b);
    const Vec3 normal = cross(b - a, c - a);
    const double det = dot(a, normal);
    const Vec3 s = a + b + c;
    const auto product = [&](int i, int j) {
        // 120 times the integral of x_i x_j over the unit-determinant tetrahedron with one corner at 0; a
        // sixteenth of it, which keeps the term in bounds and costs no digit.
        return det * (s[i] * s[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]) * 0.0625;
    };
    return {det,           length(normal), det * s.x,     det * s.y,     det * s.z,    product(0, 0),
            product(1, 1), product(2, 2),  product(0, 1), product(1, 2), product(2, 0)};
}

/// `sums` are about `centre`, in units of 2^exponent.
void fill_from_moments(Measures& measures, const MomentSums& sums, Vec3 centre, int exponent) {
    const auto scaled = [&](double value, int power) { return std::ldexp(value, power * exponent); };
    measures.volume = scaled(sums[six_volume] / 6, 3);
    measures.area = scaled(sums[twice_area] / 2, 2);
    measures.centroid = centre;
    if (sums[six_volume] == 0) return;
    const double volume = sums[six_volume] / 6;
    const Vec3 c{sums[m_x] / 24 / volume, sums[m_y] / 24 / volume, sums[m_z] / 24 / volume};
    measures.centroid = centre + Vec3{scaled(c.x, 1), scaled(c.y, 1), scaled(c.z, 1)};
    const double xx = sums[m_xx] * 16 / 120 - volume * c.x * c.x;
    const double yy = sums[m_yy] * 16 / 120 - volume * c.y * c.y;
    const double zz = sums[m_zz] * 16 / 120 - volume * c.z * c.z;
    const double xy = -scaled(sums[m_xy] * 16 / 120 - volume * c.x * c.y, 5);
    const double yz = -scaled(sums[m_yz] * 16 / 120 - volume * c.y * c.z, 5);
    const double zx = -scaled(sums[m_zx] * 16 / 120 - volume * c.z * c.x, 5);
    measures.inertia[0] = {scaled(yy + zz, 5), xy, zx};
    measures.inertia[1] = {xy, scaled(zz + xx, 5), yz};
    measures.inertia[2] = {zx, yz, scaled(xx + yy, 5)};
}

void fill_topology(Measures& measures, const Mesh& mesh) {
    const EdgeTable edges = build_edges(mesh.triangles, mesh.vertices.size());
    std::int64_t faces = 0;
    for (std::size_t face = 0; face < mesh.triangles.size(); ++face)
        faces += edges.edge_of_side[3 * face] != no_index;
    bool manifold = faces > 0;
    for (EdgeIndex edge = 0; edge < edges.size(); ++edge) {
        const auto sides = edges.sides_of(edge);
        manifold = manifold && sides.size() == 2 &&
                   runs_upward(mesh.triangles, sides[0]) != runs_upward(mesh.triangles, sides[1]);
    }
    measures.edges = static_cast<std::int64_t>(edges.size());
    measures.euler_number = measures.used_vertices - measures.edges + faces;
    measures.components = components_by_vertex(mesh.triangles, mesh.vertices.size()).count;
    // Surfaces that only touch in a vertex share it; each fan is a vertex of its own surface.
    if (!manifold) return;
    const std::vector<SideIndex> fans = fan_of_corner(edges, mesh.triangles);
    std::int64_t fan_count = 0;
    for (SideIndex corner = 0; corner < fans.size(); ++corner)
        fan_count += fans[corner] == corner && edges.edge_of_side[corner] != no_index;
    const std::int64_t euler = fan_count - measures.edges + faces;
    std::int64_t surfaces = 0;
    const Components by_edge = components_by_edge(edges, mesh.triangles.size());
    surfaces = by_edge.count - (static_cast<std::int64_t>(mesh.triangles.size()) - faces);
    measures.genus = surfaces - euler / 2;
}

}  // namespace

Measures measure(const Mesh& mesh) {
    Measures measures;
    const std::vector<bool> used = used_vertices(mesh.triangles, mesh.vertices.size());
    for (std::size_t vertex = 0; vertex < mesh.vertices.size(); ++vertex) {
        if (!used[vertex]) continue;
        measures.bounds.add(mesh.vertices[vertex]);
        ++measures.used_vertices;
    }
    fill_topology(measures, mesh);
    if (measures.bounds.empty()) return measures;

    const Vec3 low = measures.bounds.low, high = measures.bounds.high;
    const Vec3 centre = 0.5 * low + 0.5 * high;
    const Vec3 half = 0.5 * high - 0.5 * low;
    const double extent = std::max({half.x, half.y, half.z, std::ldexp(1.0, -1000)});
    const int exponent = std::ilogb(extent) + 1;
    const double scale = std::ldexp(1.0, -exponent);
    MomentSums sums(mesh.triangles.size());
    for (const Triangle& t : mesh.triangles) {
        const auto local = [&](VertexIndex vertex) { return scale * (mesh.vertices[vertex] - centre); };
        sums.add(moments_of(local(t[0]), local(t[1]), local(t[2])));
    }
    fill_from_moments(measures, sums, centre, exponent);
    return measures;
}

exact::int128 exact_volume6(std::span<const exact::Point> points, std::span<const Triangle> triangles) {
    // Coordinates 26 bits → 2×2 minors 53 bits and a sign → determinant of three of them 81 → 2^32 facets
    // 113.
    static_assert(3 * exact::coordinate_bits + 3 + 32 < 127);
    exact::int128 sum = 0;
    for (const Triangle& t : triangles) {
        const exact::Point a = points[t[0]], b = points[t[1]], c = points[t[2]];
        const auto minor = [](std::int64_t p, std::int64_t q, std::int64_t r, std::int64_t s) {
            return p * s - q * r;
        };
        sum += exact::int128{a.x} * minor(b.y, b.z, c.y, c.z) +
               exact::int128{a.y} * minor(b.z, b.x, c.z, c.x) +
               exact::int128{a.z} * minor(b.x, b.y, c.x, c.y);
    }
    return sum;
}

exact::int128 exact_volume6(const LatticeMesh& mesh) { return exact_volume6(mesh.points, mesh.triangles); }

}  // namespace octavo::mesh
