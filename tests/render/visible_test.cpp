// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <optional>

#include <octavo/mesh/shapes.hpp>
#include <octavo/render/visible.hpp>

#include "render/views.hpp"

namespace octavo::render {
namespace {

/// Where a ray meets a triangle, as a share of `along`; none when it misses it. `border` is how near to a side it is.
std::optional<double> meet(Vec3 from, Vec3 along, const Facet& facet, double& border) {
    const auto& [a, b, c] = facet.corners;
    const Vec3 normal = cross(b - a, c - a);
    const double slope = dot(normal, along), size = dot(normal, normal);
    if (std::fabs(slope) < 1e-9 * std::sqrt(size) * length(along)) return std::nullopt;
    const double t = dot(normal, a - from) / slope;
    const Vec3 p = from + t * along;
    const double u = dot(cross(b - a, p - a), normal) / size, v = dot(cross(c - b, p - b), normal) / size,
                 w = dot(cross(a - c, p - c), normal) / size;
    border = std::min({border, std::fabs(u), std::fabs(v), std::fabs(w)});
    if (u < 0 || v < 0 || w < 0) return std::nullopt;
    return t;
}

bool is_inside(std::span<const Point2> ring, Point2 p) {
    bool left = false, right = false;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const double side = Line2::through(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1])(p);
        left |= side > 0, right |= side < 0;
    }
    return !(left && right);
}

/// Looks along rays through points of facets, and expects to see there what is nearest.
std::size_t expect_nearest(const Scene& scene, const View& view, const std::string& what) {
    const Camera camera = tests::camera_for(scene, view, 500, 400);
    const Result<Patches> patches = patches_of(scene, camera);
    const Result<Visible> visible = visible_parts(*patches, {}, camera, 500, 400);
    EXPECT_TRUE(visible);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < scene.facets.size(); i += 1 + scene.facets.size() / 150) {
        const auto& [a, b, c] = scene.facets[i].corners;
        const double u = 0.13 + 0.005 * static_cast<double>(i % 40),
                     v = 0.21 + 0.01 * static_cast<double>(i % 20);
        const Vec3 target = a + u * (b - a) + v * (c - a);
        const Vec3 from = camera.is_perspective() ? camera.eye() : target - 100 * camera.forward();
        const Vec3 along = target - from;
        double nearest = 1e300, second = 1e300, border = 1e300;
        for (const Facet& facet : scene.facets)
            if (const std::optional<double> t = meet(from, along, facet, border)) {
                second = std::min(second, std::max(nearest, *t));
                nearest = std::min(nearest, *t);
            }
        // At borders and where facets cross, rounding to the lattice decides; edge-on, it moves them most.
        if (border < 1e-4 || second - nearest < 1e-4 || nearest > 1 + 1e-6) continue;
        const Vec3 p = camera.project(target);
        std::size_t pieces = 0;
        for (const Piece& piece : visible->pieces) {
            if (!is_inside(visible->corners_of(piece), {p.x, p.y})) continue;
            ++pieces;
            const Patch& patch = patches->patches[piece.patch];
            const double t =
                dot(patch.normal, patches->corners[patch.begin] - from) / dot(patch.normal, along);
            EXPECT_NEAR(t, nearest, 2e-5) << what << ", facet " << i;
        }
        // A point on a wall between squares lies in the pieces on both sides.
        EXPECT_GE(pieces, 1U) << what << ", facet " << i;
        EXPECT_LE(pieces, 2U) << what << ", facet " << i;
        ++seen;
    }
    return seen;
}

TEST(Visible, IsWhatIsNearestOfAnyFacets) {
    std::size_t seen = 0;
    for (const std::uint64_t seed : {1, 2, 3})
        for (const View& view : seed == 3 ? tests::few_views() : tests::all_views())
            seen += expect_nearest(tests::random_facets(seed == 3 ? 400 : 40, seed), view,
                                   "seed " + std::to_string(seed));
    EXPECT_GT(seen, 500U);
}

TEST(Visible, IsWhatIsNearestOfSolids) {
    for (const mesh::Mesh& solid : {mesh::gear(), mesh::knot_tube(2, 3, 0.3, 60, 12), mesh::menger_sponge(2)})
        for (const View& view : tests::few_views())
            EXPECT_GT(expect_nearest(scene_of(solid, {.edges = EdgeLines::none}), view, "solid"), 10U);
}

double area_of(const Visible& visible) {
    double area = 0;
    for (const Piece& piece : visible.pieces) area += 0.5 * twice_area(visible.corners_of(piece));
    return area;
}

TEST(Visible, PiecesCoverWhatThePatchesCover) {
    // Of a convex solid, they are its front; of a solid in front of a larger one, the larger one.
    for (const View& view : tests::all_views()) {
        Scene scene = scene_of(mesh::icosphere(1, 8));
        const Camera camera = tests::camera_for(scene, view, 700, 500);
        double front = 0;
        for (const Facet& facet : scene.facets) {
            const Vec3 a = camera.project(facet.corners[0]), b = camera.project(facet.corners[1]),
                       c = camera.project(facet.corners[2]);
            front += std::max(0.0, -0.5 * ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y)));
        }
        const auto pieces = [&] { return visible_parts(*patches_of(scene, camera), {}, camera, 700, 500); };
        EXPECT_NEAR(area_of(*pieces()), front, 1e-3 * std::sqrt(front));
        for (const Facet& facet : scene_of(mesh::menger_sponge(2)).facets) {
            Facet inner = facet;
            for (Vec3& corner : inner.corners) corner = corner - Vec3{0.5, 0.5, 0.5};
            scene.facets.push_back(inner);
        }
        EXPECT_NEAR(area_of(*pieces()), front, 1e-3 * std::sqrt(front));
    }
}

