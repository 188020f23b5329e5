// SPDX-License-Identifier: Apache-2.0
#include <octavo/render/flat_scene.hpp>

namespace octavo::render {
namespace {

/// How far behind a plane a line is before the plane can hide it, in units of the lattice: ends of lines and corners of
/// faces were rounded to it, by less than one unit each, and lines lie in faces that they are no edges of.
constexpr double units_behind = 4;

/// Patches that cover less than this are seen edge-on, in square pixels.
constexpr double least_area = 1e-9;

}  // namespace

FlatScene::FlatScene(const Patches& patches, std::span<const WorldLine> lines, const Camera& camera)
    : tolerance_(units_behind * patches.unit) {
    patches_.reserve(patches.patches.size());
    edges_.reserve(patches.corners.size());
    for (const Patch& patch : patches.patches) add(patch, patches.corners_of(patch), camera);
    lines_.reserve(lines.size());
    for (const WorldLine& line : lines) {
        const Vec3 start = camera.project(line.from), end = camera.project(line.to);
        lines_.push_back({{start.x, start.y},
                          {end.x, end.y},
                          camera.weight(start.z),
                          camera.weight(end.z),
                          line.from,
                          line.to});
    }
}

void FlatScene::add(const Patch& patch, std::span<const Vec3> corners, const Camera& camera) {
    FlatPatch flat{static_cast<std::uint32_t>(edges_.size()), 0, {}, corners[0], patch.normal};
    ring_.clear();
    for (const Vec3& corner : corners) {
        const Vec3 p = camera.project(corner);
        ring_.push_back({p.x, p.y});
    }
    const double area = twice_area(ring_);
    if (!(std::fabs(area) > 2 * least_area)) {
        patches_.push_back(flat);
        return;
    }
    flat.bounds = {ring_[0], ring_[0]};
    for (std::size_t i = 0; i < ring_.size(); ++i) {
        const Point2 p = ring_[i], q = ring_[i + 1 == ring_.size() ? 0 : i + 1];
        flat.bounds.low = {std::min(flat.bounds.low.x, p.x), std::min(flat.bounds.low.y, p.y)};
        flat.bounds.high = {std::max(flat.bounds.high.x, p.x), std::max(flat.bounds.high.y, p.y)};
        if (p == q) continue;
        const Line2 edge = Line2::through(p, q);
        edges_.push_back(area > 0 ? edge : edge.reversed());
    }
    flat.count = static_cast<std::uint32_t>(edges_.size()) - flat.begin;
    patches_.push_back(flat);
}

bool FlatScene::touches(const FlatPatch& patch, const Rect& rect) const {
    if (patch.count == 0 || !patch.bounds.touches(rect)) return false;
    for (const Line2& edge : edges(patch)) {
        const Point2 innermost{edge.nx > 0 ? rect.high.x : rect.low.x,
                               edge.ny > 0 ? rect.high.y : rect.low.y};
        if (edge(innermost) < -on_line) return false;
    }
    return true;
}

bool FlatScene::covers(const FlatPatch& patch, const Rect& rect) const {
    for (const Line2& edge : edges(patch)) {
        const Point2 outermost{edge.nx > 0 ? rect.low.x : rect.high.x,
                               edge.ny > 0 ? rect.low.y : rect.high.y};
        if (edge(outermost) < -on_line) return false;
    }
    return patch.count > 0;
}

Stretch FlatScene::within(const FlatLine& line, const Rect& rect) const {
    Stretch stretch;
    stretch.keep(line.start.x - rect.low.x, line.end.x - rect.low.x);
    stretch.keep(rect.high.x - line.start.x, rect.high.x - line.end.x);
    stretch.keep(line.start.y - rect.low.y, line.end.y - rect.low.y);
    stretch.keep(rect.high.y - line.start.y, rect.high.y - line.end.y);
    return stretch;
}

Stretch FlatScene::hidden(const FlatLine& line, Stretch stretch, const FlatPatch& patch) const {
    // Distances change evenly in the world; times the weights, they do in the picture.
    const double at_start = dot(patch.normal, line.from - patch.base) + tolerance_;
    const double at_end = dot(patch.normal, line.to - patch.base) + tolerance_;
    stretch.keep(-at_start / line.start_weight, -at_end / line.end_weight);
    // A line along the border of a patch, or along the common border of two, counts as inside.
    for (const Line2& edge : edges(patch)) {
        if (stretch.empty()) break;
        stretch.keep(edge(line.start) + 1e-6, edge(line.end) + 1e-6);
    }
    return stretch;
}

}  // namespace octavo::render
