// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <random>
#include <vector>

#include <classic/rational.hpp>
#include <classic/solids.hpp>
#include <gtest/gtest.h>
#include <models.hpp>

#include <octavo/io/read.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/query/inside.hpp>

#include "effort.hpp"

namespace octavo::query {
namespace {

using tests::Integer;

/// Doubles as exact multiples of 2^-1074: any finite double is one.
constexpr int bits = 1074;
Integer exact_multiple(double value) {
    int exponent = 0;
    const double mantissa = std::frexp(value, &exponent);
    const auto whole = static_cast<std::int64_t>(std::ldexp(mantissa, 53));
    const int shift = exponent - 53 + bits;
    return shift >= 0 ? Integer(whole) << shift : Integer(whole) >> -shift;
}

/// The oracle: the surface in world coordinates, as multiples of 2^-scale_bits, with everything in range exact. All
/// facets that are not farther from a point, or from the line of its ray, than doubles could ever err.
class Oracle {
  public:
    Oracle(const mesh::LatticeMesh& mesh, int scale_bits)
        : scale_bits_(scale_bits), surface_(world_surface(mesh, scale_bits)) {
        for (const mesh::Triangle& t : mesh.triangles) {
            Box3 box;
            for (const mesh::VertexIndex vertex : t) box.add(mesh.lattice.to_world(mesh.points[vertex]));
            spheres_.push_back({0.5 * (box.low + box.high), 0.5 * length(box.extents())});
        }
    }

    /// Whether the point is a multiple of 2^-scale_bits. Beside zero there are doubles that are not.
    bool represents(Vec3 p) const {
        for (int axis = 0; axis < 3; ++axis) {
            const Integer value = exact_multiple(p[axis]);
            if (value >> (bits - scale_bits_) << (bits - scale_bits_) != value) return false;
        }
        return true;
    }

    Side operator()(Vec3 p) const {
        const auto scaled = [&](double v) { return Integer(exact_multiple(v) >> (bits - scale_bits_)); };
        const tests::IntegerPoint point{scaled(p.x), scaled(p.y), scaled(p.z)};
        if (tests::is_between_corners(facets_near(p, {}), point)) return Side::on;
        for (int attempt = 0;; ++attempt) {
            const std::array<int, 3> d = tests::ray_direction(attempt);
            const Vec3 direction{static_cast<double>(d[0]), static_cast<double>(d[1]),
                                 static_cast<double>(d[2])};
            const auto place =
                tests::place_by_ray(facets_near(p, (1 / length(direction)) * direction), point, d);
            if (!place) continue;
            return place->on_facet ? Side::on : place->winding > 0 ? Side::inside : Side::outside;
        }
    }

  private:
    using Facet = std::array<tests::IntegerPoint, 3>;
    struct Sphere {
        Vec3 centre;
        double radius;
    };

    /// Facets whose spheres come near the line through `p` in a direction of unit length, or near `p` without one.
    std::vector<std::reference_wrapper<const Facet>> facets_near(Vec3 p, Vec3 direction) const {
        std::vector<std::reference_wrapper<const Facet>> near;
        for (std::size_t i = 0; i < spheres_.size(); ++i) {
            const Vec3 away = spheres_[i].centre - p;
            const double along = dot(away, direction);
            const double slack =
                1e-6 * (length(away) + spheres_[i].radius) + 1e-13 * (length(p) + length(spheres_[i].centre));
            if (length(away - along * direction) <= spheres_[i].radius + slack)
                near.push_back(std::cref(surface_.triangles[i]));
        }
        return near;
    }

    static tests::ScaledSurface world_surface(const mesh::LatticeMesh& mesh, int scale_bits) {
        tests::ScaledSurface surface(mesh, Integer(1));
        const auto& origin = mesh.lattice.origin();
        for (auto& triangle : surface.triangles)
            for (auto& corner : triangle)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    corner[axis] = (corner[axis] + origin[axis]) << (scale_bits + mesh.lattice.exponent());
        return surface;
    }

