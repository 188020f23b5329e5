// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/pieces.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/transform.hpp>

namespace octavo::hexmesh {
namespace {

mesh::Mesh ball_at(double x) { return mesh::transform(mesh::icosphere(1, 2), mesh::translation({x, 0, 0})); }

TEST(Pieces, AreThoseOfTheSolidsWhereCellsTellThemApart) {
    const std::vector<mesh::Mesh> balls{ball_at(0), ball_at(2.5), ball_at(5)};
    EXPECT_EQ(count_pieces(build(balls, {.precision = 0.125})->mesh), 3u);
    EXPECT_EQ(count_pieces(build(balls, {.precision = 1})->mesh), 1u) << "touched cells bridge the gaps";
    EXPECT_EQ(count_pieces(build(balls, {.level = 5, .keep = Keep::all})->mesh), 1u);
}

TEST(Pieces, HoldTogetherAtHangingNodes) {
    // Fine and coarse cells of one solid share hanging nodes only with their neighbours of the other size.
    const mesh::Mesh ball = ball_at(0);
    const Result<Built> built = build(std::span(&ball, 1), {.precision = 0.0625});
    EXPECT_GT(built->mesh.hanging_nodes(), 100u);
    EXPECT_EQ(count_pieces(built->mesh), 1u);
}

TEST(Pieces, OfNoCellsAreNone) { EXPECT_EQ(count_pieces({}), 0u); }

}  // namespace
}  // namespace octavo::hexmesh
