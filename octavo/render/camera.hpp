// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include <octavo/base/result.hpp>
#include <octavo/base/vec3.hpp>

// Where the viewer stands. A camera maps the world to the picture: x to the right and y down in pixels, depth away
// from the viewer. What is looked at fills the picture up to the margin, whatever the direction: the camera fits the
// points themselves, not their box, whose empty corners would push them aside.
//
// Depths are in world units times a power of two that makes what is looked at about one across: so pictures are the
// same bit for bit at any scale, where squares of lengths and depths in single precision would overflow or vanish.

namespace octavo::render {

struct View {
    double azimuth_degrees = 35;    ///< 0 looks along +y, from in front; positive walks to the right
    double elevation_degrees = 25;  ///< 90 looks straight down; must lie in [-90, 90]
    double perspective = 0;         ///< field of view in degrees, at most `widest_view`; 0 is orthographic
    double margin = 0.04;           ///< share of the picture left free on each side
};

/// Wider views show little but the corners of the picture.
constexpr double widest_view = 120;

class Camera {
  public:
    /// A camera that has all of `points` in a picture of this size, in pixels. Errors: bad_input when there are none,
    /// one is not finite, or the view is outside its limits.
    static Result<Camera> look_at(std::span<const Vec3> points, const View& view, int width, int height);

    /// The same for the corners of a box.
    static Result<Camera> look_at(const Box3& bounds, const View& view, int width, int height);

    /// x and y in pixels, z the depth: larger is farther.
    Vec3 project(Vec3 world) const;
    /// What a way through the world is in depths.
    Vec3 scaled(Vec3 way) const { return shrink_ * way; }

    bool is_perspective() const { return distance_ > 0; }
    /// Where the viewer stands; only in perspective, where everything looked at lies before it.
    Vec3 eye() const { return target_ - distance_ / shrink_ * forward_; }
    /// What the picture's coordinates of a point at this depth were divided by; 1 when orthographic. Where a point is
    /// on the way between two others, weighted so, is the same in the world and in the picture.
    double weight(double depth) const { return distance_ > 0 ? (distance_ + depth) / distance_ : 1; }

    Vec3 right() const { return right_; }
    Vec3 up() const { return up_; }
    /// The unit direction from the viewer into the picture at its centre.
    Vec3 forward() const { return forward_; }

  private:
    Vec3 right_, up_, forward_;
    Vec3 target_;
    double shrink_ = 1;                   // the power of two for depths
    double scale_ = 1;                    // pixels per unit of depth, at the target's
    double distance_ = 0;                 // of the eye from the target, in depths; 0 is orthographic
    double centre_x_ = 0, centre_y_ = 0;  // of the target, in pixels
};

}  // namespace octavo::render
