// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/csg/convex_overlap.hpp>

#include "unlimited.hpp"

namespace octavo::csg {
namespace {

using octavo::tests::Rational;
using Point = std::array<Rational, 3>;

struct RationalPlane {
    std::array<Rational, 3> n;
    Rational d;

    Rational at(const Point& p) const { return n[0] * p[0] + n[1] * p[1] + n[2] * p[2] + d; }
};

/// The oracle: the corners of the polytope are meets of three planes that satisfy all others; it has an interior
/// when the mean of its corners is strictly inside all planes.
bool has_interior(const octree::Cell& cell, const std::vector<LatticePlane>& planes) {
    std::vector<RationalPlane> all;
    for (int axis = 0; axis < 3; ++axis) {
        RationalPlane low{}, high{};
        low.n[static_cast<std::size_t>(axis)] = 1;
        low.d = -cell.low[axis];
        high.n[static_cast<std::size_t>(axis)] = -1;
        high.d = cell.high()[axis];
        all.push_back(low);
        all.push_back(high);
    }
    for (const LatticePlane& p : planes) all.push_back({{p.normal[0], p.normal[1], p.normal[2]}, p.offset});
    Point sum{0, 0, 0};
    int corners = 0;
    for (std::size_t i = 0; i < all.size(); ++i)
        for (std::size_t j = i + 1; j < all.size(); ++j)
            for (std::size_t k = j + 1; k < all.size(); ++k) {
                const auto &a = all[i].n, &b = all[j].n, &c = all[k].n;
                const std::array<Rational, 3> bc{b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2],
                                                 b[0] * c[1] - b[1] * c[0]};
                const Rational det = a[0] * bc[0] + a[1] * bc[1] + a[2] * bc[2];
                if (det == 0) continue;
                Point p;
                for (std::size_t x = 0; x < 3; ++x) {
                    const std::size_t y = (x + 1) % 3, z = (x + 2) % 3;
                    p[x] = -(all[i].d * bc[x] + all[j].d * (c[y] * a[z] - c[z] * a[y]) +
                             all[k].d * (a[y] * b[z] - a[z] * b[y])) /
                           det;
                }
                bool inside = true;
                for (const RationalPlane& plane : all) inside = inside && plane.at(p) >= 0;
                if (!inside) continue;
                for (std::size_t x = 0; x < 3; ++x) sum[x] += p[x];
                ++corners;
            }
    if (corners == 0) return false;
    for (Rational& s : sum) s /= corners;
    for (const RationalPlane& plane : all)
        if (plane.at(sum) <= 0) return false;
    return true;
}

class RandomPlanes {
  public:
    explicit RandomPlanes(std::uint64_t seed) : engine_(seed) {}
    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }

    octree::Cell cell() {
        const int level = 4 + below(14);
        const std::int32_t side = octree::cell_side(level);
        const auto at = [&] { return static_cast<std::int32_t>(engine_() % (1ULL << level)) * side; };
        return {{at(), at(), at()}, level};
    }
    /// Through the cell or near it; degenerate ones have small whole normals and go through grid points of the cell.
    LatticePlane plane(const octree::Cell& cell, bool degenerate) {
        const double side = cell.side();
        for (;;) {
            Vec3 normal, through;
            for (int axis = 0; axis < 3; ++axis) {
                normal[axis] = degenerate ? below(5) - 2 : uniform(-1, 1);
                through[axis] =
                    cell.low[axis] + (degenerate ? below(5) * side / 4 : uniform(-0.3, 1.3) * side);
            }
            if (normal == Vec3{}) continue;
            if (const SnappedPlane snapped = snap_plane(normal, through); snapped.plane)
                return *snapped.plane;
        }
    }

  private:
    std::mt19937_64 engine_;
};

