// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/base/any_scale.hpp>
#include <octavo/csg/primitive.hpp>

namespace octavo::csg {
namespace {

constexpr double infinity = Box3::infinity;

Box3 whole_space() { return {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}; }

bool less_everywhere(Vec3 low, Vec3 high) { return low.x < high.x && low.y < high.y && low.z < high.z; }

/// Bounds of the image of { s : s = centre + part, part in a set with these half extents along image axes }.
Box3 around(Vec3 centre, Vec3 half) { return {centre - half, centre + half}; }

/// By squares where they neither overflow nor vanish: std::hypot takes several times as long.
double length_of(double x, double y, double z) {
    const double square = x * x + y * y + z * z;
    return square > 1e-200 && square < 1e200 ? std::sqrt(square) : std::hypot(x, y, z);
}

/// Half extents of the image of the disc of radius `radius` in the plane z = 0 of the local frame.
Vec3 disc_extent(const Affine& place, double radius) {
    Vec3 half;
    for (int axis = 0; axis < 3; ++axis) {
        const auto& row = place.m[static_cast<std::size_t>(axis)];
        half[axis] = radius * length_of(row[0], row[1], 0);
    }
    return half;
}

struct Bounds {
    const Affine& place;

    Box3 operator()(const Cuboid& cuboid) const {
        // Rounded sums grow with their terms, so these are those of the eight corners to the bit.
        Box3 box{{}, {}};
        for (int axis = 0; axis < 3; ++axis) {
            const auto& row = place.m[static_cast<std::size_t>(axis)];
            for (int along = 0; along < 3; ++along) {
                const double a = row[static_cast<std::size_t>(along)] * cuboid.low[along],
                             b = row[static_cast<std::size_t>(along)] * cuboid.high[along];
                box.low[axis] += std::min(a, b);
                box.high[axis] += std::max(a, b);
            }
            box.low[axis] += row[3];
            box.high[axis] += row[3];
        }
        return box;
    }
    Box3 operator()(const Ball& ball) const {
        Vec3 half;
        for (int axis = 0; axis < 3; ++axis) {
            const auto& row = place.m[static_cast<std::size_t>(axis)];
            half[axis] = ball.radius * length_of(row[0], row[1], row[2]);
        }
        return around(place({}), half);
    }
    Box3 operator()(const Frustum& frustum) const {
        Box3 box = around(place({0, 0, frustum.low}), disc_extent(place, frustum.bottom));
        box.add(around(place({0, 0, frustum.high}), disc_extent(place, frustum.top)));
        return box;
    }
    Box3 operator()(const Torus& torus) const {
        Vec3 half = disc_extent(place, torus.major);
        half = half + (*this)(Ball{torus.minor}).high - place({});
        return around(place({}), half);
    }
    Box3 operator()(const HalfSpace&) const { return whole_space(); }
    Box3 operator()(const Everything&) const { return whole_space(); }
    Box3 operator()(const Polyhedron& polyhedron) const {
        Box3 box;
        for (const mesh::Triangle& triangle : polyhedron.mesh->triangles)
            for (const mesh::VertexIndex vertex : triangle) box.add(place(polyhedron.mesh->vertices[vertex]));
        return box;
    }
};

struct Degenerate {
    bool operator()(const Cuboid& cuboid) const { return !less_everywhere(cuboid.low, cuboid.high); }
    bool operator()(const Ball& ball) const { return !(ball.radius > 0); }
    bool operator()(const Frustum& frustum) const {
        return !(frustum.low < frustum.high) || !(frustum.bottom >= 0) || !(frustum.top >= 0) ||
               !(frustum.bottom + frustum.top > 0);
    }
    bool operator()(const Torus& torus) const { return !(torus.minor > 0) || !(torus.major >= 0); }
    bool operator()(const HalfSpace&) const { return false; }
    bool operator()(const Everything&) const { return false; }
    bool operator()(const Polyhedron& polyhedron) const {
        return !polyhedron.mesh || polyhedron.mesh->triangles.size() < 4;
    }
};

struct Finite {
    bool operator()(const Cuboid& cuboid) const {
        return octavo::is_finite(cuboid.low) && octavo::is_finite(cuboid.high);
    }
    bool operator()(const Ball& ball) const { return std::isfinite(ball.radius); }
    bool operator()(const Frustum& frustum) const {
        return std::isfinite(frustum.low) && std::isfinite(frustum.high) && std::isfinite(frustum.bottom) &&
               std::isfinite(frustum.top);
    }
    bool operator()(const Torus& torus) const {
        return std::isfinite(torus.major) && std::isfinite(torus.minor);
    }
    bool operator()(const HalfSpace& half_space) const {
        return octavo::is_finite(half_space.normal) && std::isfinite(half_space.offset) &&
               half_space.normal != Vec3{};
    }
    bool operator()(const Everything&) const { return true; }
    bool operator()(const Polyhedron& polyhedron) const {
        return !polyhedron.mesh ||
               std::all_of(polyhedron.mesh->vertices.begin(), polyhedron.mesh->vertices.end(),
                           [](Vec3 vertex) { return octavo::is_finite(vertex); });
    }
};

/// Below this ratio of volumes the image of a body is thinner than 2^-46 of its size, a millionth of the unit of a
/// lattice that holds it, and the products that a determinant is made of cancel to their rounding.
constexpr double least_ratio = 0x1p-46;

using Rows = std::array<std::array<double, 4>, 3>;

/// The square of the volume of a box whose edges are as long as the rows, or the columns if that is less.
template <class Real>
Real least_square_of_box(const Rows& m) {
    const auto square = [](Real x, Real y, Real z) { return x * x + y * y + z * z; };
    Real rows = 1, columns = 1;
    for (std::size_t i = 0; i < 3; ++i) {
        rows *= square(m[i][0], m[i][1], m[i][2]);
        columns *= square(m[0][i], m[1][i], m[2][i]);
    }
    return std::min(rows, columns);
}

template <class Real>
Real determinant_of(const Rows& m) {
    Real sum = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        sum += m[0][i] * (static_cast<Real>(m[1][j]) * m[2][k] - static_cast<Real>(m[1][k]) * m[2][j]);
    }
    return sum;
}

}  // namespace

bool is_degenerate(const Primitive& primitive) { return std::visit(Degenerate{}, primitive); }

bool is_finite(const Primitive& primitive) { return std::visit(Finite{}, primitive); }

Box3 bounds(const Primitive& primitive, const Affine& place) {
    return is_degenerate(primitive) ? Box3{} : std::visit(Bounds{place}, primitive);
}

bool is_singular(const Affine& map) {
    // Hadamard's ratio: the volume that the unit cube's image spans, over that of a box with its edges, taken by
    // rows and by columns, so that scaling an axis before or after does not count.
    const auto& m = map.m;
    // Squares first: six roots a primitive were a tenth of the time that compiling an expression takes.
    const double least_square = least_square_of_box<double>(m);
    if (least_square > 1e-200 && least_square < 1e200 &&
        std::fabs(map.determinant()) > least_ratio * std::sqrt(least_square))
        return false;
    // Otherwise where nothing overflows or vanishes, and last of all with both rows and columns brought to one size.
    if (std::fabs(determinant_of<long double>(m)) >
        least_ratio * std::sqrt(least_square_of_box<long double>(m)))
        return false;
    const Affine even = balanced(map);
    return !(std::fabs(even.determinant()) > least_ratio * std::sqrt(least_square_of_box<double>(even.m)));
}

}  // namespace octavo::csg
