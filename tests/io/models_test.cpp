// SPDX-License-Identifier: Apache-2.0
#include "models.hpp"

#include <gtest/gtest.h>

#include <octavo/io/read.hpp>
#include <octavo/io/write.hpp>

// Every real model is read and has the vertices and triangles that an independent program counted (Python
// with NumPy, which merges the corners of STL as floats; the table is that of the models' README).

namespace octavo::io {
namespace {

struct Model {
    const char* path;
    std::size_t vertices;
    std::size_t triangles;
};

constexpr Model models[] = {
    // clang-format off
    {"classic/angel-36k.ply", 18412, 35804},
    {"classic/armadillo-100k.ply", 49999, 99994},
    {"classic/armadillo-346k.ply", 172974, 345944},
    {"classic/bunny-closed-100k.ply", 50000, 99996},
    {"classic/bunny-stanford.ply", 35947, 69451},
    {"classic/dragon-202k.ply", 100250, 202520},
    {"classic/dragon-871k.ply", 435545, 871306},
    {"classic/dragon-closed-100k.ply", 50000, 100000},
    {"classic/fertility-60k.ply", 30000, 60012},
    {"classic/happy-buddha-54k.ply", 26986, 54384},
    {"classic/homer.off", 4930, 9856},
    {"classic/horse-97k.ply", 48485, 96966},
    {"classic/igea-269k.ply", 134345, 268686},
    {"classic/lucy-100k.ply", 49987, 99970},
    {"classic/neptune-30k.ply", 14814, 29636},
    {"classic/spot.obj", 2930, 5856},
    {"classic/suzanne.obj", 507, 968},
    {"classic/teapot.obj", 3644, 6320},
    {"classic/turbine-blade-199k.ply", 99519, 199034},
    {"classic/vessel-99k.ply", 49698, 99392},
    {"mechanical/3dbenchy-225k.ply", 112569, 225154},
    {"mechanical/adis16480.off", 3672, 7436},
    {"mechanical/am.off", 3662, 7320},
    {"mechanical/anchor-1k.off", 519, 1050},
    {"mechanical/anchor-7k.off", 3793, 7598},
    {"mechanical/cheese.ply", 8629, 17786},
    {"mechanical/cog-drive-gear.obj", 378, 756},
    {"mechanical/coupling.off", 1841, 3714},
    {"mechanical/crank-35k.ply", 17724, 35492},
    {"mechanical/dragknob.off", 161, 318},
    {"mechanical/fandisk-13k.obj", 6475, 12946},
    {"mechanical/fixed-top.ply", 2374, 4772},
    {"mechanical/gears-7-solids.off", 9723, 19426},
    {"mechanical/handle.off", 1165, 2326},
    {"mechanical/hilbert-cube.obj", 248, 492},
    {"mechanical/idgh-42400.stl", 5500, 11036},
    {"mechanical/ipc-gear.obj", 685, 1226},
    {"mechanical/joint.off", 221, 446},
    {"mechanical/knot.off", 3200, 6400},
    {"mechanical/mechanical-counter-84k.ply", 41837, 83750},
    {"mechanical/nut.obj", 1209, 2418},
    {"mechanical/oblong.off", 422, 840},
    {"mechanical/part.off", 175, 346},
    {"mechanical/pinion.off", 650, 1300},
    {"mechanical/pipe.off", 160, 320},
    {"mechanical/piston.stl", 1070, 2140},
    {"mechanical/plate-holes.stl", 618, 1252},
    {"mechanical/punching-press.off", 2331, 4646},
    {"mechanical/rocker-arm-20k.obj", 10044, 20088},
    {"mechanical/rotor.off", 2400, 4800},
    {"mechanical/screw.obj", 1416, 2828},
    {"mechanical/screwdriver.off", 3395, 6786},
    {"mechanical/snowflake.obj", 1080, 2208},
    {"mechanical/spool.off", 649, 1294},
    {"mechanical/sprocket-20.obj", 1056, 2112},
    {"mechanical/thingi10k-112932.ply", 3932, 7880},
    {"mechanical/thingi10k-520644.ply", 3919, 7834},
    {"mechanical/tray-bottom.off", 2216, 4520},
    {"mechanical/turbine.ply", 9210, 18460},
    {"mechanical/voron-nut-block.ply", 9537, 19082},
    {"mechanical/voron-x-carriage.ply", 12782, 25608},
    {"mechanical/wing-nut.obj", 4268, 8408},
    {"defective/alstom-test4.off", 1138, 2033},
    {"defective/angle-block.stl", 398, 704},
    {"defective/bathtub.obj", 2124, 4375},
    {"defective/bed.obj", 8964, 14042},
    {"defective/beetle-open.obj", 19887, 38656},
    {"defective/blade-open.off", 8231, 16222},
    {"defective/blobby-shuffled.off", 2027, 4050},
    {"defective/boeing-polygon-soup.off", 2741, 2564},
    {"defective/building.ply", 16344, 32245},
    {"defective/busted.stl", 1941, 3878},
    {"defective/chair-double-faced.ply", 3186, 12756},
    {"defective/chair.off", 2564, 1804},
    {"defective/conveyor-near-vertices.stl", 431, 856},
    {"defective/cube-open.off", 9, 10},
    {"defective/cycloidal-drive.ply", 21384, 43368},
    {"defective/degenerated-sd.off", 7068, 13477},
    {"defective/degtri-sliding.off", 8, 8},
    {"defective/elephant-with-holes.off", 2798, 4463},
    {"defective/featuretype.stl", 2010, 3476},
    {"defective/holes.off", 4291, 8288},
    {"defective/hourglass-loose-facet.stl", 1078, 2147},
    {"defective/hourglass-missing-facet.stl", 1075, 2145},
    {"defective/idler-riser.stl", 803, 1572},
    {"defective/joined-tetrahedra.obj", 5, 8},
    {"defective/kettle-duplicates.obj", 1649, 7302},
    {"defective/lion-statue-open.ply", 31825, 63338},
    {"defective/mannequin-devil.ply", 12977, 25888},
    {"defective/mech-holes-shark.off", 5246, 10192},
    {"defective/moebius.obj", 280, 448},
    {"defective/multibody.stl", 20, 32},
    {"defective/non-manifold-face-graph.off", 24, 21},
    {"defective/not-convex.obj", 288, 96},
    {"defective/oblong-shuffled.off", 424, 840},
    {"defective/octagonal-pocket.stl", 1658, 3262},
    {"defective/openscad-nonmanifold-crash.obj", 717, 1442},
    {"defective/pig-open.off", 468, 891},
    {"defective/quads-to-stitch.off", 20, 16},
    {"defective/self-intersecting-40509.ply", 7208, 14370},
    {"defective/shared-edge-cubes.stl", 14, 24},
    {"defective/spheres-intersecting.off", 324, 640},
    {"defective/table.off", 13244, 12500},
    {"defective/test-isect.obj", 642, 1280},
    {"defective/tet-shuffled.off", 4, 4},
    {"defective/tetra-cut-by-triangle.off", 7, 5},
    {"defective/triangle-soup.stl", 300, 100},
    {"defective/triple-vierbein.obj", 75, 108},
    {"defective/truck-open-parts.obj", 2956, 4770},
    {"defective/two-boxes-bad-self-union.ply", 486, 708},
    {"defective/voron-z-motor-mount.ply", 15700, 31436},
    {"boolean-pairs/carve-case2-a.ply", 5, 6},
    {"boolean-pairs/carve-case2-b.ply", 5, 6},
    {"boolean-pairs/carve-cone-down.ply", 39, 74},
    {"boolean-pairs/carve-cone-up.ply", 39, 74},
    {"boolean-pairs/carve-cylinder-x.ply", 76, 148},
    {"boolean-pairs/carve-cylinder-y.ply", 76, 148},
    {"boolean-pairs/carve-cylinder-z.ply", 76, 148},
    {"boolean-pairs/carve-sphere-a.ply", 4902, 9800},
    {"boolean-pairs/carve-sphere-one-point-moved-b.ply", 4902, 9800},
    {"boolean-pairs/cgal-blobby-a.off", 2027, 4050},
    {"boolean-pairs/cgal-eight-b.off", 315, 634},
    {"boolean-pairs/cgal-elephant.off", 2775, 5558},
    {"boolean-pairs/cgal-knot2-two-knots.off", 5760, 11520},
    {"boolean-pairs/cork-ball-a.off", 1900, 3796},
    {"boolean-pairs/cork-ball-b.off", 1900, 3796},
    {"boolean-pairs/ember/1063852.ply", 34274, 68548},
    {"boolean-pairs/ember/1514499.ply", 13350, 26700},
    {"boolean-pairs/ember/1706459.ply", 16965, 33926},
    {"boolean-pairs/ember/472042.ply", 1814, 3632},
    {"boolean-pairs/ember/58011.ply", 13215, 26430},
    {"boolean-pairs/ember/65004.ply", 731, 1466},
    {"boolean-pairs/ember/72214.ply", 830, 1660},
    {"boolean-pairs/ember/73416.ply", 38396, 76840},
    {"boolean-pairs/ember/79741.ply", 7372, 14740},
    {"boolean-pairs/ember/88566.ply", 2624, 5344},
    {"boolean-pairs/ember/908460.ply", 18035, 36074},
    {"boolean-pairs/ember/99865.ply", 35987, 71974},
    {"boolean-pairs/geogram-a.obj", 1996, 4000},
    {"boolean-pairs/geogram-b.obj", 2562, 5120},
    {"boolean-pairs/imrb-bunny-25k.ply", 12500, 24996},
    {"boolean-pairs/imrb-cactus-25k.ply", 12500, 24996},
    {"boolean-pairs/imrb-cow-100k.ply", 50000, 99996},
    {"boolean-pairs/imrb-cow-25k.ply", 12500, 24996},
    {"boolean-pairs/imrb-sphere-a.obj", 1442, 2880},
    {"boolean-pairs/imrb-sphere-b.obj", 1442, 2880},
    {"boolean-pairs/manifold-cray-a.obj", 292, 576},
    {"boolean-pairs/manifold-cray-b.obj", 8, 12},
    {"boolean-pairs/manifold-havocglass-a.obj", 84, 164},
    {"boolean-pairs/manifold-havocglass-b.obj", 8, 12},
    {"boolean-pairs/manifold-hull-a.obj", 2736, 5460},
    {"boolean-pairs/manifold-hull-b.obj", 3996, 7980},
    {"boolean-pairs/manifold-offset12-a.obj", 2287, 4418},
    {"boolean-pairs/manifold-offset12-b.obj", 648, 1116},
    {"boolean-pairs/manifold-offset34-a.obj", 30, 56},
    {"boolean-pairs/manifold-offset34-b.obj", 40, 76},
    {"boolean-pairs/manifold-self-intersect-a.obj", 8582, 17160},
    {"boolean-pairs/manifold-self-intersect-b.obj", 8582, 17160},
    {"boolean-pairs/manifold-twin7081-a.obj", 9874, 19704},
    {"boolean-pairs/manifold-twin7081-b.obj", 5830, 11656},
    {"boolean-pairs/manifold-twin7863-a.obj", 110, 212},
    {"boolean-pairs/manifold-twin7863-b.obj", 126, 244},
    {"boolean-pairs/multi-armabunny.ply", 30000, 59996},
    {"boolean-pairs/multi-classif-1.obj", 24, 36},
    {"boolean-pairs/multi-classif-2.obj", 32, 48},
    {"boolean-pairs/multi-cube-with-8-spheres.ply", 20504, 40972},
    {"boolean-pairs/multi-cucubes.obj", 40, 60},
    {"boolean-pairs/multi-rot-seven-cubes.obj", 64, 96},
    {"boolean-pairs/multi-sphere-icosa.obj", 2574, 5140},
    {"boolean-pairs/multi-three-cubes-coplanar.stl", 24, 36},
    {"boolean-pairs/multi-three-cubes.obj", 24, 36},
    {"boolean-pairs/multi-three-cylinders.obj", 600, 1188},
    {"boolean-pairs/multi-two-cylinders.obj", 400, 792},
    {"boolean-pairs/multi-two-spheres.stl", 804, 1600},
    // clang-format on
};

void PrintTo(const Model& model, std::ostream* stream) { *stream << model.path; }

class ReadModel : public testing::TestWithParam<Model> {};

TEST_P(ReadModel, HasTheCountsOfTheTable) {
    OCTAVO_NEEDS_MODEL(GetParam().path);
    const Result<ReadMesh> read = read_mesh((tests::models_folder() / GetParam().path).string());
    ASSERT_TRUE(read) << read.error().describe();
    EXPECT_EQ(read->mesh.vertices.size(), GetParam().vertices);
    EXPECT_EQ(read->mesh.triangles.size(), GetParam().triangles);
    EXPECT_TRUE(read->warnings.empty()) << read->warnings.front();
    for (const mesh::Triangle& triangle : read->mesh.triangles)
        for (const mesh::VertexIndex corner : triangle) ASSERT_LT(corner, read->mesh.vertices.size());
}

std::string test_name(const testing::TestParamInfo<Model>& info) {
    std::string name = info.param.path;
    for (char& c : name)
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    return name;
}

INSTANTIATE_TEST_SUITE_P(All, ReadModel, testing::ValuesIn(models), test_name);

}  // namespace
}  // namespace octavo::io
