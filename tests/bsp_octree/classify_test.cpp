// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>

#include <octavo/mesh/shapes.hpp>

#include "bsp_octree/solid_cases.hpp"
#include "effort.hpp"

namespace octavo::bsp_octree {
namespace {

using Integer = boost::multiprecision::int1024_t;  // products of three numbers of 205 bits
using bsp::Position;
using tests::fine;
using tests::Grid;

constexpr int side = 5;

/// Unit cells of a grid.
struct Voxels {
    std::array<char, side * side * side> filled{};

    bool at(int x, int y, int z) const {
        const auto within = [](int v) { return v >= 0 && v < side; };
        return within(x) && within(y) && within(z) &&
               filled[static_cast<std::size_t>((x * side + y) * side + z)];
    }
    void set(Grid low, Grid high, bool value) {
        for (int x = low[0]; x < high[0]; ++x)
            for (int y = low[1]; y < high[1]; ++y)
                for (int z = low[2]; z < high[2]; ++z)
                    filled[static_cast<std::size_t>((x * side + y) * side + z)] = value;
    }
    /// At the point whose coordinates are halves of these: on where filled and empty cells meet.
    Position position(Grid twice) const {
        bool in = false, out = false;
        for (int i = 0; i < 8; ++i) {
            int cell[3];
            for (int axis = 0; axis < 3; ++axis) {
                const int doubled = twice[static_cast<std::size_t>(axis)];
                cell[axis] = static_cast<int>(std::floor(doubled / 2.0)) -
                             (doubled % 2 == 0 && (i >> axis & 1) ? 1 : 0);
            }
            (at(cell[0], cell[1], cell[2]) ? in : out) = true;
        }
        return in && out ? Position::on : in ? Position::in : Position::out;
    }
};

TEST(Classify, KnowsEveryHalfPointOfRandomBoxSolids) {
    for (int run = 0; run < 60 * tests::effort() && !HasFailure(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        const auto number = [&](int low, int high) {
            return std::uniform_int_distribution<int>(low, high)(random);
        };
        const std::uint32_t planes = run % 3 == 0 ? 1 : run % 3 == 1 ? 4 : 16;
        Voxels voxels;
        BspOctree solid(tests::small_lattice(), fine(planes).octree);
        for (int step = 0; step < 8; ++step) {
            Grid low, high;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = number(0, side - 1);
                high[axis] = number(low[axis] + 1, side);
            }
            const BspOctree box =
                tests::octree_of(tests::box(low, high, number(0, 1) == 1).mesh, fine(planes));
            const bool add = step == 0 || number(0, 2) > 0;
            solid = add ? *solid.unite(box) : *solid.subtract(box);
            voxels.set(low, high, add);
        }
        for (int x = -1; x <= 2 * side + 1; ++x)
            for (int y = -1; y <= 2 * side + 1; ++y)
                for (int z = -1; z <= 2 * side + 1; ++z)
                    ASSERT_EQ(solid.classify({x / 2.0, y / 2.0, z / 2.0}), voxels.position({x, y, z}))
                        << "run " << run << " at " << x << ' ' << y << ' ' << z << " halves";
    }
}

/// Against convex bodies in exact arithmetic, at points that are often on planes, walls between cells, or both.
TEST(Classify, AgreesWithHalfSpacesOnConvexBodies) {
    for (int run = 0; run < 60 * tests::effort() && !HasFailure(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        const tests::Convex body = tests::random_convex(random, 4);
        const exact::Lattice lattice = tests::small_lattice(0);  // walls at halves
        const BspOctree solid = tests::octree_of(body.mesh, fine(run % 2 ? 1 : 4), lattice);
        std::uniform_int_distribution<int> number(-4, 20);
        for (int i = 0; i < 2000; ++i) {
            const Grid quarter{number(random), number(random), number(random)};
            Position expected = Position::in;
            for (const tests::HalfSpace& half : body.sides) {
                const int value = tests::dot(half.n, quarter) - 4 * half.d;
                if (value > 0) expected = Position::out;
                if (value == 0 && expected == Position::in) expected = Position::on;
            }
            ASSERT_EQ(solid.classify({quarter[0] / 4.0, quarter[1] / 4.0, quarter[2] / 4.0}), expected)
                << "run " << run << " at " << quarter[0] << ' ' << quarter[1] << ' ' << quarter[2]
                << " quarters";
        }
    }
}

/// A double as an exact multiple of 2^-200.
Integer scaled(double number) {
    int exponent = 0;
    const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(number, &exponent), 53));
    return Integer(mantissa) << (200 + exponent - 53);
}

/// A star-shaped body about the origin, asked in exact integers: a point is inside when it is behind the facet whose
/// cone from the origin holds it.
class Star {
  public:
    explicit Star(const mesh::Mesh& mesh) : mesh_(mesh), about_(mesh.vertices.size()) {
        for (const Vec3 vertex : mesh.vertices) corners_.push_back(exactly(vertex));
        for (std::size_t facet = 0; facet < mesh.triangles.size(); ++facet)
            for (const mesh::VertexIndex corner : mesh.triangles[facet]) about_[corner].push_back(facet);
    }