TEST(Visible, IsTheSameForAnyNumberOfThreads) {
    const Scene scene = scene_of(mesh::gear());
    const Camera camera = tests::camera_for(scene, {}, 500, 400);
    const Result<Patches> patches = patches_of(scene, camera);
    std::vector<WorldLine> lines;
    for (const Line& line : scene.lines) lines.push_back({line.from, line.to});
    std::vector<Visible> results;
    for (const int threads : {1, 2, 3}) {
        Context context;
        context.threads = threads;
        results.push_back(*visible_parts(*patches, lines, camera, 500, 400, context));
    }
    for (const Visible& other : results) {
        EXPECT_EQ(other.corners, results[0].corners);
        EXPECT_EQ(other.pieces.size(), results[0].pieces.size());
        EXPECT_EQ(other.hidden.size(), results[0].hidden.size());
    }
}

/// A square at depth y across the line of sight.
void add_square(Scene& scene, double y, double half) {
    const Vec3 a{-half, y, -half}, b{half, y, -half}, c{half, y, half}, d{-half, y, half};
    scene.facets.push_back({{a, b, c}});
    scene.facets.push_back({{a, c, d}});
}

/// What is hidden of one line, seen from in front.
std::vector<LinePart> hidden_of(const Scene& scene, Vec3 from, Vec3 to, double perspective = 0) {
    const Camera camera = tests::camera_for(scene, {0, 0, perspective, 0.04}, 400, 400);
    const std::array<WorldLine, 1> lines{{{from, to}}};
    return visible_parts(*patches_of(scene, camera), lines, camera, 400, 400)->hidden;
}

TEST(HiddenLines, EndWhereTheFaceInFrontEnds) {
    Scene scene;
    add_square(scene, 0, 1);
    add_square(scene, 2, 2);
    const std::vector<LinePart> hidden = hidden_of(scene, {-2, 1, 0.3}, {2, 1, 0.3});
    ASSERT_EQ(hidden.size(), 1U);
    EXPECT_NEAR(hidden[0].from, 0.25, 1e-6);
    EXPECT_NEAR(hidden[0].to, 0.75, 1e-6);
    // The same along the common diagonal of the square's triangles, and along a border between squares of the picture.
    EXPECT_EQ(hidden_of(scene, {-2, 1, -2}, {2, 1, 2}).size(), 1U);
    EXPECT_EQ(hidden_of(scene, {-2, 1, 0}, {2, 1, 0}).size(), 1U);
    EXPECT_TRUE(hidden_of(scene, {-2, -1, 0.3}, {2, -1, 0.3}).empty());
}

TEST(HiddenLines, BeginWhereTheLineGoesThroughTheFace) {
    Scene scene;
    add_square(scene, 0, 1);
    for (const double perspective : {0.0, 60.0}) {
        // From one unit before the square to three behind it.
        const Vec3 from{-0.5, -1, 0}, to{0.3, 3, 0.1}, through = from + 0.25 * (to - from);
        const std::vector<LinePart> hidden = hidden_of(scene, from, to, perspective);
        ASSERT_EQ(hidden.size(), 1U);
        Scene with_line = scene;
        const Camera camera = tests::camera_for(with_line, {0, 0, perspective, 0.04}, 400, 400);
        const double a = camera.project(from).x, b = camera.project(to).x, c = camera.project(through).x;
        EXPECT_NEAR(hidden[0].from, (c - a) / (b - a), 1e-5);
    }
}

TEST(HiddenLines, InAFaceAreSeen) {
    Scene scene;
    add_square(scene, 0, 1);
    for (const double perspective : {0.0, 60.0})
        for (const Vec3 to : {Vec3{1, 0, 1}, Vec3{0.37, 0, 0.71}, Vec3{-1, 0, 0.123456789}})
            EXPECT_TRUE(hidden_of(scene, {-0.91, 0, -0.3}, to, perspective).empty());
}

TEST(HiddenLines, OfACubeAreThreeEdges) {
    const Scene cube = scene_of(mesh::cube());
    ASSERT_EQ(cube.lines.size(), 12U);
    std::vector<WorldLine> lines;
    for (const Line& line : cube.lines) lines.push_back({line.from, line.to});
    for (const double perspective : {0.0, 50.0})
        for (const double azimuth : {20.0, 110.0, 200.0, 290.0})
            for (const double elevation : {-35.0, 35.0}) {
                const Camera camera =
                    tests::camera_for(cube, {azimuth, elevation, perspective, 0.04}, 400, 400);
                const Result<Visible> visible =
                    visible_parts(*patches_of(cube, camera), lines, camera, 400, 400);
                ASSERT_EQ(visible->hidden.size(), 3U);
                for (const LinePart& part : visible->hidden) EXPECT_GT(part.to - part.from, 1 - 1e-6);
            }
}

}  // namespace
}  // namespace octavo::render