    int scale_bits_;
    tests::ScaledSurface surface_;
    std::vector<Sphere> spheres_;
};

Context with_threads(int threads) {
    Context context;
    context.threads = threads;
    return context;
}

/// Points that matter for a surface: on vertices, edges and facets, a breath away from them, in walls of cells, and
/// anywhere.
std::vector<Vec3> telling_points(const mesh::LatticeMesh& mesh, std::size_t count, unsigned seed) {
    std::mt19937_64 random(seed);
    const auto below = [&](std::uint64_t bound) { return random() % bound; };
    const exact::Lattice& lattice = mesh.lattice;
    Box3 bounds;
    for (const exact::Point& p : mesh.points) bounds.add(lattice.to_world(p));
    std::vector<Vec3> points;
    while (points.size() < count) {
        const mesh::Triangle& t = mesh.triangles[below(mesh.triangles.size())];
        const Vec3 a = lattice.to_world(mesh.points[t[0]]), b = lattice.to_world(mesh.points[t[1]]),
                   c = lattice.to_world(mesh.points[t[2]]);
        Vec3 p;
        switch (below(6)) {
            case 0:
                p = a;
                break;
            case 1:
                p = 0.5 * (a + b);
                break;  // on an edge: halves are exact
            case 2:
                p = 0.25 * (a + b + 2.0 * c);
                break;  // on the facet
            case 3: {   // near the facet
                const double u = std::ldexp(static_cast<double>(below(1 << 30)), -31),
                             v = std::ldexp(static_cast<double>(below(1 << 30)), -31);
                p = (1 - u - v) * a + u * b + v * c;
                break;
            }
            case 4: {  // a corner of some cell
                const std::int32_t mask = -(exact::universe_side >> below(12));
                const auto place = [&] {
                    return static_cast<std::int32_t>(below(exact::universe_side)) & mask;
                };
                p = lattice.to_world({place(), place(), place()});
                break;
            }
            default:
                for (int axis = 0; axis < 3; ++axis)
                    p[axis] = bounds.low[axis] + std::ldexp(static_cast<double>(below(1ULL << 50)), -50) *
                                                     (bounds.high[axis] - bounds.low[axis]);
        }
        if (below(3) == 0) {
            const int axis = static_cast<int>(below(3));
            p[axis] = std::nextafter(p[axis], below(2) ? 1e300 : -1e300);
        }
        points.push_back(p);
    }
    return points;
}

struct Tally {
    std::size_t inside = 0, on = 0, outside = 0;
    void add(Side side) { ++(side == Side::inside ? inside : side == Side::on ? on : outside); }
};

Tally expect_answers_of_the_oracle(const mesh::LatticeMesh& mesh, const std::vector<Vec3>& points,
                                   int scale_bits, const InsideOptions& options = {}) {
    const Result<InsideQuery> query = InsideQuery::build(mesh, options, with_threads(1));
    EXPECT_TRUE(query) << query.error().describe();
    const Oracle oracle(mesh, scale_bits);
    const std::vector<Side> batch = (*query)(points, with_threads(1));
    Tally tally;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!oracle.represents(points[i])) continue;
        const Side expected = oracle(points[i]);
        tally.add(expected);
        EXPECT_EQ((*query)(points[i]), expected) << points[i].x << " " << points[i].y << " " << points[i].z;
        EXPECT_EQ(batch[i], expected);
        EXPECT_EQ(query->finish(query->begin(points[i])), expected);
        if (::testing::Test::HasFailure()) break;
    }
    return tally;
}

TEST(InsideQuery, AgreesWithRationalRaysOnDegenerateOverlappingSolids) {
    Tally sum;
    for (unsigned seed = 0; seed < 150u * static_cast<unsigned>(tests::effort()); ++seed) {
        tests::GridPoints grid(seed, seed % 2 ? 1 << (1 + seed / 2 % 5) : 13);
        mesh::LatticeMesh bag = tests::random_bag(grid);
        // Lattices near the origin and far from it, coarse and fine.
        if (seed % 3)
            bag.lattice =
                *exact::Lattice::from_parts(static_cast<int>(seed % 40) - 30, {-100000, 70000000, -5});
        InsideOptions options;
        options.leaf_facets = static_cast<int>(seed % 5);
        options.depth = 1 + static_cast<int>(seed % 9);
        const Tally tally = expect_answers_of_the_oracle(bag, telling_points(bag, 100, seed), 1074, options);
        sum.inside += tally.inside, sum.on += tally.on, sum.outside += tally.outside;
        ASSERT_FALSE(HasFailure()) << "seed " << seed;
    }
    EXPECT_GT(sum.inside, 500u);
    EXPECT_GT(sum.on, 1000u);
    EXPECT_GT(sum.outside, 1000u);
}