TEST(ConvexOverlap, AgreesWithRationalArithmeticOnRandomPlanes) {
    RandomPlanes random(1);
    int unsure = 0, apart = 0, meets = 0;
    for (int round = 0; round < 300; ++round) {
        const octree::Cell cell = random.cell();
        std::vector<LatticePlane> planes;
        for (int i = 1 + random.below(6); i > 0; --i) planes.push_back(random.plane(cell, false));
        const Overlap answer = overlap(cell, planes);
        const bool expected = has_interior(cell, planes);
        if (answer == Overlap::unsure) ++unsure;
        apart += answer == Overlap::apart;
        meets += answer == Overlap::meets;
        if (answer == Overlap::apart) {
            EXPECT_FALSE(expected);
        }
        if (answer == Overlap::meets) {
            EXPECT_TRUE(expected);
        }
    }
    EXPECT_EQ(unsure, 0);
    EXPECT_GT(apart, 20);
    EXPECT_GT(meets, 20);
}

TEST(ConvexOverlap, IsNeverWrongOnDegeneratePlanes) {
    RandomPlanes random(2);
    int unsure = 0;
    for (int round = 0; round < 300; ++round) {
        const octree::Cell cell = random.cell();
        std::vector<LatticePlane> planes;
        for (int i = 1 + random.below(5); i > 0; --i) planes.push_back(random.plane(cell, true));
        if (random.below(3) == 0) planes.push_back(planes[0].flipped());
        const Overlap answer = overlap(cell, planes);
        const bool expected = has_interior(cell, planes);
        if (answer == Overlap::unsure) ++unsure;
        if (answer == Overlap::apart) {
            EXPECT_FALSE(expected);
        }
        if (answer == Overlap::meets) {
            EXPECT_TRUE(expected);
        }
    }
    EXPECT_LT(unsure, 30) << "touching is mostly recognised exactly";
}

TEST(ConvexOverlap, APlaneAndItsOppositeAreApart) {
    RandomPlanes random(3);
    for (int round = 0; round < 200; ++round) {
        const octree::Cell cell = random.cell();
        const LatticePlane plane = random.plane(cell, round % 2 == 0);
        const std::array<LatticePlane, 2> both{plane, plane.flipped()};
        EXPECT_EQ(overlap(cell, both), Overlap::apart);
    }
}

/// A ball of this centre and radius in lattice units.
SecondOrderCone ball(std::array<double, 3> centre, double radius) {
    SecondOrderCone cone;
    for (std::size_t i = 0; i < 3; ++i) {
        cone.origin[i] = std::nearbyint(centre[i]);
        cone.row[i][i] = 1 / radius;
        cone.row[i][3] = (cone.origin[i] - centre[i]) / radius;
    }
    cone.row[3][3] = 1;
    cone.finish();
    return cone;
}

TEST(ConvexOverlap, BallsAgainstCellsAndPlanes) {
    RandomPlanes random(4);
    int unsure = 0, checked = 0;
    for (int round = 0; round < 4000; ++round) {
        const octree::Cell cell = random.cell();
        const double side = cell.side();
        std::array<double, 3> centre;
        for (int a = 0; a < 3; ++a)
            centre[static_cast<std::size_t>(a)] = cell.low[a] + random.uniform(-2, 3) * side;
        const double radius = random.uniform(0.1, 2.5) * side;
        // The distance of the centre from the cell is that of a clamped point.
        long double square = 0;
        for (int a = 0; a < 3; ++a) {
            const double c = centre[static_cast<std::size_t>(a)];
            const double nearest =
                std::clamp(c, static_cast<double>(cell.low[a]), static_cast<double>(cell.high()[a]));
            square += static_cast<long double>(c - nearest) * (c - nearest);
        }
        const long double gap = std::sqrt(square) - radius;
        const SecondOrderCone cone = ball(centre, radius);
        const std::array<const SecondOrderCone*, 1> cones{&cone};
        const Overlap answer = overlap(cell, {}, cones);
        ++checked;
        if (answer == Overlap::unsure) ++unsure;
        if (answer == Overlap::apart) {
            EXPECT_GT(gap, -1e-9L * side);
        }
        if (answer == Overlap::meets) {
            EXPECT_LT(gap, 1e-9L * side);
        }
        if (std::fabs(static_cast<double>(gap)) > 1e-3 * side) {
            EXPECT_NE(answer, Overlap::unsure) << "gap " << static_cast<double>(gap) / side;
        }
    }
    EXPECT_LT(unsure, checked / 100);
}

}  // namespace
}  // namespace octavo::csg
