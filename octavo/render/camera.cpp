// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include <octavo/render/camera.hpp>

namespace octavo::render {
namespace {

constexpr double pi = 3.14159265358979323846;

/// What is wrong with the view; empty when nothing is.
std::string trouble_with(const View& view) {
    if (!(view.perspective >= 0 && view.perspective <= widest_view))
        return "the field of view must be 0 to 120 degrees, not " + std::to_string(view.perspective);
    if (!(std::fabs(view.elevation_degrees) <= 90))
        return "the elevation must be -90 to 90 degrees, not " + std::to_string(view.elevation_degrees);
    if (!std::isfinite(view.azimuth_degrees)) return "the azimuth must be finite";
    if (!(view.margin >= 0 && view.margin < 0.5))
        return "the margin must be 0 to less than 0.5, not " + std::to_string(view.margin);
    return {};
}

/// What values reach, from the least to the greatest.
struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    double middle() const { return 0.5 * (low + high); }
    double extent() const { return high - low; }
};

/// The power of two that brings the longest side to [1, 2), or as near as powers come that are doubles with an inverse;
/// 1 for a point.
double shrink_of(const Box3& bounds) {
    double half = 0;
    for (int axis = 0; axis < 3; ++axis)
        half = std::max(half, 0.5 * bounds.high[axis] - 0.5 * bounds.low[axis]);
    return half > 0 ? std::ldexp(1.0, std::clamp(-std::ilogb(half) - 1, -1000, 1000)) : 1;
}

}  // namespace

Result<Camera> Camera::look_at(std::span<const Vec3> points, const View& view, int width, int height) {
    if (std::string trouble = trouble_with(view); !trouble.empty())
        return Error{ErrorCode::bad_input, std::move(trouble), {}};
    Box3 bounds;
    for (const Vec3& point : points) bounds.add(point);
    if (bounds.empty() || !is_finite(bounds.low) || !is_finite(bounds.high))
        return Error{ErrorCode::bad_input, "there is nothing to look at", {}};

    const double azimuth = view.azimuth_degrees * pi / 180, elevation = view.elevation_degrees * pi / 180;
    Camera camera;
    camera.right_ = {std::cos(azimuth), std::sin(azimuth), 0};
    camera.forward_ = {-std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                       -std::sin(elevation)};
    camera.up_ = cross(camera.right_, camera.forward_);
    camera.target_ = 0.5 * bounds.low + 0.5 * bounds.high;
    camera.shrink_ = shrink_of(bounds);
    const Vec3 extents = camera.scaled(bounds.high) - camera.scaled(bounds.low);
    const double radius = extents == Vec3{} ? 1 : length(extents) / 2;
    // The bounds' sphere touches the field of view, so every point lies in front of the eye.
    if (view.perspective > 0) camera.distance_ = radius / std::sin(view.perspective * pi / 360);

    // Fit at a scale of one pixel a unit of depth about the target first; then scale and move the picture.
    Range across, along;
    for (const Vec3& point : points) {
        const Vec3 p = camera.project(point);
        across.add(p.x);
        along.add(p.y);
    }
    const double used = 1 - 2 * view.margin;
    camera.scale_ = std::min(width * used / std::max(across.extent(), radius * 1e-6),
                             height * used / std::max(along.extent(), radius * 1e-6));
    camera.centre_x_ = width / 2.0 - camera.scale_ * across.middle();
    camera.centre_y_ = height / 2.0 - camera.scale_ * along.middle();
    return camera;
}

Result<Camera> Camera::look_at(const Box3& bounds, const View& view, int width, int height) {
    std::array<Vec3, 8> corners;
    for (std::size_t corner = 0; corner < corners.size(); ++corner)
        corners[corner] = {corner & 1 ? bounds.high.x : bounds.low.x,
                           corner & 2 ? bounds.high.y : bounds.low.y,
                           corner & 4 ? bounds.high.z : bounds.low.z};
    return look_at(corners, view, width, height);
}

Vec3 Camera::project(Vec3 world) const {
    const Vec3 offset = scaled(world) - scaled(target_);
    const double depth = dot(offset, forward_);
    const double scale = scale_ / weight(depth);
    return {centre_x_ + scale * dot(offset, right_), centre_y_ - scale * dot(offset, up_), depth};
}

}  // namespace octavo::render