TEST(InsideQuery, AgreesWithRationalRaysOnSpheres) {
    mesh::LatticeMesh spheres = tests::sphere({33000001, 33333333, 33500007}, 30000000, 3);
    tests::append(spheres, tests::reversed(tests::sphere({33000001, 33333333, 33500007}, 20000000, 3)));
    tests::append(spheres, tests::sphere({20000000, 20000000, 20000000}, 15000000, 2));
    const std::size_t count = 1000u * static_cast<std::size_t>(tests::effort());
    const Tally tally = expect_answers_of_the_oracle(spheres, telling_points(spheres, count, 1), 100);
    EXPECT_GT(std::min({tally.inside, tally.on, tally.outside}), count / 10);
}

/// Just below a coordinate of 0 the place of a point in its unit takes more bits than a double has.
TEST(InsideQuery, IsExactJustBelowTheWorldsOrigin) {
    mesh::Mesh tetrahedron;
    tetrahedron.vertices = {{0, 0, 2}, {1, -1, -2}, {-1, 1, -2}, {2, 2, 0}};
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
    mesh::Mesh many = tetrahedron;
    for (int step = 0; step < 3; ++step) {
        std::vector<mesh::Triangle> parts;
        for (const mesh::Triangle& t : many.triangles) {
            const auto n = static_cast<mesh::VertexIndex>(many.vertices.size());
            for (std::size_t i = 0; i < 3; ++i)
                many.vertices.push_back(0.5 * (many.vertices[t[i]] + many.vertices[t[(i + 1) % 3]]));
            parts.insert(parts.end(),
                         {{t[0], n, n + 2}, {n, t[1], n + 1}, {n + 2, n + 1, t[2]}, {n, n + 1, n + 2}});
        }
        many.triangles = parts;
    }
    // Beside the facet x = -y: inside, on it, and outside by the last bit.
    std::vector<Vec3> points{{-4.0412873194526372e-19, 4.0412873194526367e-19, -0.72718592726760556}};
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(0, 1);
    while (points.size() < 600) {
        const double t = std::pow(10, -20 + 12 * unit(random)), z = 2 * unit(random) - 1;
        for (const double y : {std::nextafter(t, 0.0), t, std::nextafter(t, 1.0)})
            points.push_back({-t, y, z});
    }
    InsideOptions small_leaves;
    small_leaves.leaf_facets = 1;
    for (const mesh::Mesh& mesh : {tetrahedron, many}) {
        const mesh::LatticeMesh lattice_mesh = mesh::snap(mesh)->mesh;
        const Tally tally = expect_answers_of_the_oracle(lattice_mesh, points, 1074);
        EXPECT_GT(std::min({tally.inside, tally.on, tally.outside}), 190u);
        expect_answers_of_the_oracle(lattice_mesh, points, 1074, small_leaves);
    }
}

TEST(InsideQuery, AnswersForFansOfSliversWithoutCuttingThemSmall) {
    // 4 000 sides: caps are fans of slivers, sides are strips of them.
    const auto snapped = mesh::snap(mesh::cylinder(1, 1, 4000));
    ASSERT_TRUE(snapped);
    expect_answers_of_the_oracle(snapped->mesh, telling_points(snapped->mesh, 60, 71), 60);
    const Result<InsideQuery> query = InsideQuery::build(snapped->mesh);
    ASSERT_TRUE(query);
    EXPECT_LT(query->memory_bytes(), 1000 * snapped->mesh.triangles.size());
}

/// A double cone whose rim goes in and out: its facets lie about the axis like the pages of a book.
mesh::Mesh star(mesh::VertexIndex rim, double inner, double depth) {
    mesh::Mesh mesh;
    mesh.vertices = {{0, 0, -depth}, {0, 0, 1}};
    for (mesh::VertexIndex i = 0; i < rim; ++i) {
        const double angle = 2 * 3.14159265358979323846 * i / rim, radius = i % 2 ? 1 : inner;
        mesh.vertices.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
        const mesh::VertexIndex a = 2 + i, b = 2 + (i + 1) % rim;
        mesh.triangles.push_back({1, a, b});
        mesh.triangles.push_back({0, b, a});
    }
    return mesh;
}

