// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/vec3.hpp>

// Flat regions: polygons with holes in the plane, the profiles of extrusions.
//
// A region is a list of contours, outer ones counter-clockwise and holes clockwise; a point is inside when they
// wind about it a positive number of times. Set operations and offsets are Clipper's (A. Johnson, after B. Vatti,
// A generic solution to polygon clipping, 1992), on integers.
//
// What is exact: the contours are doubles. Each operation scales them by a power of two so that the largest
// coordinate has 40 bits, rounds once, and works on integers; crossing points are rounded to that grid. So one
// operation moves a vertex by at most 2^-40 of the region's size, far below the lattice that solids are put on.
// Coordinates that already lie on the grid, such as short decimals' common case of multiples of 1/1024, stay.

namespace octavo::csg {

struct Vec2 {
    double x = 0, y = 0;
    friend bool operator==(const Vec2&, const Vec2&) = default;
};

using Contour = std::vector<Vec2>;

struct Region {
    std::vector<Contour> contours;

    bool empty() const { return contours.empty(); }
};

/// Twice nothing is nothing: contours of fewer than three corners are dropped. `even_odd`: a point is inside when
/// it lies in an odd number of contours, whatever their direction; otherwise when they wind about it at all.
enum class FillRule : std::uint8_t { even_odd, non_zero };
Region make_region(const std::vector<Contour>& contours, FillRule rule);

Region unite(std::span<const Region> regions);
Region intersect(std::span<const Region> regions);
/// The first without all others.
Region subtract(std::span<const Region> regions);

struct OffsetOptions {
    enum class Join : std::uint8_t { round, miter, chamfer } join = Join::round;
    /// Of round joins: corners of a full circle.
    int segments = 32;
};
/// Points within `distance` of the region; inwards when it is negative.
Region offset(const Region& region, double distance, const OffsetOptions& options = {});

/// The convex hull of points; empty when they lie on a line.
Region convex_hull(std::vector<Vec2> points);

/// The sums of a point of `a` and one of `b`.
Region minkowski_sum(const Region& a, const Region& b);

/// By the x and y rows and columns of the map.
Region transform(const Affine& map, const Region& region);

double area(const Region& region);
/// With z = 0.
Box3 bounds(const Region& region);

}  // namespace octavo::csg
