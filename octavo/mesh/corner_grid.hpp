// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/mesh/orient2d.hpp>

// Points of the plane in a uniform grid, asked for those near a triangle.
//
// The grid lies along the points' principal axes, so that points along any line get a row of cells, about one cell a
// point. A triangle is looked up row by row between its sides. Doubles only choose cells, with margins far wider than
// what they round: every point in the triangle is visited, and some beside it.

namespace octavo::mesh {

class CornerGrid {
  public:
    struct Entry {
        Point2 position;
        std::uint32_t node = 0;
    };

    /// Keeps its memory for the next time.
    void build(std::span<const Entry> entries);

    /// Calls `visit` with entries, all of those in the closed triangle among them, until it returns true; returns
    /// whether it did.
    template <class Visit>
    bool any_near(Point2 a, Point2 b, Point2 c, const Visit& visit) const {
        const Point2 low{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y})};
        const Point2 high{std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y})};
        const auto any_of = [&](std::uint32_t begin, std::uint32_t end) {
            for (std::uint32_t i = begin; i < end; ++i) {
                const Point2 p = entries_[i].position;
                if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y) continue;
                if (visit(entries_[i].node)) return true;
            }
            return false;
        };
        if (cell_begin_.empty()) return any_of(0, static_cast<std::uint32_t>(entries_.size()));
        const Turned triangle = turned(a, b, c);
        for (std::uint32_t row = triangle.first_row; row <= triangle.last_row; ++row) {
            const Columns columns = columns_of(triangle, row);
            if (columns.first > columns.last) continue;
            if (any_of(cell_begin_[row * columns_ + columns.first],
                       cell_begin_[row * columns_ + columns.last + 1]))
                return true;
        }
        return false;
    }

  private:
    struct Columns {
        std::uint32_t first, last;
    };
    /// A triangle in the axes of the grid.
    struct Turned {
        Point2 a, b, c;
        double rounding;  ///< more than any of these coordinates, or of entries', is off by
        std::uint32_t first_row, last_row;
        Columns columns;
    };

    void find_axes(std::span<const Entry> entries);
    Point2 turned(Point2 p) const {
        const double x = p.x - origin_.x, y = p.y - origin_.y;
        return {cosine_ * x + sine_ * y, cosine_ * y - sine_ * x};
    }
    Turned turned(Point2 a, Point2 b, Point2 c) const;
    Columns columns_of(const Turned& triangle, std::uint32_t row) const;
    std::uint32_t column(double x) const { return place((x - low_.x) * columns_per_x_, columns_); }
    std::uint32_t row(double y) const { return place((y - low_.y) * rows_per_y_, rows_); }
    static std::uint32_t place(double at, std::uint32_t count) {
        return at > 0 ? std::min(static_cast<std::uint32_t>(std::min(at, 1e9)), count - 1) : 0;
    }

    Point2 origin_;
    double cosine_ = 1, sine_ = 0;  ///< of the first axis
    Point2 low_, high_;             ///< of the entries, in these axes
    double columns_per_x_ = 0, rows_per_y_ = 0;
    std::uint32_t columns_ = 1, rows_ = 1;
    std::vector<std::uint32_t> cell_begin_;  ///< empty: there are too few entries for a grid
    std::vector<std::uint32_t> cell_of_;
    std::vector<Entry> entries_;  ///< by cell
};

}  // namespace octavo::mesh
