// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <octavo/exact/int128.hpp>
#include <octavo/hexmesh/plane_part.hpp>

namespace octavo::hexmesh {
namespace {

using classic::Normal;

// A 54-bit normal times a 27-bit difference, three of them, and three normals times the side.
static_assert(2 * exact::coordinate_bits + 2 + exact::coordinate_bits + 1 + 3 < 127);

/// The plane is normal · y = offset for y from the cell's low corner; behind it, normal · y < offset.
exact::int128 offset_of(const classic::Facet& facet, const Normal& normal, const octree::Cell& cell) {
    const auto from_low = [&](int axis) {
        return std::int64_t{facet.corner[0][static_cast<std::size_t>(axis)]} - cell.low[axis];
    };
    return exact::wide(normal.x) * from_low(0) + exact::wide(normal.y) * from_low(1) +
           exact::wide(normal.z) * from_low(2);
}

/// ∫∫ (c − a x − b y)₊ over the unit square, 0 ≤ a ≤ b.
double volume_below(double c, double a, double b) {
    const auto flat = [&](double from, double to) { return (from + to - b) / 2; };
    const auto curved = [&](double from, double to) { return (from * from + from * to + to * to) / (6 * b); };
    const double low = c - a;
    if (c <= 0) return 0;
    if (low >= b) return flat(low, c);
    if (low >= 0 && c <= b) return curved(low, c);
    // Now a > 0: the interval ends on different pieces.
    const double first = std::max(low, 0.0), last = std::min(c, b);
    double sum = (last - first) * curved(first, last);
    if (c > b) sum += (c - b) * flat(b, c);
    return sum / a;
}

}  // namespace

double part_behind(const classic::Facet& facet, const octree::Cell& cell) {
    const Normal normal = normal_of(facet);
    exact::int128 offset = offset_of(facet, normal, cell);
    std::array<double, 3> slope{};
    for (int axis = 0; axis < 3; ++axis) {
        if (normal[axis] < 0) offset -= exact::wide(normal[axis]) * cell.side();
        slope[static_cast<std::size_t>(axis)] = std::fabs(static_cast<double>(normal[axis]));
    }
    if (slope[0] > slope[1]) std::swap(slope[0], slope[1]);
    if (slope[1] > slope[2]) std::swap(slope[1], slope[2]);
    if (slope[0] > slope[1]) std::swap(slope[0], slope[1]);
    const double a = slope[0] / slope[2], b = slope[1] / slope[2];
    const double height = static_cast<double>(offset) / (slope[2] * static_cast<double>(cell.side()));
    return std::clamp(volume_below(height, a, b) - volume_below(height - 1, a, b), 0.0, 1.0);
}

bool is_low_corner_behind(const classic::Facet& facet, const octree::Cell& cell) {
    const Normal normal = normal_of(facet);
    const exact::int128 offset = offset_of(facet, normal, cell);
    if (offset != 0) return offset > 0;
    const std::int64_t first = normal.x != 0 ? normal.x : normal.y != 0 ? normal.y : normal.z;
    return first < 0;
}

}  // namespace octavo::hexmesh