    /// Facets about vertex `near` are asked first, which is fast; where one cone holds the point, all that do agree.
    Position classify(Vec3 point, mesh::VertexIndex near) const {
        const Exact p = exactly(point);
        for (const std::size_t facet : about_[near])
            if (const auto found = behind(facet, p)) return *found;
        for (std::size_t facet = 0; facet < mesh_.triangles.size(); ++facet)
            if (const auto found = behind(facet, p)) return *found;
        ADD_FAILURE() << "no cone holds the point";
        return Position::out;
    }

  private:
    using Exact = std::array<Integer, 3>;

    static Exact exactly(Vec3 point) { return {scaled(point.x), scaled(point.y), scaled(point.z)}; }
    static Integer volume(const Exact& u, const Exact& v, const Exact& w) {
        return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
               u[2] * (v[0] * w[1] - v[1] * w[0]);
    }
    /// Nothing when the facet's cone does not hold the point.
    std::optional<Position> behind(std::size_t facet, const Exact& p) const {
        const auto& [i, j, k] = mesh_.triangles[facet];
        const Exact &a = corners_[i], &b = corners_[j], &c = corners_[k];
        const Integer first = volume(p, b, c);
        if (first < 0) return {};
        const Integer second = volume(a, p, c);
        if (second < 0) return {};
        const Integer third = volume(a, b, p);
        if (third < 0) return {};
        const Integer rest = volume(a, b, c) - first - second - third;
        return rest > 0 ? Position::in : rest == 0 ? Position::on : Position::out;
    }

    const mesh::Mesh& mesh_;
    std::vector<Exact> corners_;
    std::vector<std::vector<std::size_t>> about_;
};

TEST(Classify, AgreesWithRationalsOnPointsOnAndNearFacets) {
    mesh::Mesh ball = mesh::icosphere(1, 5);
    const Result<Built> built = build(ball);
    ASSERT_TRUE(built);
    const exact::Lattice& lattice = built->octree.lattice();
    for (Vec3& vertex : ball.vertices) vertex = lattice.to_world(lattice.snap(vertex));
    const Star star(ball);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    std::uniform_int_distribution<std::size_t> any(0, ball.triangles.size() - 1);
    const int points = 2000 * tests::effort();
    int on = 0;
    for (int i = 0; i < points && !HasFailure(); ++i) {
        const mesh::Triangle& t = ball.triangles[any(random)];
        const Vec3 a = ball.vertices[t[0]], b = ball.vertices[t[1]], c = ball.vertices[t[2]];
        Vec3 p;
        switch (i % 4) {
            case 0:
                p = a;
                break;
            case 1:
                p = 0.5 * a + 0.5 * b;
                break;  // exact: on the edge
            case 2: {
                const double u = unit(random), v = (1 - u) * unit(random);
                p = a + u * (b - a) + v * (c - a);  // nearly on the facet
                break;
            }
            default:
                p = (unit(random) * 1.2) * a + Vec3{unit(random) * 1e-9, 0, 0};
        }
        const Position expected = star.classify(p, t[0]);
        on += expected == Position::on;
        ASSERT_EQ(built->octree.classify(p), expected) << "point " << i;
    }
    EXPECT_GT(on, points / 3);
}

TEST(Classify, KnowsThatBeyondTheUniverseIsOutside) {
    const BspOctree cube = tests::octree_of(mesh::cube());
    EXPECT_EQ(cube.classify({1e300, 0, 0}), Position::out);
    EXPECT_EQ(cube.complement().classify({1e300, -1e300, 5}), Position::in);
    EXPECT_EQ(cube.complement().classify({0, 0, 0}), Position::out);
    EXPECT_EQ(cube.complement().classify({0.5, 0, 0}), Position::on);
}

}  // namespace
}  // namespace octavo::bsp_octree
