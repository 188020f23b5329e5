// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <octavo/csg/lattice_plane.hpp>
#include <octavo/csg/quadric.hpp>
#include <octavo/octree/cell.hpp>

// A surface in steps along the axes from the low corner of a cell.
//
// Idea: in such steps a plane takes four numbers and a quadric ten. They are made exactly (planes) or in double
// precision (quadrics) for each cell and then rounded to single precision, so what that loses is relative to the
// cell and not to the world. Values at many points of the cell then fit few SIMD registers. A point nearer to the
// surface than the error bound is left to integers or doubles.
// For use inside a source file only: vector types have no stable ABI.

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

namespace octavo::csg {

using SingleQuad = float __attribute__((vector_size(16)));
using DoubleQuad = double __attribute__((vector_size(32)));

// Every number of the steps is rounded once to single precision, and a value passes through at most fourteen more
// roundings of partial sums below `size`: 15 units of 2^-24. The bound allows 32; the last number covers underflow.
inline constexpr float single_error = 0x1p-19F, underflow = 0x1p-100F;

/// Differences from the origin of a surface to the low corner of a cell, and the most they are in the cell.
struct Offset {
    std::array<double, 3> low;
    double farthest = 0;

    Offset(const std::array<double, 3>& origin, const octree::Cell& cell) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            low[a] = static_cast<double>(cell.low[axis]) - origin[a];
            farthest = std::max(farthest, std::fabs(low[a]));
        }
        farthest += cell.side();
    }
};

/// A plane, negative inside.
struct PlaneSteps {
    std::int64_t low, x, y, z;  ///< exact, positive inside
    float at_low, sx, sy, sz;

    PlaneSteps(const LatticePlane& plane, const octree::Cell& cell, std::int64_t step)
        : low(plane.at(cell.low.x, cell.low.y, cell.low.z)),
          x(plane.normal[0] * step),
          y(plane.normal[1] * step),
          z(plane.normal[2] * step),
          at_low(-static_cast<float>(low)),
          sx(-static_cast<float>(x)),
          sy(-static_cast<float>(y)),
          sz(-static_cast<float>(z)) {}

    /// Bounds the error of a value at most `steps` steps away on each axis.
    float error(float steps) const {
        return single_error * (std::fabs(at_low) + steps * (std::fabs(sx) + std::fabs(sy) + std::fabs(sz)));
    }
};

/// A quadric at a cell: its value and half its gradient at the low corner.
struct QuadricAtCorner {
    double value;
    DoubleQuad half_gradient;  // three components

    QuadricAtCorner(const Quadric& q, const std::array<double, 3>& d) {
        // Each row by itself: the matrix as a whole would be copied in smaller parts, for which the registers wait.
        const auto row = [&](std::size_t r) {
            DoubleQuad result;
            std::memcpy(&result, q.form[r].data(), sizeof result);
            return result;
        };
        half_gradient = row(3) + row(0) * d[0] + row(1) * d[1] + row(2) * d[2];
        value =
            (d[0] * half_gradient[0] + d[1] * half_gradient[1] + d[2] * half_gradient[2]) + half_gradient[3];
    }
    /// At a point `x`, `y`, `z` further.
    double at(const Quadric& q, double x, double y, double z) const {
        const auto& f = q.form;
        return value + x * (2 * half_gradient[0] + x * f[0][0] + 2 * y * f[0][1] + 2 * z * f[0][2]) +
               y * (2 * half_gradient[1] + y * f[1][1] + 2 * z * f[1][2]) +
               z * (2 * half_gradient[2] + z * f[2][2]);
    }
};

/// A quadric; mixed terms hold both of theirs.
struct QuadricSteps {
    float low, x, y, z, xx, yy, zz, xy, xz, yz;
    float size;  ///< bounds every partial sum of values and of half gradients in the cell

    QuadricSteps(const Quadric& q, const QuadricAtCorner& corner, double step, float steps) {
        const auto& f = q.form;
        DoubleQuad at_corner = corner.half_gradient * (2 * step);
        at_corner[3] = corner.value;
        const double square = step * step;
        const SingleQuad first = __builtin_convertvector(at_corner, SingleQuad);
        const SingleQuad squares =
            __builtin_convertvector(DoubleQuad{f[0][0], f[1][1], f[2][2], 0} * square, SingleQuad);
        const SingleQuad mixed =
            __builtin_convertvector(DoubleQuad{f[0][1], f[0][2], f[1][2], 0} * (2 * square), SingleQuad);
        const auto absolute = [](SingleQuad v) {
            using Integers = std::int32_t __attribute__((vector_size(16)));
            return std::bit_cast<SingleQuad>(std::bit_cast<Integers>(v) & 0x7FFFFFFF);
        };
        const SingleQuad sum =
            steps * absolute(first) + steps * steps * (absolute(squares) + absolute(mixed));
        size = (sum[0] + sum[1]) + (sum[2] + sum[3]);
        x = first[0], y = first[1], z = first[2], low = first[3];
        xx = squares[0], yy = squares[1], zz = squares[2];
        xy = mixed[0], xz = mixed[1], yz = mixed[2];
    }
};

/// The linear term w · x + v of a cone, which is negative in the other nappe. Where q is negative beyond its error,
/// that term is far from zero, and so its sign is right.
struct NappeSteps {
    double low, x, y, z;
    double reach;  ///< the most it changes over half a step on every axis
    double error;

    NappeSteps(const Quadric& quadric, const Offset& offset, double step)
        : low(quadric.axis[0] * offset.low[0] + quadric.axis[1] * offset.low[1] +
              quadric.axis[2] * offset.low[2] + quadric.axis[3]),
          x(quadric.axis[0] * step),
          y(quadric.axis[1] * step),
          z(quadric.axis[2] * step),
          reach(0.5 * step * quadric.axis_reach),
          error(64 * 0x1p-53 * (quadric.magnitude * offset.farthest + quadric.constant)) {}

    double at(double i, double j, double k) const { return low + i * x + j * y + k * z; }
    /// Whether it is positive at all points up to `steps` steps away.
    bool all_positive(double steps) const { return low - 2 * steps * reach > error; }
};

}  // namespace octavo::csg

#pragma GCC diagnostic pop
