// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/render/visible.hpp>

// Patches and lines projected to the picture, with what the removal of hidden parts asks of them over and over.

namespace octavo::render {

/// A rectangle of the picture, both ends inclusive.
struct Rect {
    Point2 low, high;

    bool touches(const Rect& other) const {
        return low.x <= other.high.x && other.low.x <= high.x && low.y <= other.high.y &&
               other.low.y <= high.y;
    }
    std::vector<Point2> corners() const { return {low, {high.x, low.y}, high, {low.x, high.y}}; }
};

/// A stretch of a line, in shares of its way.
struct Stretch {
    double from = 0, to = 1;
    bool empty() const { return !(from < to); }

    /// Keeps where a value that changes evenly from `at_start` to `at_end` is not negative.
    void keep(double at_start, double at_end) {
        if (at_start < 0 && at_end < 0) to = from;
        if ((at_start < 0) == (at_end < 0)) return;
        const double zero = at_start / (at_start - at_end);
        if (at_start < 0)
            from = std::max(from, zero);
        else
            to = std::min(to, zero);
    }
};

struct FlatPatch {
    std::uint32_t begin = 0, count = 0;  ///< edges
    Rect bounds;
    Vec3 base, normal;  ///< of the plane, in the world; the viewer is on its positive side
};

struct FlatLine {
    Point2 start, end;
    double start_weight = 1, end_weight = 1;
    Vec3 from, to;  ///< in the world
};

class FlatScene {
  public:
    FlatScene(const Patches& patches, std::span<const WorldLine> lines, const Camera& camera);

    std::span<const FlatPatch> patches() const { return patches_; }
    std::span<const FlatLine> lines() const { return lines_; }
    /// Positive inside.
    std::span<const Line2> edges(const FlatPatch& patch) const {
        return {edges_.data() + patch.begin, patch.count};
    }

    bool touches(const FlatPatch& patch, const Rect& rect) const;
    bool covers(const FlatPatch& patch, const Rect& rect) const;
    /// What of the line lies in the rectangle.
    Stretch within(const FlatLine& line, const Rect& rect) const;
    /// What of a stretch of the line the patch hides.
    Stretch hidden(const FlatLine& line, Stretch stretch, const FlatPatch& patch) const;

  private:
    void add(const Patch& patch, std::span<const Vec3> corners, const Camera& camera);

    std::vector<FlatPatch> patches_;  ///< as given; those without area have no edges
    std::vector<FlatLine> lines_;
    std::vector<Line2> edges_;
    std::vector<Point2> ring_;
    double tolerance_ = 0;
};

}  // namespace octavo::render
