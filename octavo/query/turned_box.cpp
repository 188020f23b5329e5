// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <octavo/query/turned_box.hpp>

namespace octavo::query {
namespace {

using Axes = std::array<std::array<std::int16_t, 3>, 3>;

struct Interval {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void add(double x) {
        low = std::min(low, x);
        high = std::max(high, x);
    }
    double width() const { return high - low; }
};
using Extents = std::array<Interval, 3>;

/// Some faces of a mesh, or of so many of them one.
struct Patch {
    const mesh::LatticeMesh& mesh;
    std::span<const mesh::FaceIndex> faces;
    std::array<std::int32_t, 3> origin;
    std::size_t stride = 1;

    template <class Visit>
    void for_each_triangle(const Visit& visit) const {
        for (std::size_t i = 0; i < faces.size(); i += stride) {
            const mesh::Triangle& t = mesh.triangles[faces[i]];
            visit(place(t[0]), place(t[1]), place(t[2]));
        }
    }

  private:
    Vec3 place(mesh::VertexIndex vertex) const {
        const exact::Point p = mesh.points[vertex];
        return {static_cast<double>(p.x - origin[0]), static_cast<double>(p.y - origin[1]),
                static_cast<double>(p.z - origin[2])};
    }
};

/// How far a patch reaches along the axes.
Extents extents(const Patch& patch, const Axes& axes) {
    std::array<Vec3, 3> directions;
    for (std::size_t k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis)
            directions[k][axis] =
                static_cast<double>(axes[k][static_cast<std::size_t>(axis)]) / TurnedBox::unit;
    Extents found;
    patch.for_each_triangle([&](const Vec3& a, const Vec3& b, const Vec3& c) {
        for (std::size_t k = 0; k < 3; ++k)
            for (const Vec3* corner : {&a, &b, &c}) found[k].add(dot(directions[k], *corner));
    });
    return found;
}

double half_area(const Extents& e) {
    const double x = e[0].width(), y = e[1].width(), z = e[2].width();
    return x * y + y * z + z * x;
}

Axes rounded(Vec3 first, Vec3 second, Vec3 third) {
    Axes axes;
    const std::array<Vec3, 3> directions{first, second, third};
    for (std::size_t k = 0; k < 3; ++k)
        for (int axis = 0; axis < 3; ++axis)
            axes[k][static_cast<std::size_t>(axis)] =
                static_cast<std::int16_t>(std::lround(directions[k][axis] * TurnedBox::unit));
    return axes;
}

/// Frames worth trying: the coordinate axes, and for a patch with a mean normal that and directions in its plane.
std::vector<Axes> frames_for(const Patch& patch) {
    std::vector<Axes> frames{rounded({1, 0, 0}, {0, 1, 0}, {0, 0, 1})};
    Vec3 sum;
    double areas = 0;
    patch.for_each_triangle([&](const Vec3& a, const Vec3& b, const Vec3& c) {
        const Vec3 n = cross(b - a, c - a);
        sum = sum + n;
        areas += length(n);
    });
    // The normals of a patch that turns by more than this in all are no guide.
    if (!(length(sum) > 0.2 * areas)) return frames;
    const Vec3 normal = (1 / length(sum)) * sum;
    // Perpendicular to the coordinate axis that is least along the normal, and turned from there.
    int least = 0;
    for (int axis = 1; axis < 3; ++axis)
        if (std::fabs(normal[axis]) < std::fabs(normal[least])) least = axis;
    Vec3 axis;
    axis[least] = 1;
    Vec3 across = cross(normal, axis);
    across = (1 / length(across)) * across;
    const Vec3 along = cross(across, normal);
    constexpr int turns = 4;
    for (int i = 0; i < turns; ++i) {
        const double angle = 1.5707963267948966 * i / turns;
        const Vec3 second = std::cos(angle) * across + std::sin(angle) * along;
        frames.push_back(rounded(normal, second, cross(normal, second)));
    }
    return frames;
}

}  // namespace

TurnedBox TurnedBox::round(const mesh::LatticeMesh& mesh, std::span<const mesh::FaceIndex> faces,
                           const std::array<std::int32_t, 3>& origin, double step) {
    // A large patch shows its shape in a part of its triangles.
    const Patch sample{mesh, faces, origin, std::max<std::size_t>(1, faces.size() / 64)};
    TurnedBox box;
    double least = std::numeric_limits<double>::infinity();
    for (const Axes& axes : frames_for(sample)) {
        const double area = half_area(extents(sample, axes));
        if (!(area < least)) continue;
        least = area;
        box.axes = axes;
    }
    const Extents all = extents({mesh, faces, origin}, box.axes);
    for (std::size_t k = 0; k < 3; ++k) {
        box.low[k] = static_cast<std::int16_t>(std::floor(all[k].low / step - slack));
        box.high[k] = static_cast<std::int16_t>(std::ceil(all[k].high / step + slack));
    }
    return box;
}

}  // namespace octavo::query