TEST(InsideQuery, HoldsSoManyReferencesAFacetAndNoMoreWhateverTheShape) {
    for (const mesh::VertexIndex rim : {1000U, 4000U}) {
        const auto snapped = mesh::snap(star(rim, 0.2, 1));
        ASSERT_TRUE(snapped);
        const std::size_t facets = snapped->mesh.triangles.size();
        for (const int references : {1, 20, InsideOptions{}.references}) {
            InsideOptions options;
            options.references = references;
            const Result<InsideQuery> query = InsideQuery::build(snapped->mesh, options, with_threads(1));
            ASSERT_TRUE(query);
            EXPECT_LE(query->reference_count(), static_cast<std::size_t>(references) * facets);
            EXPECT_LT(query->memory_bytes(), (6 * static_cast<std::size_t>(references) + 200) * facets);
        }
    }
    const auto small = mesh::snap(star(200, 0.2, 1));
    for (const int references : {1, 20, 512}) {
        InsideOptions options;
        options.references = references;
        const Tally tally =
            expect_answers_of_the_oracle(small->mesh, telling_points(small->mesh, 300, 5), 120, options);
        EXPECT_GT(std::min({tally.inside, tally.on, tally.outside}), 10u);
    }
}

/// A body that is a line on the lattice, beside one that has volume.
mesh::LatticeMesh with_a_collapsed_body(bool is_alone) {
    mesh::LatticeMesh mesh = tests::box({1000, 1000, 1000}, {4000, 4000, 4000});
    if (is_alone) mesh.triangles.clear();
    const auto first = static_cast<mesh::VertexIndex>(mesh.points.size());
    for (const std::int32_t t : {0, 3, 7, 20})
        mesh.points.push_back({5000 + 300 * t, 2000 + 500 * t, 6000 - 100 * t});
    for (const mesh::Triangle& t : {mesh::Triangle{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}})
        mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    return mesh;
}

TEST(InsideQuery, IsOnWhatHasNoAreaAsTheDistanceThereIsNone) {
    for (const bool is_alone : {false, true}) {
        const mesh::LatticeMesh mesh = with_a_collapsed_body(is_alone);
        for (const int leaf_facets : {1, 4, 12}) {
            InsideOptions options;
            options.leaf_facets = leaf_facets;
            const InsideQuery query = *InsideQuery::build(mesh, options, with_threads(1));
            const auto at = [&](double t) { return Vec3{5000 + 300 * t, 2000 + 500 * t, 6000 - 100 * t}; };
            for (const double t : {0.0, 3.0, 7.0, 20.0, 0.125, 12.75, 19.5}) {
                EXPECT_EQ(query(at(t)), Side::on) << t;
                for (int axis = 0; axis < 3; ++axis)
                    for (const double to : {-1e300, 1e300}) {
                        Vec3 beside = at(t);
                        beside[axis] = std::nextafter(beside[axis], to);
                        EXPECT_EQ(query(beside), Side::outside) << t;
                    }
            }
            EXPECT_EQ(query(at(-0.125)), Side::outside);
            EXPECT_EQ(query(at(20.125)), Side::outside);
            EXPECT_EQ(query({2000, 2000, 2000}), is_alone ? Side::outside : Side::inside);
        }
    }
    // Along an axis, across the body, and as one point.
    mesh::LatticeMesh mesh = tests::box({1000, 1000, 1000}, {4000, 4000, 4000});
    mesh.points.insert(mesh.points.end(), {{500, 2000, 2000}, {4500, 2000, 2000}, {6000, 6000, 6000}});
    mesh.triangles.insert(mesh.triangles.end(), {{8, 9, 9}, {10, 10, 10}});
    const InsideQuery query = *InsideQuery::build(mesh);
    for (const double x : {500.0, 700.5, 1000.0, 2000.25, 4500.0})
        EXPECT_EQ(query({x, 2000, 2000}), Side::on) << x;
    EXPECT_EQ(query({499.5, 2000, 2000}), Side::outside);
    EXPECT_EQ(query({2000, 2000, 2000.5}), Side::inside);
    EXPECT_EQ(query({6000, 6000, 6000}), Side::on);
    EXPECT_EQ(query({6000, 6000, 6000.5}), Side::outside);
}

