// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <octavo/octree/cell.hpp>
#include <octavo/octree/color.hpp>

// A torus under an affine map, on the lattice.
//
// In the torus's own frame the signed distance s = |(ρ − major, z)| − minor, ρ = |(x, y)|, is exact and changes by
// at most |d| over a step d. A cell whose half diagonal maps to a step shorter than |s| is decided. Where the
// cell is small beside ρ and the distance q to the core circle, the gradient tells more: over the cell s leaves
// its tangent by at most (1/q + 1/ρ)/2 times the square of the step, which removes the cells of the shell that
// the half diagonal alone would leave gray. Rounding is bounded as for the other quadrics and added to both.
// Not guaranteed: tightness. A torus is not convex, and a cell near the surface may stay gray although it misses
// it; on the last level these are a few percent of the gray cells.

namespace octavo::csg {

struct LatticeTorus {
    std::array<std::array<double, 4>, 3> row{};  ///< lattice minus `origin` → own frame
    std::array<double, 3> origin{};
    double major = 0, minor = 0;
    double reach = 0;      ///< longest image of a vector with components at most 1
    double magnitude = 0;  ///< sum of the absolute entries of the linear part
    double constant = 0;   ///< the same of the last column, plus the radii

    /// The signed distance s at a point given by its differences to the origin.
    double distance(double dx, double dy, double dz) const {
        std::array<double, 3> p;
        for (std::size_t r = 0; r < 3; ++r)
            p[r] = row[r][0] * dx + row[r][1] * dy + row[r][2] * dz + row[r][3];
        const double radial = std::sqrt(p[0] * p[0] + p[1] * p[1]) - major;
        return std::sqrt(radial * radial + p[2] * p[2]) - minor;
    }
    /// Bounds its rounding where differences are at most `farthest`.
    double error(double farthest) const { return 128 * 0x1p-53 * (magnitude * farthest + constant); }

    octree::Color color(const octree::Cell& cell) const {
        const double half = 0.5 * cell.side();
        double farthest = half;
        std::array<double, 3> d;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            d[a] = (static_cast<double>(cell.low[axis]) + half) - origin[a];
            farthest = std::fmax(farthest, std::fabs(d[a]) + half);
        }
        std::array<double, 3> p;
        for (std::size_t r = 0; r < 3; ++r)
            p[r] = row[r][0] * d[0] + row[r][1] * d[1] + row[r][2] * d[2] + row[r][3];
        const double rho = std::sqrt(p[0] * p[0] + p[1] * p[1]);
        const double radial = rho - major;
        const double core = std::sqrt(radial * radial + p[2] * p[2]);
        const double slack = std::fabs(core - minor) - error(farthest);
        if (!(slack > 0)) return octree::Color::gray;

        double step = reach * half;
        const double nearest_core = core - step, nearest_axis = rho - step;
        if (nearest_core > 0 && nearest_axis > 0) {
            double linear = 0;
            for (std::size_t a = 0; a < 3; ++a)
                linear += std::fabs((radial / core) * (p[0] * row[0][a] + p[1] * row[1][a]) / rho +
                                    (p[2] / core) * row[2][a]);
            const double bend = 0.5 * step * step * (1 / nearest_core + 1 / nearest_axis);
            step = std::fmin(step, (linear * half + bend) * (1 + 0x1p-40));
        }
        if (!(slack > step)) return octree::Color::gray;
        return core < minor ? octree::Color::black : octree::Color::white;
    }

    void finish() {
        reach = magnitude = 0;
        constant = std::fabs(major) + std::fabs(minor);
        for (int signs = 0; signs < 4; ++signs) {
            double square = 0;
            for (const auto& r : row) {
                const double sum = r[0] + (signs & 1 ? -r[1] : r[1]) + (signs & 2 ? -r[2] : r[2]);
                square += sum * sum;
            }
            reach = std::fmax(reach, std::sqrt(square) * (1 + 0x1p-50));
        }
        for (const auto& r : row) {
            magnitude += std::fabs(r[0]) + std::fabs(r[1]) + std::fabs(r[2]);
            constant += std::fabs(r[3]);
        }
    }

    friend bool operator==(const LatticeTorus&, const LatticeTorus&) = default;
};

}  // namespace octavo::csg
