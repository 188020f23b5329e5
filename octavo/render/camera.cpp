// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/render/camera.hpp>

namespace octavo::render {
namespace {

constexpr double pi = 3.14159265358979323846;

bool within_limits(const View& view) {
    return view.perspective >= 0 && view.perspective < 120 && std::fabs(view.elevation_degrees) <= 90 &&
           std::isfinite(view.azimuth_degrees) && view.margin >= 0 && view.margin < 0.5;
}

}  // namespace

Result<Camera> Camera::look_at(const Box3& bounds, const View& view, int width, int height) {
    if (bounds.empty() || !is_finite(bounds.low) || !is_finite(bounds.high))
        return Error{ErrorCode::bad_input, "there is nothing to look at", {}};
    if (!within_limits(view)) return Error{ErrorCode::bad_input, "the view is outside its limits", {}};

    const double azimuth = view.azimuth_degrees * pi / 180, elevation = view.elevation_degrees * pi / 180;
    Camera camera;
    camera.right_ = {std::cos(azimuth), std::sin(azimuth), 0};
    camera.forward_ = {-std::sin(azimuth) * std::cos(elevation), std::cos(azimuth) * std::cos(elevation),
                       -std::sin(elevation)};
    camera.up_ = cross(camera.right_, camera.forward_);
    camera.target_ = 0.5 * (bounds.low + bounds.high);
    camera.centre_x_ = width / 2.0;
    camera.centre_y_ = height / 2.0;
    const double radius = std::max(length(bounds.extents()) / 2, 1e-300);
    // The bounds' sphere touches the field of view, so every corner lies in front of the eye.
    if (view.perspective > 0) camera.distance_ = radius / std::sin(view.perspective * pi / 360);

    double across = radius * 1e-6,
           along = radius * 1e-6;  // what the corners reach, right and up, before scaling
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3 p{corner & 1 ? bounds.high.x : bounds.low.x, corner & 2 ? bounds.high.y : bounds.low.y,
                     corner & 4 ? bounds.high.z : bounds.low.z};
        const Vec3 offset = p - camera.target_;
        const double depth = dot(offset, camera.forward_);
        const double shrink = camera.distance_ > 0 ? camera.distance_ / (camera.distance_ + depth) : 1;
        across = std::max(across, std::fabs(dot(offset, camera.right_)) * shrink);
        along = std::max(along, std::fabs(dot(offset, camera.up_)) * shrink);
    }
    const double used = 0.5 - view.margin;
    camera.scale_ = std::min(width * used / across, height * used / along);
    return camera;
}

Vec3 Camera::project(Vec3 world) const {
    const Vec3 offset = world - target_;
    const double depth = dot(offset, forward_);
    const double scale = distance_ > 0 ? scale_ * distance_ / (distance_ + depth) : scale_;
    return {centre_x_ + scale * dot(offset, right_), centre_y_ - scale * dot(offset, up_), depth};
}

}  // namespace octavo::render