TEST(InsideQuery, SeesTheSmallestDoublesBesideAFacet) {
    // The facet x = 0 of a box, and points a denormal away from it: no scaling may lose them.
    for (const int exponent : {-30, 0, 900}) {
        mesh::LatticeMesh box = tests::box({1 << 20, 1 << 20, 1 << 20}, {1 << 22, 1 << 22, 1 << 22});
        box.lattice = *exact::Lattice::from_parts(exponent, {-(1 << 20), -(1 << 21), -(1 << 21)});
        const InsideQuery query = *InsideQuery::build(box);
        const double least = std::numeric_limits<double>::denorm_min();
        EXPECT_EQ(query({least, 0, 0}), Side::inside) << exponent;
        EXPECT_EQ(query({0, 0, 0}), Side::on);
        EXPECT_EQ(query({-0.0, least, -least}), Side::on);
        EXPECT_EQ(query({-least, 0, 0}), Side::outside);
    }
}

TEST(InsideQuery, AnswersOutsideTheUniverseAndForNonNumbersByRule) {
    const InsideQuery query = *InsideQuery::build(tests::box({0, 0, 0}, {1000, 1000, 1000}));
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
    for (const double far : {infinity, -infinity, nan, 1e300, -1e300, 1e9, -1.0, 67108864.0, 9.3e18}) {
        EXPECT_EQ(query({far, 5, 5}), Side::outside) << far;
        EXPECT_EQ(query({5, 5, far}), Side::outside) << far;
        EXPECT_EQ(query(std::vector<Vec3>{{5, far, 5}, {5, 5, 5}})[0], Side::outside);
    }
    EXPECT_EQ(query({5, 5, 5}), Side::inside);
    EXPECT_EQ(query({0, 5, 5}), Side::on) << "a facet in the universe's low side";
    EXPECT_EQ(InsideQuery::build(mesh::LatticeMesh{})->operator()({0, 0, 0}), Side::outside) << "nothing";
}

TEST(InsideQuery, RefusesOpenSurfacesAndClosesThemOnRequest) {
    mesh::LatticeMesh cube = tests::box({1000, 1000, 1000}, {60000000, 60000000, 60000000});
    cube.triangles.erase(cube.triangles.begin() + 2, cube.triangles.begin() + 4);
    EXPECT_EQ(InsideQuery::build(cube).error().code, ErrorCode::not_a_solid);
    InsideOptions options;
    options.open = classic::OpenPolicy::winding;
    const InsideQuery query = *InsideQuery::build(cube, options);
    EXPECT_EQ(query({5e6, 5e6, 5e6}), Side::inside);
    EXPECT_EQ(query({5e6, 5e6, 60000001}), Side::outside);
}

TEST(InsideQuery, FloatPointsAreTheSameDoubles) {
    const mesh::Mesh cube = mesh::box({0, 0, 0}, {1, 1, 1});
    const auto query = InsideQuery::build(cube);
    ASSERT_TRUE(query.has_value());
    std::vector<std::array<float, 3>> floats;
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(-0.5F, 1.5F);
    for (int i = 0; i < 1000; ++i) floats.push_back({unit(random), unit(random), unit(random)});
    floats.push_back({0.5F, 0.5F, 1});
    floats.push_back({0.5F, 0.5F, std::nextafter(1.0F, 0.0F)});
    floats.push_back({std::numeric_limits<float>::quiet_NaN(), 0, 0});
    std::vector<Vec3> doubles;
    for (const auto& p : floats) doubles.push_back({p[0], p[1], p[2]});
    const std::vector<Side> sides = (*query)(floats);
    EXPECT_EQ(sides, (*query)(doubles));
    EXPECT_EQ(sides[1000], Side::on);
    EXPECT_EQ(sides[1001], Side::inside);
}

