// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/result.hpp>
#include <octavo/csg/region.hpp>
#include <octavo/csg/tessellate.hpp>
#include <octavo/mesh/mesh.hpp>

// Solids swept by a flat region, as closed triangle meshes; corner counts and the way quads are split are
// OpenSCAD's, so that volumes agree with it to the last printed digit.

namespace octavo::csg {

/// Sine and cosine of an angle in degrees, exact at multiples of 30 and 45 degrees as far as a double can be, so
/// that symmetric solids stay symmetric.
double sin_degrees(double degrees);
double cos_degrees(double degrees);

struct LinearExtrude {
    double height = 1;
    bool centered = false;
    double twist = 0;  ///< degrees over the height, clockwise seen from above
    int slices = 1;
    Vec2 scale{1, 1};  ///< of the upper end; zero gives a point or a ridge
};
/// Empty when the height or the region is.
mesh::Mesh linear_extrude(const Region& region, const LinearExtrude& options);

/// The slices that OpenSCAD 2021.01 takes when none are asked for: by the twist, and by the length of the curve that
/// the farthest corner runs through.
int slices_of(const Region& region, const LinearExtrude& options, const Roundness& roundness);

struct RotateExtrude {
    double angle = 360;  ///< degrees, counter-clockwise; 360 closes the ring
    int segments = 30;   ///< of the angle
};
/// About the z axis; the region's x becomes the radius and y the height. Errors: bad_input when the region lies on
/// both sides of x = 0.
Result<mesh::Mesh> rotate_extrude(const Region& region, const RotateExtrude& options);

}  // namespace octavo::csg
