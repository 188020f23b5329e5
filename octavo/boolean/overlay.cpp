// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <octavo/boolean/overlay.hpp>
#include <octavo/exact/plane.hpp>

namespace octavo::boolean {
namespace {

struct Seen {
    double x, y, height;  ///< along and above the other facet's plane
};

/// Cuts a convex polygon by the half-plane to the left of the line from a to b.
std::vector<Seen> cut(const std::vector<Seen>& polygon, const Seen& a, const Seen& b) {
    std::vector<Seen> left;
    const auto side = [&](const Seen& p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Seen &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const double at_p = side(p), at_q = side(q);
        if (at_p >= 0) left.push_back(p);
        if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
            const double t = at_p / (at_p - at_q);
            left.push_back(
                {p.x + t * (q.x - p.x), p.y + t * (q.y - p.y), p.height + t * (q.height - p.height)});
        }
    }
    return left;
}

}  // namespace

bool lie_on_each_other(const Soup& soup, std::uint32_t first, std::uint32_t second, double tolerance) {
    // Coordinates in the first facet: x along its first side, height along its normal.
    const mesh::Triangle &corner = soup.facets[first], &other = soup.facets[second];
    const exact::Point origin = soup.points[corner[0]];
    const exact::Plane plane = exact::Plane::through(origin, soup.points[corner[1]], soup.points[corner[2]]);
    const auto from_origin = [&](std::uint32_t vertex) {
        const exact::Point p = soup.points[vertex];
        return Vec3{static_cast<double>(p.x - origin.x), static_cast<double>(p.y - origin.y),
                    static_cast<double>(p.z - origin.z)};
    };
    Vec3 up{static_cast<double>(plane.a()), static_cast<double>(plane.b()), static_cast<double>(plane.c())};
    up = (1 / length(up)) * up;
    Vec3 x = from_origin(corner[1]);
    x = (1 / length(x)) * x;
    const Vec3 y = octavo::cross(up, x);
    const auto seen = [&](std::uint32_t vertex) {
        const Vec3 p = from_origin(vertex);
        return Seen{dot(p, x), dot(p, y), dot(p, up)};
    };
    std::vector<Seen> polygon{seen(other[0]), seen(other[1]), seen(other[2])};
    const Seen base[3] = {seen(corner[0]), seen(corner[1]), seen(corner[2])};
    for (int k = 0; k < 3 && !polygon.empty(); ++k) polygon = cut(polygon, base[k], base[(k + 1) % 3]);
    if (polygon.size() < 3) return false;
    double area2 = 0, longest = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Seen &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        if (std::fabs(p.height) > tolerance) return false;
        area2 += p.x * q.y - p.y * q.x;
        longest = std::max(longest, std::hypot(q.x - p.x, q.y - p.y));
    }
    // What overlaps by less than the tolerance only touches along an edge.
    return std::fabs(area2) > 2 * tolerance * longest;
}

}  // namespace octavo::boolean