TEST(InsideQuery, GivesTheSameAnswersForAnyNumberOfThreads) {
    const mesh::LatticeMesh ball = tests::sphere({33000001, 33333333, 33500007}, 30000000, 6);
    const InsideQuery query = *InsideQuery::build(ball, {}, with_threads(1));
    const InsideQuery parallel = *InsideQuery::build(ball, {}, with_threads(3));
    EXPECT_EQ(query.memory_bytes(), parallel.memory_bytes());
    const std::vector<Vec3> points = telling_points(ball, 20000, 5);
    const std::vector<Side> sides = query(points, with_threads(1));
    EXPECT_EQ(query(points, with_threads(3)), sides);
    EXPECT_EQ(parallel(points, with_threads(2)), sides);
}

TEST(Contains, AnswersInOneCallForAMeshOfDoubles) {
    const mesh::LatticeMesh ball = tests::sphere({500, 500, 500}, 300, 4);
    mesh::Mesh mesh;
    for (const exact::Point& p : ball.points)
        mesh.vertices.push_back({0.125 * p.x, 0.125 * p.y, 0.125 * p.z});
    mesh.triangles = ball.triangles;
    const std::vector<Vec3> points{{62.5, 62.5, 62.5}, {1, 1, 1}, mesh.vertices[17]};
    EXPECT_EQ(*contains(mesh, points), (std::vector<Side>{Side::inside, Side::outside, Side::on}));
    mesh.vertices[3].x = std::nan("");
    EXPECT_FALSE(contains(mesh, points));
}

TEST(Contains, NeverAnswersForPointsThatItDidNotLookAt) {
    const mesh::LatticeMesh ball = tests::sphere({500, 500, 500}, 300, 2);
    mesh::Mesh mesh;
    for (const exact::Point& p : ball.points) mesh.vertices.push_back({1.0 * p.x, 1.0 * p.y, 1.0 * p.z});
    mesh.triangles = ball.triangles;
    const std::vector<Vec3> centres(100'000, {500, 500, 500});
    // Cancelled when the query has been built, before it answers.
    std::atomic<bool> cancel{false};
    Context context;
    context.threads = 1;
    context.cancel = &cancel;
    context.on_progress = [&](std::string_view, double done) { cancel = done == 1; };
    const Result<std::vector<Side>> sides = contains(mesh, centres, {}, context);
    ASSERT_FALSE(sides);
    EXPECT_EQ(sides.error().code, ErrorCode::cancelled);
}

TEST(InsideQuery, AgreesWithRationalRaysOnRealModels) {
    for (const char* name : {"classic/spot.obj", "mechanical/part.off"}) {
        OCTAVO_NEEDS_MODEL(name);
        const mesh::Mesh read = io::read_mesh((tests::models_folder() / name).string())->mesh;
        const mesh::LatticeMesh mesh = mesh::snap(read)->mesh;
        const std::size_t count = 100u * static_cast<std::size_t>(tests::effort());
        expect_answers_of_the_oracle(mesh, telling_points(mesh, count, 3), 120);
        ASSERT_FALSE(HasFailure()) << name;
    }
}

TEST(InsideQuery, AgreesWithRationalRaysOnEveryModelThatIsClosed) {
    if (tests::effort() < 10) GTEST_SKIP() << "set OCTAVO_TEST_EFFORT to 10 or more";
    OCTAVO_NEEDS_MODEL("classic");
    std::size_t models = 0, answers = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(tests::models_folder())) {
        const std::string extension = entry.path().extension().string();
        if (extension != ".ply" && extension != ".obj" && extension != ".off" && extension != ".stl")
            continue;
        const Result<io::ReadMesh> read = io::read_mesh(entry.path().string());
        ASSERT_TRUE(read) << entry.path();
        const mesh::LatticeMesh mesh = mesh::snap(read->mesh)->mesh;
        if (!InsideQuery::build(mesh)) continue;  // open
        // The oracle looks at all facets for every point: few points on a large model, many on a small one.
        const std::size_t looks = 100'000u * static_cast<std::size_t>(tests::effort());
        const std::size_t count = std::clamp<std::size_t>(looks / mesh.triangles.size(), 5, 3000);
        const Tally tally = expect_answers_of_the_oracle(mesh, telling_points(mesh, count, 7), 120);
        ASSERT_FALSE(HasFailure()) << entry.path();
        ++models, answers += tally.inside + tally.on + tally.outside;
    }
    std::cout << answers << " answers on " << models << " closed models\n";
    EXPECT_GE(answers, 10'000u);
}

}  // namespace
}  // namespace octavo::query
