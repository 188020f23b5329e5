// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <variant>

#include <gmpxx.h>
#include <gtest/gtest.h>

#include <octavo/csg/program.hpp>

namespace octavo::csg {
namespace {

Affine diagonal(double x, double y, double z) { return {{{{x, 0, 0, 0}, {0, y, 0, 0}, {0, 0, z, 0}}}}; }

const Affine turn{{{{0.36, 0.48, -0.8, 0}, {-0.8, 0.6, 0, 0}, {0.48, 0.64, 0.6, 0}}}};

Program compile_or_die(const Expr& expression, const CompileOptions& options = {}) {
    Result<Program> program = compile(expression, options);
    EXPECT_TRUE(program) << program.error().describe();
    return std::move(*program);
}

/// The corners of the image of the unit cube, in lattice coordinates.
std::array<std::array<mpq_class, 3>, 8> corners_of(const Affine& map, const exact::Lattice& lattice) {
    std::array<std::array<mpq_class, 3>, 8> corners;
    for (unsigned k = 0; k < 8; ++k)
        for (std::size_t r = 0; r < 3; ++r) {
            mpq_class at(map.m[r][3]);
            for (std::size_t c = 0; c < 3; ++c)
                if (k >> c & 1) at += mpq_class(map.m[r][c]);
            corners[k][r] =
                at / mpq_class(lattice.unit()) - mpq_class(static_cast<long>(lattice.origin()[r]));
        }
    return corners;
}

/// How far, at most, the four corners of the side that is nearest to a plane are from it, in lattice units.
double distance_of_side(const LatticePlane& plane, const std::array<std::array<mpq_class, 3>, 8>& corners) {
    double length = 0;
    for (const std::int64_t component : plane.normal)
        length = std::hypot(length, static_cast<double>(component));
    double nearest = HUGE_VAL;
    for (unsigned side = 0; side < 6; ++side) {
        double farthest = 0;
        for (unsigned k = 0; k < 8; ++k) {
            if ((k >> side / 2 & 1) != side % 2) continue;
            mpq_class value(static_cast<long>(plane.offset));
            for (std::size_t r = 0; r < 3; ++r)
                value += mpq_class(static_cast<long>(plane.normal[r])) * corners[k][r];
            farthest = std::max(farthest, std::fabs(value.get_d()) / length);
        }
        nearest = std::min(nearest, farthest);
    }
    return nearest;
}

TEST(Compile, SidesOfShearedBoxesAreMovedByLessThanA64thOfAUnit) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto vector = [&] { return Vec3{uniform(random), uniform(random), uniform(random)}; };
    int planes = 0;
    for (int round = 0; round < 900; ++round) {
        // Two edges that enclose an angle of 2^-40 even.
        const Vec3 first = vector(), second = first + std::ldexp(1, -(round % 41)) * vector(),
                   third = vector();
        Affine map;
        for (int r = 0; r < 3; ++r)
            map.m[static_cast<std::size_t>(r)] = {first[r], second[r], third[r], uniform(random)};
        if (is_singular(map)) continue;
        const Program program = compile_or_die(transform(map, Expr(Cuboid{{0, 0, 0}, {1, 1, 1}})));
        if (program.leaves.empty()) continue;  // thinner than the lattice tells
        const auto corners = corners_of(map, program.lattice);
        for (const std::uint32_t id : program.constraints_of(program.leaves[0])) {
            EXPECT_LT(distance_of_side(program.planes[id], corners), 1.0 / 64) << round;
            ++planes;
        }
    }
    EXPECT_GT(planes, 3000);
}

TEST(Compile, HalfSpacesMayHaveNormalsAndOffsetsOfAnySize) {
    CompileOptions options;
    options.universe = Box3{{-1, -1, -1}, {1, 1, 1}};
    const auto half_space = [&](double size, double offset, double scale) {
        const HalfSpace plain{{0.3 * size, 0.2 * size, size}, offset};
        return compile_or_die(transform(diagonal(scale, scale, scale), Expr(plain)), options);
    };
    const Program plain = half_space(1, 0.25, 1);
    ASSERT_EQ(plain.planes.size(), 1u);
    for (const double size : {0x1p-1000, 0x1p-600, 0x1p600, 0x1p1000}) {
        EXPECT_EQ(half_space(size, 0.25 * size, 1).planes, plain.planes) << size;
        EXPECT_EQ(half_space(1, 0.25 * size, 1 / size).planes, plain.planes) << size;
        EXPECT_EQ(half_space(size, 0.25, size).planes, plain.planes) << size;
    }
    // A plane that is near, although the point of it that was nearest to the origin is not.
    const HalfSpace slanted{{1, 1, 0}, 0x1p40};
    const Program near = compile_or_die(transform(diagonal(0x1p1000, 0x1p-40, 1), Expr(slanted)), options);
    ASSERT_EQ(near.planes.size(), 1u);
    EXPECT_EQ(near.planes[0].normal, (std::array<std::int64_t, 3>{0, -(std::int64_t{1} << 34), 0}));
    // Planes farther off than doubles reach.
    for (const double size : {1.0, 1e-150, 1e-300}) {
        EXPECT_TRUE(half_space(size, 1e300, 1).constant) << size;
        EXPECT_TRUE(half_space(size, -1e300, 1).leaves.empty()) << size;
        EXPECT_FALSE(half_space(size, -1e300, 1).constant) << size;
    }
}

TEST(Compile, BodiesBeyondTheRangeOfDoublesAreRefused) {
    CompileOptions options;
    options.universe = Box3{{-1, -1, -1}, {1, 1, 1}};
    const Vec3 far{1e308, 1e308, 1e308};
    const mesh::Mesh tetrahedron{{far, -far, {1e308, -1e308, 0}, {-1e308, 0, 1e308}},
                                 {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}},
                                 {}};
    const auto mesh = std::make_shared<const mesh::Mesh>(tetrahedron);
    for (const Primitive& primitive :
         {Primitive(Cuboid{-far, far}), Primitive(Ball{1e308}),
          Primitive(Frustum{-1e308, 1e308, 1e308, 1e308}), Primitive(Torus{1e308, 1e307}),
          Primitive(Polyhedron{mesh, Convexity::convex}), Primitive(Polyhedron{mesh, Convexity::any})}) {
        const Result<Program> program =
            compile(transform(compose(turn, diagonal(10, 10, 10)), Expr(primitive)), options);
        ASSERT_FALSE(program) << primitive.index();
        EXPECT_EQ(program.error().code, ErrorCode::limit) << primitive.index();
    }
}

TEST(Compile, RoundBodiesTooThinForDoublesAreNothing) {
    for (const Primitive& primitive : {Primitive(Ball{}), Primitive(Frustum{}), Primitive(Torus{})}) {
        for (const double thickness : {1e-90, 1e-160, 1e-200, 1e-310}) {
            const Program program =
                compile_or_die(transform(turn, transform(diagonal(thickness, 1, 1), Expr(primitive))));
            EXPECT_TRUE(program.words.empty()) << primitive.index() << ' ' << thickness;
            EXPECT_FALSE(program.constant) << primitive.index() << ' ' << thickness;
        }
        const Program program =
            compile_or_die(transform(turn, transform(diagonal(1e-4, 1, 1), Expr(primitive))));
        EXPECT_EQ(program.leaves.size(), 1u) << primitive.index();
    }
}

}  // namespace
}  // namespace octavo::csg
