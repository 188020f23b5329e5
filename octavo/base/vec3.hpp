// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <limits>

// Double vectors, boxes and affine maps: what comes in and goes out. Nothing here decides anything; decisions
// are made on the integer lattice of exact/.

namespace octavo {

struct Vec3 {
    double x = 0, y = 0, z = 0;

    double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
    double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
    friend bool operator==(const Vec3&, const Vec3&) = default;
};

inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline bool is_finite(Vec3 a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

/// An axis-aligned box; the default one is empty (low > high).
struct Box3 {
    Vec3 low{infinity, infinity, infinity};
    Vec3 high{-infinity, -infinity, -infinity};
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    bool empty() const { return !(low.x <= high.x && low.y <= high.y && low.z <= high.z); }
    Vec3 extents() const { return empty() ? Vec3{} : high - low; }
    void add(Vec3 p) {
        for (int axis = 0; axis < 3; ++axis) {
            low[axis] = p[axis] < low[axis] ? p[axis] : low[axis];
            high[axis] = p[axis] > high[axis] ? p[axis] : high[axis];
        }
    }
    void add(const Box3& box) {
        if (!box.empty()) add(box.low), add(box.high);
    }
};

/// x ↦ M x + t as the first three rows of a 4×4 matrix, row-major; the identity by default.
struct Affine {
    std::array<std::array<double, 4>, 3> m{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

    Vec3 operator()(Vec3 p) const {
        return {m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + m[0][3],
                m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + m[1][3],
                m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + m[2][3]};
    }
    double determinant() const {
        return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    }
    /// Whether the determinant is negative, decided without rounding.
    bool mirrors() const;
    friend bool operator==(const Affine&, const Affine&) = default;
};

/// First `inner`, then `outer`.
inline Affine compose(const Affine& outer, const Affine& inner) {
    Affine result;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 4; ++column) {
            double sum = column == 3 ? outer.m[row][3] : 0;
            for (int k = 0; k < 3; ++k) sum += outer.m[row][k] * inner.m[k][column];
            result.m[row][column] = sum;
        }
    return result;
}

}  // namespace octavo
