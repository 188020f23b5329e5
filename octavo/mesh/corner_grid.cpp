// SPDX-License-Identifier: Apache-2.0
#include <octavo/mesh/corner_grid.hpp>

namespace octavo::mesh {
namespace {

// Below this many points, looking at all of them is faster than a grid.
constexpr std::size_t least_gridded = 24;

// Three times rounded by 2^-53 each; the rest is margin.
constexpr double rounding_of_one = 0x1p-46;

double largest(Point2 p) { return std::max(std::fabs(p.x), std::fabs(p.y)); }

}  // namespace

void CornerGrid::build(std::span<const Entry> entries) {
    cell_begin_.clear();
    entries_.assign(entries.begin(), entries.end());
    if (entries.size() < least_gridded) return;
    find_axes(entries);
    low_ = {INFINITY, INFINITY}, high_ = {-INFINITY, -INFINITY};
    for (const Entry& entry : entries) {
        const Point2 p = turned(entry.position);
        low_ = {std::min(low_.x, p.x), std::min(low_.y, p.y)};
        high_ = {std::max(high_.x, p.x), std::max(high_.y, p.y)};
    }
    const double width = high_.x - low_.x, height = high_.y - low_.y;
    const auto count = static_cast<double>(entries.size());
    columns_ = rows_ = 1;
    if (width > 0) {
        // Cells as square as may be.
        columns_ = static_cast<std::uint32_t>(
            std::clamp(height > 0 ? std::sqrt(count * (width / height)) : count, 1.0, count));
        rows_ = height > 0 ? static_cast<std::uint32_t>(std::max(1.0, count / columns_)) : 1;
    }
    columns_per_x_ = width > 0 ? columns_ / width : 0;
    rows_per_y_ = height > 0 ? rows_ / height : 0;

    cell_begin_.assign(std::size_t{columns_} * rows_ + 2, 0);
    cell_of_.clear();
    for (const Entry& entry : entries) {
        const Point2 p = turned(entry.position);
        cell_of_.push_back(row(p.y) * columns_ + column(p.x));
        ++cell_begin_[cell_of_.back() + 2];
    }
    for (std::size_t c = 2; c < cell_begin_.size(); ++c) cell_begin_[c] += cell_begin_[c - 1];
    for (std::size_t i = 0; i < entries.size(); ++i) entries_[cell_begin_[cell_of_[i] + 1]++] = entries[i];
    cell_begin_.pop_back();
}

/// The axes along which the entries spread most and least.
void CornerGrid::find_axes(std::span<const Entry> entries) {
    const auto count = static_cast<double>(entries.size());
    origin_ = entries.front().position;
    double xx = 0, xy = 0, yy = 0, sum_x = 0, sum_y = 0;
    for (const Entry& entry : entries) {
        const double x = entry.position.x - origin_.x, y = entry.position.y - origin_.y;
        sum_x += x, sum_y += y;
        xx += x * x, xy += x * y, yy += y * y;
    }
    const double angle = 0.5 * std::atan2(2 * (xy - sum_x * sum_y / count),
                                          (xx - sum_x * sum_x / count) - (yy - sum_y * sum_y / count));
    cosine_ = std::isfinite(angle) ? std::cos(angle) : 1;
    sine_ = std::isfinite(angle) ? std::sin(angle) : 0;
}

CornerGrid::Turned CornerGrid::turned(Point2 a, Point2 b, Point2 c) const {
    Turned t{turned(a), turned(b), turned(c), 0, 0, 0, {0, columns_ - 1}};
    t.rounding =
        rounding_of_one * std::max({largest(t.a), largest(t.b), largest(t.c), largest(low_), largest(high_)});
    t.first_row = row(std::min({t.a.y, t.b.y, t.c.y}) - t.rounding);
    t.last_row = row(std::max({t.a.y, t.b.y, t.c.y}) + t.rounding);
    t.columns = {column(std::min({t.a.x, t.b.x, t.c.x}) - t.rounding),
                 column(std::max({t.a.x, t.b.x, t.c.x}) + t.rounding)};
    return t;
}

/// Those that the triangle reaches within the row.
CornerGrid::Columns CornerGrid::columns_of(const Turned& t, std::uint32_t row) const {
    // Few cells are looked through sooner than cut down.
    if (t.columns.last - t.columns.first < 4) return t.columns;
    // A quarter of a row above and below: far more than what finding rows by a product rounds.
    const double step = rows_ > 1 ? 1 / rows_per_y_ : high_.y - low_.y;
    const double low = low_.y + (row - 0.25) * step - t.rounding,
                 high = low_.y + (row + 1.25) * step + t.rounding;
    double left = INFINITY, right = -INFINITY;
    const auto add = [&](double x) { left = std::min(left, x), right = std::max(right, x); };
    const auto add_side = [&](Point2 p, Point2 q) {
        if (p.y > q.y) std::swap(p, q);
        if (q.y < low || p.y > high) return;
        const auto x_at = [&](double y) { return p.x + (y - p.y) / (q.y - p.y) * (q.x - p.x); };
        add(p.y >= low ? p.x : x_at(low));
        add(q.y <= high ? q.x : x_at(high));
    };
    add_side(t.a, t.b), add_side(t.b, t.c), add_side(t.c, t.a);
    const double margin = t.rounding + 0.25 / columns_per_x_;
    return {std::max(t.columns.first, column(left - margin)),
            std::min(t.columns.last, column(right + margin))};
}

}  // namespace octavo::mesh
