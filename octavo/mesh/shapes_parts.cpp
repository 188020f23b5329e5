// SPDX-License-Identifier: Apache-2.0
// Parts that look like the real thing: a gear, a bearing housing, and a sponge that does not.
#include <array>
#include <cmath>
#include <numbers>

#include <octavo/base/check.hpp>
#include <octavo/mesh/rings.hpp>
#include <octavo/mesh/shapes.hpp>

namespace octavo::mesh {
namespace {

constexpr double pi = std::numbers::pi;

Point2D polar(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

/// The outline of a spur gear: for each tooth the root, the rising involute, the tip and the falling one.
Outline gear_outline(const GearOptions& options) {
    const double teeth = options.teeth;
    const double pitch_radius = options.module * teeth / 2;
    const double base_radius = pitch_radius * std::cos(pi / 9);  // 20° pressure angle
    const double tip_radius = pitch_radius + options.module;
    const double root_radius = pitch_radius - 1.25 * options.module;
    // Polar angle that an involute has turned through at a radius.
    const auto involute = [&](double radius) {
        if (radius <= base_radius) return 0.0;
        const double t = std::sqrt(radius * radius / (base_radius * base_radius) - 1);
        return t - std::atan(t);
    };
    const double half_tooth = pi / (2 * teeth) + involute(pitch_radius);  // at the base circle
    const double start_radius = std::max(base_radius, root_radius + 0.1 * options.module);
    Outline outline;
    for (std::uint32_t tooth = 0; tooth < options.teeth; ++tooth) {
        const double middle = 2 * pi * tooth / teeth;
        const auto flank_radius = [&](std::uint32_t i) {
            return start_radius + (tip_radius - start_radius) * i / (options.flank_points - 1);
        };
        outline.push_back(polar(root_radius, middle - half_tooth));
        for (std::uint32_t i = 0; i < options.flank_points; ++i)
            outline.push_back(polar(flank_radius(i), middle - half_tooth + involute(flank_radius(i))));
        for (std::uint32_t i = options.flank_points; i-- > 0;)
            outline.push_back(polar(flank_radius(i), middle + half_tooth - involute(flank_radius(i))));
        outline.push_back(polar(root_radius, middle + half_tooth));
    }
    return outline;
}

}  // namespace

Mesh gear(const GearOptions& options) {
    OCTAVO_CHECK(options.teeth >= 8 && options.module > 0 && options.flank_points >= 2,
                 "a gear needs 8 teeth, a positive module and 2 points a flank");
    const double root_radius = options.module * (options.teeth / 2.0 - 1.25);
    OCTAVO_CHECK(options.bore_radius > 0 && options.bore_radius < root_radius,
                 "the bore of a gear lies inside its root circle");
    std::vector<Outline> holes{circle(options.bore_radius, options.hole_segments)};
    const double web = root_radius - options.bore_radius;
    const double hole_circle = options.bore_radius + web / 2;
    for (std::uint32_t i = 0; i < options.lightening_holes; ++i) {
        const double room = hole_circle * std::sin(pi / options.lightening_holes);
        const double radius = options.lightening_holes > 1 ? std::min(0.3 * web, 0.7 * room) : 0.3 * web;
        holes.push_back(
            circle(radius, options.hole_segments, polar(hole_circle, 2 * pi * i / options.lightening_holes)));
    }
    return extrude(gear_outline(options), holes, options.thickness);
}

Mesh bearing_housing(const HousingOptions& options) {
    const HousingOptions& o = options;
    OCTAVO_CHECK(o.bore_radius < o.seat_radius && o.seat_radius < o.hub_radius - o.chamfer &&
                     o.hub_radius < o.bolt_circle - o.counterbore_radius &&
                     o.bolt_circle + o.counterbore_radius < o.flange_radius - o.chamfer &&
                     o.bolt_radius < o.counterbore_radius,
                 "the radii of a housing must leave walls between its features");
    OCTAVO_CHECK(o.counterbore_depth < o.flange_height && o.seat_depth < o.hub_height &&
                     o.flange_height + o.chamfer < o.hub_height && o.chamfer < o.flange_height,
                 "the heights of a housing must leave floors between its features");
    RingBuilder b;
    const auto large = [&](double radius, double z) { return b.add_ring(circle(radius, o.segments), z); };

    // Outside, from the bottom up: flange with a chamfer, then the hub with one.
    const Ring flange_bottom = large(o.flange_radius, 0);
    const Ring flange_side = large(o.flange_radius, o.flange_height - o.chamfer);
    const Ring flange_top = large(o.flange_radius - o.chamfer, o.flange_height);
    const Ring hub_bottom = large(o.hub_radius, o.flange_height);
    const Ring hub_side = large(o.hub_radius, o.hub_height - o.chamfer);
    const Ring hub_top = large(o.hub_radius - o.chamfer, o.hub_height);
    b.add_wall(flange_bottom, flange_side);
    b.add_wall(flange_side, flange_top);
    b.add_wall(hub_bottom, hub_side);
    b.add_wall(hub_side, hub_top);

    // Inside, from the top down: the bearing's seat, its shoulder, the bore.
    const Ring seat_top = large(o.seat_radius, o.hub_height);
    const Ring seat_bottom = large(o.seat_radius, o.hub_height - o.seat_depth);
    const Ring bore_top = large(o.bore_radius, o.hub_height - o.seat_depth);
    const Ring bore_bottom = large(o.bore_radius, 0);
    b.add_ceiling(hub_top, std::array{seat_top});
    b.add_wall(seat_top, seat_bottom);
    b.add_ceiling(seat_bottom, std::array{bore_top});
    b.add_wall(bore_top, bore_bottom);

    std::vector<Ring> in_floor{bore_bottom}, in_flange{hub_bottom};
    for (std::uint32_t i = 0; i < o.bolts; ++i) {
        const Point2D centre = polar(o.bolt_circle, 2 * pi * i / o.bolts);
        const auto small = [&](double radius, double z) {
            return b.add_ring(circle(radius, o.bolt_segments, centre), z);
        };
        const Ring wide_top = small(o.counterbore_radius, o.flange_height);
        const Ring wide_bottom = small(o.counterbore_radius, o.flange_height - o.counterbore_depth);
        const Ring narrow_top = small(o.bolt_radius, o.flange_height - o.counterbore_depth);
        const Ring narrow_bottom = small(o.bolt_radius, 0);
        b.add_wall(wide_top, wide_bottom);
        b.add_ceiling(wide_bottom, std::array{narrow_top});
        b.add_wall(narrow_top, narrow_bottom);
        in_flange.push_back(wide_top);
        in_floor.push_back(narrow_bottom);
    }
    b.add_ceiling(flange_top, in_flange);
    b.add_floor(flange_bottom, in_floor);
    return b.take();
}

Mesh menger_sponge(std::uint32_t level) {
    OCTAVO_CHECK(level <= 5, "a sponge of more than 5 levels does not fit in memory");
    std::uint32_t side = 1;
    for (std::uint32_t i = 0; i < level; ++i) side *= 3;
    const auto solid = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
        if (x < 0 || y < 0 || z < 0 || x >= side || y >= side || z >= side) return false;
        for (std::uint32_t i = 0; i < level; ++i, x /= 3, y /= 3, z /= 3)
            if ((x % 3 == 1) + (y % 3 == 1) + (z % 3 == 1) >= 2) return false;
        return true;
    };
    Mesh mesh;
    const std::uint64_t points = side + 1;
    std::vector<VertexIndex> number(points * points * points, ~VertexIndex{0});
    const auto vertex = [&](std::array<std::int64_t, 3> p) {
        VertexIndex& index =
            number[(static_cast<std::uint64_t>(p[0]) * points + static_cast<std::uint64_t>(p[1])) * points +
                   static_cast<std::uint64_t>(p[2])];
        if (index == ~VertexIndex{0}) {
            index = static_cast<VertexIndex>(mesh.vertices.size());
            const double unit = 1.0 / side;
            mesh.vertices.push_back({static_cast<double>(p[0]) * unit, static_cast<double>(p[1]) * unit,
                                     static_cast<double>(p[2]) * unit});
        }
        return index;
    };
    for (std::int64_t x = 0; x < side; ++x)
        for (std::int64_t y = 0; y < side; ++y)
            for (std::int64_t z = 0; z < side; ++z) {
                if (!solid(x, y, z)) continue;
                for (int axis = 0; axis < 3; ++axis)
                    for (const int direction : {0, 1}) {
                        std::array<std::int64_t, 3> next{x, y, z};
                        next[static_cast<std::size_t>(axis)] += direction ? 1 : -1;
                        if (solid(next[0], next[1], next[2])) continue;
                        // The four corners of the wall, counter-clockwise seen from outside.
                        std::array<VertexIndex, 4> corner{};
                        for (std::size_t k = 0; k < 4; ++k) {
                            const std::int64_t u = k == 1 || k == 2, v = k >= 2;
                            std::array<std::int64_t, 3> p{x, y, z};
                            p[static_cast<std::size_t>(axis)] += direction;
                            p[static_cast<std::size_t>((axis + 1) % 3)] += direction ? u : v;
                            p[static_cast<std::size_t>((axis + 2) % 3)] += direction ? v : u;
                            corner[k] = vertex(p);
                        }
                        mesh.triangles.push_back({corner[0], corner[1], corner[2]});
                        mesh.triangles.push_back({corner[0], corner[2], corner[3]});
                    }
            }
    return mesh;
}

}  // namespace octavo::mesh
