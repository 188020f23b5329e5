// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>

#include <octavo/base/vec3.hpp>

// A convex quadric: the points x with |L x + l| <= w · x + v, a second-order cone.
//
// One form holds every curved convex primitive under every affine map: an ellipsoid (w = 0, v = 1), a cylinder
// without ends (two rows of L, w = 0, v = 1) and one nappe of a cone (two rows, w along the axis). The excess
// f(x) = |L x + l| − (w · x + v) is convex, so its tangent bounds it from below and the corners of a cell from
// above; that decides a cell nearly always with a few dozen operations.
//
// Exact means here: the sixteen doubles *are* the surface, rounded once from the primitive's matrix. Everything
// after is conservative: `error(…)` bounds what rounding can do to an evaluation of f, and no cell is called
// white or black unless f is beyond it. For a cell near the surface that is about 2^-45 of the primitive's size.

namespace octavo::csg {

struct SecondOrderCone {
    /// Rows 0–2: L and l; row 3: w and v, all relative to `origin`.
    std::array<std::array<double, 4>, 4> row{};
    /// A lattice point near the primitive, so that differences to it are exact and small.
    std::array<double, 3> origin{};
    /// The most that |L d| can be for a d with components at most 1, and the largest sum of a row.
    double reach = 0, magnitude = 0, constant = 0;

    /// Fills in `reach`, `magnitude` and `constant` from the rows.
    void finish() {
        reach = magnitude = constant = 0;
        for (int signs = 0; signs < 4; ++signs) {
            double square = 0;
            for (std::size_t i = 0; i < 3; ++i) {
                const double sum =
                    row[i][0] + (signs & 1 ? -row[i][1] : row[i][1]) + (signs & 2 ? -row[i][2] : row[i][2]);
                square += sum * sum;
            }
            reach = std::fmax(reach, std::sqrt(square) * (1 + 0x1p-50));
        }
        for (const auto& r : row) {
            magnitude += std::fabs(r[0]) + std::fabs(r[1]) + std::fabs(r[2]);
            constant += std::fabs(r[3]);
        }
    }

    /// Bounds the rounding of `excess` at a point whose differences to the origin are at most `distance`. Each of
    /// the four sums has four terms, so at most 5 roundings of parts of its magnitude; the norm of three errors
    /// and its own square root add less than as much again. 64 leaves a factor of three.
    double error(double distance) const { return 64 * 0x1p-53 * (magnitude * distance + constant); }

    double value(std::size_t r, double dx, double dy, double dz) const {
        return row[r][0] * dx + row[r][1] * dy + row[r][2] * dz + row[r][3];
    }
    /// f at a point given by its differences to the origin: negative inside.
    double excess(double dx, double dy, double dz) const {
        const double u = value(0, dx, dy, dz), v = value(1, dx, dy, dz), w = value(2, dx, dy, dz);
        return std::sqrt(u * u + v * v + w * w) - value(3, dx, dy, dz);
    }
    /// A subgradient of f there.
    Vec3 gradient(double dx, double dy, double dz) const {
        const double u = value(0, dx, dy, dz), v = value(1, dx, dy, dz), w = value(2, dx, dy, dz);
        const double norm = std::sqrt(u * u + v * v + w * w);
        const double inverse = norm > 0 ? 1 / norm : 0;
        Vec3 g;
        for (std::size_t axis = 0; axis < 3; ++axis)
            g[static_cast<int>(axis)] =
                inverse * (u * row[0][axis] + v * row[1][axis] + w * row[2][axis]) - row[3][axis];
        return g;
    }

    friend bool operator==(const SecondOrderCone&, const SecondOrderCone&) = default;
};

/// Whether two cones are the same set up to the rounding of the matrices they came from: equal quadratic forms,
/// whatever rotation of the rows wrote them.
bool same_cone(const SecondOrderCone& a, const SecondOrderCone& b);

}  // namespace octavo::csg
