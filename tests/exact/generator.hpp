// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <random>
#include <string>

#include <octavo/exact/intersect.hpp>
#include <octavo/exact/plane.hpp>

#include "effort.hpp"

// Random and degenerate input for the oracle tests of exact/.

namespace octavo::exact::tests {

using octavo::tests::effort;

class Generator {
  public:
    explicit Generator(std::uint64_t seed) : engine_(seed) {}

    std::int64_t between(std::int64_t low, std::int64_t high) {
        return low + static_cast<std::int64_t>(engine_() % static_cast<std::uint64_t>(high - low + 1));
    }
    bool coin() { return engine_() & 1; }
    std::uint64_t word() { return engine_(); }

    /// Anywhere, at both ends of the range, or among few values, so that coincidences happen.
    std::int32_t coordinate() {
        switch (engine_() % 8) {
            case 0:
                return static_cast<std::int32_t>(between(0, 1));
            case 1:
                return static_cast<std::int32_t>(universe_side - 1 - between(0, 1));
            case 2:
                return static_cast<std::int32_t>(between(1000, 1003));
            default:
                return static_cast<std::int32_t>(between(0, universe_side - 1));
        }
    }
    Point point() { return {coordinate(), coordinate(), coordinate()}; }
    Point uniform_point() {
        const auto any = [this] { return static_cast<std::int32_t>(between(0, universe_side - 1)); };
        return {any(), any(), any()};
    }
    /// Within `radius` of p, in the universe.
    Point near(Point p, std::int32_t radius) {
        const auto shift = [&](std::int32_t value) {
            return static_cast<std::int32_t>(
                std::clamp<std::int64_t>(value + between(-radius, radius), 0, universe_side - 1));
        };
        return {shift(p.x), shift(p.y), shift(p.z)};
    }
    /// On the line through p and q as often as their difference allows, else near it: slivers.
    Point nearly_between(Point p, Point q) {
        const double t = static_cast<double>(between(0, 1 << 20)) / (1 << 20);
        const auto mix = [&](std::int32_t from, std::int32_t to) {
            return static_cast<std::int32_t>(from + t * (to - from));
        };
        return {mix(p.x, q.x), mix(p.y, q.y), mix(p.z, q.z)};
    }

    /// A plane that is not degenerate: through random points, through slivers, or any coefficients.
    Plane plane() {
        for (;;) {
            const Point p = point(), q = point();
            Plane result;
            switch (engine_() % 8) {
                case 0:
                    result = Plane::through(p, q, nearly_between(p, q));
                    break;
                case 1:
                    result = Plane::through(p, near(p, 3), near(p, 3));
                    break;
                case 2:
                    result = Plane::across_axis(static_cast<int>(engine_() % 3), p.x);
                    break;
                case 3:
                    result = Plane::along_axis(static_cast<int>(engine_() % 3), p, q);
                    break;
                case 4:
                    result =
                        Plane::from_coefficients(signed_bits(53), signed_bits(53), signed_bits(53), offset());
                    break;
                default:
                    result = Plane::through(p, q, point());
            }
            if (!result.degenerate()) return result;
        }
    }
    Plane uniform_plane() {
        for (;;) {
            const Plane result = Plane::through(uniform_point(), uniform_point(), uniform_point());
            if (!result.degenerate()) return result;
        }
    }

    /// Below 2^bits in magnitude, often at the limit.
    std::int64_t signed_bits(int bits) {
        const std::int64_t limit = (std::int64_t{1} << bits) - 1;
        const std::int64_t value = engine_() % 4 == 0 ? limit - between(0, 2) : between(0, limit);
        return coin() ? value : -value;
    }
    int128 offset() {
        constexpr int128 limit = (int128{1} << budget::offset) - 1;
        const auto any = static_cast<int128>((static_cast<uint128>(engine_()) << 64 | engine_()) >>
                                             (128 - budget::offset));
        const int128 value = engine_() % 4 == 0 ? limit - between(0, 2) : any;
        return coin() ? value : -value;
    }

  private:
    std::mt19937_64 engine_;
};

/// A point (p (m - k) + q k) / m on a lattice edge, and planes through it: the way to build coincidences of
/// points that are no lattice points, of any kinds.
struct Spot {
    Point p, q;
    std::int64_t k = 0, m = 1;

    static Spot random(Generator& random) {
        Spot spot;
        do {
            spot.p = random.point();
            spot.q = random.coin() ? random.point() : random.near(spot.p, 5);
        } while (spot.p == spot.q);
        spot.m = random.between(1, random.coin() ? 7 : 4000);
        spot.k = random.between(0, spot.m);
        return spot;
    }

    /// A plane through the spot that does not hold the edge; moved by `shift` / (m |n|), which for 1 is the
    /// least that integer coefficients allow.
    Plane plane(Generator& random, int shift = 0) const {
        for (;;) {
            const int bits = 53 - 12 - (random.coin() ? 0 : 20);
            const std::int64_t a = random.signed_bits(bits), b = random.signed_bits(bits),
                               c = random.signed_bits(bits);
            const auto along = [&](std::int32_t from, std::int32_t to) {
                return wide(from) * (m - k) + wide(to) * k;
            };
            if (wide(a) * (q.x - p.x) + wide(b) * (q.y - p.y) + wide(c) * (q.z - p.z) == 0) continue;
            const int128 d = -(a * along(p.x, q.x) + b * along(p.y, q.y) + c * along(p.z, q.z)) + shift;
            return Plane::from_coefficients(a * m, b * m, c * m, d);
        }
    }
};

}  // namespace octavo::exact::tests
