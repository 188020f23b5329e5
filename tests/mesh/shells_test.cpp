// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <gtest/gtest.h>

#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/shells.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/transform.hpp>
#include <octavo/mesh/validate.hpp>
#include <octavo/mesh/weld.hpp>

#include "effort.hpp"
#include "glued_solids.hpp"

namespace octavo::mesh {
namespace {

Shells shells_of(const Mesh& mesh) {
    const Mesh welded = weld(mesh);
    const Result<Snapped> snapped = snap(welded);
    EXPECT_TRUE(snapped);
    return find_shells(snapped->mesh.points, welded.triangles,
                       build_edges(welded.triangles, welded.vertices.size()));
}

/// The facets of closed shells, of one or of all but one.
Mesh part_of(const Mesh& mesh, const Shells& shells, std::uint32_t shell, bool is_of_one) {
    Mesh part;
    part.vertices = mesh.vertices;
    for (FaceIndex face = 0; face < mesh.triangles.size(); ++face) {
        const std::uint32_t number = shells.of_face[face];
        if (number != no_index && shells.shells[number].closed && (number == shell) == is_of_one)
            part.triangles.push_back(mesh.triangles[face]);
    }
    return part;
}

TEST(Shells, KnowTheWindingNumbersBesideTheirFacets) {
    // Against solid angles at places a little off each facet, where no facets meet but at edges and corners.
    std::size_t asked = 0, negative = 0, enclosed = 0;
    for (unsigned seed = 0; seed < 2000u * static_cast<unsigned>(tests::effort()); ++seed) {
        SCOPED_TRACE(seed);
        const Mesh mesh = weld(tests::GluedSolids(seed).next());
        const Report report = *validate(mesh);
        bool is_embedded = true;
        for (const ProblemKind kind : {ProblemKind::self_intersections, ProblemKind::penetrations,
                                       ProblemKind::overlaps, ProblemKind::duplicate_facets})
            is_embedded = is_embedded && report.count(kind) == 0;
        if (!is_embedded) continue;
        const Shells shells = shells_of(mesh);
        std::vector<int> lowest(shells.shells.size()), highest(shells.shells.size());
        for (FaceIndex face = 0; face < mesh.triangles.size(); ++face) {
            const std::uint32_t number = shells.of_face[face];
            if (number == no_index || !shells.shells[number].closed) continue;
            const auto [i, j, k] = mesh.triangles[face];
            const Vec3 a = mesh.vertices[i], b = mesh.vertices[j], c = mesh.vertices[k];
            const Vec3 normal = cross(b - a, c - a);
            if (normal == Vec3{}) continue;
            const Vec3 middle = (1.0 / 3) * (a + b + c), off = (1e-4 / length(normal)) * normal;
            const Mesh own = part_of(mesh, shells, number, true),
                       others = part_of(mesh, shells, number, false);
            ASSERT_EQ(shells.in_front[face], tests::winding_number(own, middle + off)) << face;
            lowest[number] = std::min(lowest[number], shells.in_front[face]);
            highest[number] = std::max(highest[number], shells.in_front[face] + 1);
            const Vec3 inside = shells.in_front[face] >= 0 ? middle - off : middle + off;
            const int around = tests::winding_number(others, inside);
            ASSERT_EQ(shells.shells[number].winding_around(), around) << face;
            ++asked;
            negative += shells.in_front[face] < 0;
            enclosed += around != 0;
        }
        for (std::size_t shell = 0; shell < lowest.size(); ++shell) {
            ASSERT_EQ(shells.shells[shell].lowest, lowest[shell]);
            ASSERT_EQ(shells.shells[shell].highest, highest[shell]);
        }
    }
    EXPECT_GT(asked, 5000u);
    EXPECT_GT(negative, 1000u);
    EXPECT_GT(enclosed, 500u);
}

TEST(Shells, LieInThoseThatTheyTouchFromWithinAlone) {
    const Mesh large = box({0, 0, 0}, {4, 4, 4});
    const auto around = [&](const Mesh& small) {
        const std::array<Mesh, 2> parts{large, small};
        const Shells shells = shells_of(join(parts));
        EXPECT_EQ(shells.shells.size(), 2u);
        EXPECT_EQ(shells.shells[0].winding_around(), 0);
        return shells.shells[1].winding_around();
    };
    for (const bool is_flipped : {false, true}) {
        const auto turned = [&](Mesh mesh) { return is_flipped ? flipped(std::move(mesh)) : mesh; };
        EXPECT_EQ(around(turned(box({0, 1, 1}, {2, 2, 2}))), 1) << "flush from within";
        EXPECT_EQ(around(turned(box({0, 1, 0}, {4, 3, 4}))), 1) << "through and through";
        EXPECT_EQ(around(turned(box({4, 1, 1}, {6, 2, 2}))), 0) << "flush from outside";
        EXPECT_EQ(around(turned(box({-2, 1, 1}, {0, 2, 2}))), 0) << "flush from outside";
    }
    // Facets on each other, with other corners: none that the other has.
    Mesh same = large;
    for (Triangle& t : same.triangles) t = {t[1], t[2], t[0]};
    same.vertices.push_back({0.5, 0.5, 0});
    EXPECT_EQ(shells_of(join(std::array<Mesh, 2>{large, box({0, 0, 0}, {4, 4, 2})})).shells.size(), 1u)
        << "they share edges";
}

TEST(Shells, OfBodiesThatHangTogetherSayOfEachPatchWhatItIs) {
    const Mesh large = box({0, 0, 0}, {2, 2, 1}), small = box({2, 2, 0}, {3, 3, 1});
    const Shells right = shells_of(join(std::array{large, small}));
    ASSERT_EQ(right.shells.size(), 1u);
    EXPECT_TRUE(right.shells[0].separates());
    const Shells wrong = shells_of(join(std::array{large, flipped(small)}));
    EXPECT_GT(wrong.shells[0].volume6, 0);
    EXPECT_TRUE(wrong.shells[0].inside_out());
    EXPECT_EQ(wrong.in_front[0], 0);
    EXPECT_EQ(wrong.in_front[large.triangles.size()], -1);
    // Of as much on either side nothing is left by volume.
    const Shells none = shells_of(join(std::array{large, flipped(box({2, 2, 0}, {4, 4, 1}))}));
    EXPECT_EQ(none.shells[0].volume6, 0);
    EXPECT_TRUE(none.shells[0].inside_out());
    EXPECT_FALSE(none.shells[0].flat());
}

}  // namespace
}  // namespace octavo::mesh
