// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/merge_coplanar.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/triangulate.hpp>
#include <octavo/mesh/validate.hpp>

namespace octavo::mesh {
namespace {

LatticeMesh on_lattice(const Mesh& mesh) {
    Result<Snapped> snapped = snap(mesh);
    EXPECT_TRUE(snapped);
    return std::move(snapped->mesh);
}

std::size_t faces_of(const PolygonMesh& mesh) { return mesh.face_begin.size() - 1; }

/// Triangulated again, merged faces must bound the very same solid.
void expect_same_solid(const LatticeMesh& mesh, const PolygonMesh& merged) {
    const TriangulatedMesh again = triangulate(merged);
    EXPECT_TRUE(again.crossing.empty());
    const Result<Snapped> snapped = snap(again.mesh, mesh.lattice);
    ASSERT_TRUE(snapped);
    EXPECT_EQ(exact_volume6(snapped->mesh), exact_volume6(mesh));
    const Result<Report> report = validate(again.mesh);
    ASSERT_TRUE(report);
    EXPECT_TRUE(report->closed_as_stored && report->solid) << report->describe();
}

TEST(MergeCoplanar, FindsTheFacesOfParts) {
    const Outline square{{0, 0}, {8, 0}, {8, 8}, {0, 8}}, hole{{1, 1}, {1, 3}, {3, 3}, {3, 1}},
        other{{5, 5}, {5, 7}, {7, 7}, {7, 5}};
    const LatticeMesh plate = on_lattice(extrude(square, std::array{hole, other}, 1));
    const PolygonMesh merged = merge_coplanar(plate);
    EXPECT_EQ(faces_of(merged), 2u + 4 + 4 + 4);
    std::size_t with_holes = 0;
    for (std::size_t face = 0; face < faces_of(merged); ++face)
        with_holes += merged.face_begin[face + 1] - merged.face_begin[face] == 3;
    EXPECT_EQ(with_holes, 2u);
    EXPECT_EQ(merged.corners.size(), 2u * 12 + 12 * 4);
    expect_same_solid(plate, merged);
}

TEST(MergeCoplanar, PutsTheOuterContourFirstAndTurnsHolesTheOtherWay) {
    const LatticeMesh plate = on_lattice(
        extrude({{0, 0}, {8, 0}, {8, 8}, {0, 8}}, std::array{Outline{{2, 2}, {2, 6}, {6, 6}, {6, 2}}}, 1));
    const PolygonMesh merged = merge_coplanar(plate);
    for (std::size_t face = 0; face < faces_of(merged); ++face) {
        Vec3 sums[2];
        for (std::size_t c = merged.face_begin[face]; c < merged.face_begin[face + 1]; ++c) {
            const std::size_t begin = merged.contour_begin[c], end = merged.contour_begin[c + 1];
            for (std::size_t i = begin; i < end; ++i) {
                const Vec3 p = merged.vertices[merged.corners[i]];
                const Vec3 q = merged.vertices[merged.corners[i + 1 == end ? begin : i + 1]];
                const Vec3 origin = merged.vertices[merged.corners[begin]];
                sums[c - merged.face_begin[face]] =
                    sums[c - merged.face_begin[face]] + cross(p - origin, q - origin);
            }
        }
        EXPECT_LE(dot(sums[0], sums[1]), 0);
        EXPECT_GE(length(sums[0]), length(sums[1]));
    }
}

TEST(MergeCoplanar, KeepsSolidsAsTheyAre) {
    for (const Mesh& mesh : {gear(), bearing_housing(), icosphere(1, 6), menger_sponge(2), cube(),
                             uv_sphere(1, 24, 12), cylinder(1, 2, 17)}) {
        const LatticeMesh lattice_mesh = on_lattice(mesh);
        const PolygonMesh merged = merge_coplanar(lattice_mesh);
        EXPECT_LE(faces_of(merged), mesh.triangles.size());
        expect_same_solid(lattice_mesh, merged);
    }
    EXPECT_EQ(faces_of(merge_coplanar(on_lattice(cube()))), 6u);
    EXPECT_EQ(faces_of(merge_coplanar(on_lattice(cylinder(1, 2, 17)))), 19u);
}

TEST(MergeCoplanar, LeavesWhatIsNoFaceInTriangles) {
    // A wall stands on a line in the middle of a square, which is a slit in the face round it.
    Mesh slit;
    slit.vertices = {{0, 0, 0}, {6, 0, 0}, {6, 6, 0}, {0, 6, 0}, {2, 3, 0}, {4, 3, 0}, {3, 3, 2}};
    slit.triangles = {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 3, 5}, {3, 4, 5}, {3, 0, 4}, {4, 5, 6}, {5, 4, 6}};
    EXPECT_EQ(faces_of(merge_coplanar(on_lattice(slit))), 8u);
    // Facets that look at each other are no neighbours in a face, and one that names a vertex twice is none.
    Mesh sheet;
    sheet.vertices = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    sheet.triangles = {{0, 1, 2}, {0, 2, 1}, {0, 1, 1}};
    EXPECT_EQ(faces_of(merge_coplanar(on_lattice(sheet))), 2u);
}

TEST(MergeCoplanar, TakesFacetsWithoutAreaAlong) {
    // The middle of an edge is a corner on one side only, joined by a facet without area.
    Mesh square;
    square.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {2, 2, 0}};
    square.triangles = {{0, 1, 2}, {0, 2, 4}, {2, 3, 4}, {0, 4, 3}};
    const PolygonMesh merged = merge_coplanar(on_lattice(square));
    ASSERT_EQ(faces_of(merged), 1u);
    EXPECT_EQ(merged.corners.size(), 4u);
}

}  // namespace
}  // namespace octavo::mesh
