// SPDX-License-Identifier: Apache-2.0
#if defined(__GNUC__) && !defined(__clang__)
// See classify_constraint.cpp.
#pragma GCC optimize("no-math-errno")
#endif

#include <array>
#include <cmath>

#include <octavo/csg/point_samples.hpp>

namespace octavo::csg {
namespace {

constexpr std::size_t lanes = 28;  // 27 points and one to fill the vectors
using Lanes = std::array<double, lanes>;

constexpr Lanes steps_along(std::size_t stride) {
    Lanes steps{};
    for (std::size_t p = 0; p < 27; ++p) steps[p] = static_cast<double>(p / stride % 3);
    return steps;
}
constexpr std::array<Lanes, 3> steps{steps_along(1), steps_along(3), steps_along(9)};

/// For each octant the eight of the 27 points that are its corners.
constexpr std::array<std::uint32_t, 8> octant_corners = [] {
    std::array<std::uint32_t, 8> masks{};
    for (std::uint32_t octant = 0; octant < 8; ++octant)
        for (std::uint32_t corner = 0; corner < 8; ++corner) {
            const std::uint32_t i = (octant & 1) + (corner & 1), j = (octant >> 1 & 1) + (corner >> 1 & 1),
                                k = (octant >> 2 & 1) + (corner >> 2 & 1);
            masks[octant] |= std::uint32_t{1} << (i + 3 * j + 9 * k);
        }
    return masks;
}();

PointColors sample_box(const Leaf& leaf, const octree::Cell& cell) {
    constexpr std::array<std::uint32_t, 3> first_plane{0x1249249U, 0x01C0E07U, 0x00001FFU};  // points with step 0
    const std::int32_t half = cell.side() / 2;
    std::uint32_t inside = PointColors::all, outside = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const int stride = axis == 0 ? 1 : axis == 1 ? 3 : 9;
        for (int step = 0; step < 3; ++step) {
            const std::int32_t at = cell.low[axis] + step * half;
            const std::uint32_t points = first_plane[a] << (step * stride);
            if (at < leaf.low[a] || at > leaf.high[a]) outside |= points;
            if (at <= leaf.low[a] || at >= leaf.high[a]) inside &= ~points;
        }
    }
    return {outside, inside};
}

PointColors sample_leaf(const Program& program, std::span<const std::uint32_t> words, std::size_t at,
                        const octree::Cell& cell) {
    const std::uint32_t w = words[at];
    const Leaf& leaf = program.leaves[word::leaf(w)];
    PointColors points;
    if (leaf.kind == LeafKind::box) {
        points = sample_box(leaf, cell);
    } else if (leaf.kind == LeafKind::convex) {
        points.inside = PointColors::all;
        const std::span<const std::uint32_t> constraints =
            w & word::payload_bit ? words.subspan(at + 2, words[at + 1]) : program.constraints_of(leaf);
        for (const std::uint32_t id : constraints)
            points = intersect(points, ConstraintId::is_cone(id) ? sample(program.cones[ConstraintId::index(id)], cell)
                                                                 : sample(program.planes[id], cell));
    }
    return w & word::complement_bit ? complement(points) : points;
}

}  // namespace

PointColors neutral_points(std::uint32_t w) {
    const bool full = word::operation(w) == word::intersection ||
                      (word::operation(w) == word::symmetric_difference && (w & word::even_bit));
    return full ? PointColors{0, PointColors::all} : PointColors{PointColors::all, 0};
}

PointColors fold(std::uint32_t w, PointColors a, PointColors b) {
    switch (word::operation(w)) {
        case word::union_of: return unite(a, b);
        case word::intersection: return intersect(a, b);
        default: return symmetric_difference(a, b);
    }
}

PointColors sample(const LatticePlane& plane, const octree::Cell& cell) {
    const std::int64_t half = cell.side() / 2;
    const std::int64_t dx = plane.normal[0] * half, dy = plane.normal[1] * half, dz = plane.normal[2] * half;
    std::array<std::int64_t, lanes> value;
    std::int64_t z = plane.at(cell.low.x, cell.low.y, cell.low.z);
    for (std::size_t k = 0; k < 3; ++k, z += dz)
        for (std::size_t j = 0; j < 3; ++j) {
            const std::int64_t y = z + static_cast<std::int64_t>(j) * dy;
            for (std::size_t i = 0; i < 3; ++i) value[9 * k + 3 * j + i] = y + static_cast<std::int64_t>(i) * dx;
        }
    PointColors points;
    for (std::size_t p = 0; p < 27; ++p) {
        points.inside |= static_cast<std::uint32_t>(value[p] > 0) << p;
        points.outside |= static_cast<std::uint32_t>(value[p] < 0) << p;
    }
    return points;
}

PointColors sample(const SecondOrderCone& cone, const octree::Cell& cell) {
    const double half = 0.5 * cell.side();
    std::array<double, 3> d;
    double distance = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        d[a] = static_cast<double>(cell.low[axis]) - cone.origin[a];
        distance = std::fmax(distance, std::fabs(d[a]));
    }
    const double error = cone.error(distance + 2 * half);
    Lanes square{}, radius{};
    for (std::size_t r = 0; r < 4; ++r) {
        const double base = cone.value(r, d[0], d[1], d[2]);
        const double x = cone.row[r][0] * half, y = cone.row[r][1] * half, z = cone.row[r][2] * half;
        for (std::size_t p = 0; p < lanes; ++p) {
            const double u = base + (steps[0][p] * x + steps[1][p] * y + steps[2][p] * z);
            if (r < 3)
                square[p] += u * u;
            else
                radius[p] = u;
        }
    }
    PointColors points;
    Lanes excess;
    for (std::size_t p = 0; p < lanes; ++p) excess[p] = std::sqrt(square[p]) - radius[p];
    for (std::size_t p = 0; p < 27; ++p) {
        points.inside |= static_cast<std::uint32_t>(excess[p] < -error) << p;
        points.outside |= static_cast<std::uint32_t>(excess[p] > error) << p;
    }
    return points;
}

PointColors PointSampler::sample(const Program& program, std::span<const std::uint32_t> words,
                                 const octree::Cell& cell) {
    open_.clear();
    PointColors result;
    const auto hand_up = [&](PointColors points) {
        if (open_.empty())
            result = points;
        else
            open_.back().points = fold(open_.back().word, open_.back().points, points);
    };
    for (std::uint32_t at = 0; at < words.size();) {
        const std::uint32_t w = words[at];
        if (word::is_leaf(w)) {
            hand_up(sample_leaf(program, words, at, cell));
            at += word::size(words.data() + at);
        } else {
            if (word::operation(w) != word::skip)
                open_.push_back({w, at + (w & word::size_mask), neutral_points(w)});
            ++at;
        }
        while (!open_.empty() && open_.back().end == at) {
            const PointColors points = open_.back().points;
            open_.pop_back();
            hand_up(points);
        }
    }
    return result;
}

std::uint8_t octants_on_both_sides(PointColors points) {
    unsigned octants = 0;
    for (std::size_t i = 0; i < 8; ++i)
        octants |= static_cast<unsigned>((points.inside & octant_corners[i]) != 0 && (points.outside & octant_corners[i]) != 0)
                   << i;
    return static_cast<std::uint8_t>(octants);
}

}  // namespace octavo::csg
