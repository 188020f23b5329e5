// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include <octavo/csg/convex_pieces.hpp>
#include <octavo/csg/normal_form.hpp>
#include <octavo/csg/program.hpp>
#include <octavo/io/openscad_csg.hpp>

namespace octavo::io {
namespace {

CsgReadOptions facets(bool skip = false) {
    CsgReadOptions options;
    options.faceted = true;
    options.skip_unsupported = skip;
    return options;
}

CsgFile read_or_die(const std::string& text, const CsgReadOptions& options = facets()) {
    Result<CsgFile> file = read_csg_text(text, ".", options);
    EXPECT_TRUE(file) << text << "\n" << file.error().describe();
    return file ? std::move(*file) : CsgFile{};
}

/// The volume of a faceted solid whose convex pieces do not overlap, so exact up to doubles.
double volume(const std::string& text) {
    const Result<std::vector<csg::ConvexPiece>> pieces = csg::convex_pieces(read_or_die(text).expression);
    EXPECT_TRUE(pieces) << (pieces ? "" : pieces.error().describe());
    if (!pieces) return -1;
    double sum = 0;
    for (const csg::ConvexPiece& piece : *pieces)
        for (const auto& face : piece.faces)
            for (std::size_t i = 1; i + 1 < face.size(); ++i)
                sum += dot(piece.corners[face[0]], cross(piece.corners[face[i]], piece.corners[face[i + 1]]));
    return sum / 6;
}

Box3 bounds(const std::string& text) { return *csg::tight_bounds(read_or_die(text).expression); }

double prism(int n, double r, double h) { return 0.5 * n * r * r * std::sin(2 * std::acos(-1.0) / n) * h; }

std::string scaled(const std::string& size, const std::string& part, const std::string& z = "") {
    return "multmatrix([[" + size + ", 0, 0, 0], [0, " + size + ", 0, 0], [0, 0, " + (z.empty() ? size : z) +
           ", 0], [0, 0, 0, 1]]) { " + part + " }";
}

TEST(OpenscadCsg, AnyScaleButZeroKeepsASolid) {
    const std::string inside_out =
        "polyhedron(points = [[0, 0, 0], [0, 0, 1], [0, 1, 0], [1, 0, 0]], faces = [[0, 2, 1], [0, 1, 3], "
        "[0, 3, 2], [1, 2, 3]]);";
    for (const std::string size : {"1e-120", "1e-200", "1e110", "1e200"}) {
        for (const std::string& part : {std::string("cube(1);"), std::string("sphere(r = 1);"), inside_out}) {
            const std::string text = scaled(size, part);
            const CsgFile file = read_or_die(text);
            EXPECT_TRUE(file.warnings.empty()) << text << file.warnings[0];
            const Result<csg::Program> program = csg::compile(file.expression);
            ASSERT_TRUE(program) << text << program.error().describe();
            ASSERT_EQ(program->leaves.size(), 1u) << text;
            const csg::Leaf& leaf = program->leaves[0];
            const double width = (leaf.high[0] - leaf.low[0]) * program->lattice.unit();
            EXPECT_NEAR(width / std::stod(size), part.starts_with("sphere") ? 2 : 1, 0.2) << text;
        }
    }
    const CsgFile flat = read_or_die("union() { cube(1);\n" + scaled("1e-120", "cube(1);", "0") + "}");
    ASSERT_EQ(flat.warnings.size(), 1u);
    EXPECT_NE(flat.warnings[0].find("line 2"), std::string::npos) << flat.warnings[0];
    EXPECT_NE(flat.warnings[0].find("flat"), std::string::npos) << flat.warnings[0];
}

TEST(OpenscadCsg, SlicesAreTakenAsTheyAreOrRefusedWithTheLine) {
    const auto slices = [](const std::string& count) {
        return "\nlinear_extrude(height = 1, twist = 360, slices = " + count + ") { square([1, 1]); }";
    };
    const Result<CsgFile> refused = read_csg_text(slices("1000000000"), ".", facets());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::limit);
    EXPECT_EQ(refused.error().place.line, 2u);
    const CsgFile many = read_or_die(slices("150000"));
    ASSERT_EQ(many.expression.operation(), csg::Operation::primitive);
    EXPECT_EQ(std::get<csg::Polyhedron>(many.expression.primitive()).mesh->vertices.size(), 600'004u);
}

TEST(OpenscadCsg, PrimitivesWithoutExtentAreEmptyWithAWarningThatNamesTheLine) {
    for (const char* text : {"cube(size = [-1, 2, 3]);", "cube(0);", "sphere(r = -2);", "sphere(r = 0);",
                             "cylinder(h = -1, r1 = 1, r2 = 1);", "cylinder(h = 1, r1 = 0, r2 = 0);",
                             "linear_extrude(height = 1) { square(size = [0, 1]); }",
                             "linear_extrude(height = 1) { circle(r = -1); }"}) {
        const CsgFile file = read_or_die(std::string("union() {\n  cube(1);\n  ") + text + "\n}\n");
        ASSERT_GE(file.warnings.size(), 1u) << text;
        EXPECT_NE(file.warnings[0].find("line 3"), std::string::npos) << file.warnings[0];
        EXPECT_NE(file.warnings[0].find("must be positive"), std::string::npos) << file.warnings[0];
    }
    EXPECT_TRUE(read_or_die("cube(1);").warnings.empty());
}

TEST(OpenscadCsg, PrimitivesHaveTheVolumesOfOpenscadsPolyhedra) {
    EXPECT_NEAR(volume("cube(size = [1, 2, 3], center = true);"), 6, 1e-12);
    EXPECT_NEAR(volume("cube(2);"), 8, 1e-12);
    EXPECT_NEAR(volume("cube();"), 1, 1e-12);
    EXPECT_NEAR(volume("cylinder($fn = 0, $fa = 12, $fs = 2, h = 5, r1 = 14.4, r2 = 14.4, center = true);"),
                prism(30, 14.4, 5), 1e-9);
    EXPECT_NEAR(volume("cylinder(h = 3, d = 2, $fn = 8);"), prism(8, 1, 3), 1e-12);
    EXPECT_NEAR(volume("cylinder(h = 3, r1 = 2, r2 = 0, $fn = 6);"), prism(6, 2, 1), 1e-12);
    EXPECT_NEAR(volume("cylinder(3, 1, 1, true, $fn = 4);"), prism(4, 1, 3), 1e-12);
    // The figure of OpenSCAD 2021.01 for its ball without poles.
    EXPECT_NEAR(volume("sphere($fn = 6, r = 10);"), 2624.998, 1e-2);
    EXPECT_NEAR(volume("polyhedron(points = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "
                       "faces = [[0,1,2],[0,3,1],[0,2,3],[1,3,2]]);"),
                1.0 / 6, 1e-12);
}

TEST(OpenscadCsg, CircleSegmentsFollowFnFaAndFs) {
    const auto segments = [](const std::string& parameters) {
        const double v = volume("cylinder(h = 1, " + parameters + ");");
        double r = 1;
        if (const std::size_t at = parameters.find("r = "); at != std::string::npos)
            r = std::stod(parameters.substr(at + 4));
        for (int n = 3; n < 1000; ++n)
            if (std::fabs(v - prism(n, r, 1)) < 1e-9 * r * r) return n;
        return 0;
    };
    EXPECT_EQ(segments("r = 1"), 5);
    EXPECT_EQ(segments("r = 5"), 16);              // 2π5/2 = 15.7
    EXPECT_EQ(segments("r = 100"), 30);            // 360/12
    EXPECT_EQ(segments("r = 100, $fa = 1"), 315);  // 2π100/2 = 314.2
    EXPECT_EQ(segments("r = 100, $fn = 7.9"), 7);  // truncated
    EXPECT_EQ(segments("r = 100, $fn = 1"), 3);
    EXPECT_EQ(segments("r = 10, $fs = 0.5, $fa = 5"), 72);
}

TEST(OpenscadCsg, ASphereHasRingsButNoPoles) {
    const Box3 box = bounds("sphere(r = 10, $fn = 8);");
    EXPECT_NEAR(box.high.z, 10 * std::cos(std::acos(-1.0) / 8), 1e-12);
    EXPECT_NEAR(box.high.x, 10 * std::sin(3 * std::acos(-1.0) / 8), 1e-12);
}

TEST(OpenscadCsg, TreesMeanWhatTheyMeanInOpenscad) {
    const std::string a = "cube(4);",
                      b = "multmatrix([[1,0,0,2],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(4); }";
    EXPECT_NEAR(volume("difference() { " + a + b + "}"), 32, 1e-9);
    EXPECT_NEAR(volume("intersection() { " + a + b + "}"), 32, 1e-9);
    EXPECT_NEAR(volume("difference() { cube(0); " + a + "}"), 0, 1e-12);
    EXPECT_NEAR(volume("difference() { group(); " + a + "}"), 0, 1e-12);
    EXPECT_NEAR(volume("difference() { %cube(9); " + a + b + "}"), 32, 1e-9);  // % is not there
    EXPECT_NEAR(volume("difference() { " + a + "*" + b + "}"), 64, 1e-9);
    EXPECT_NEAR(volume("intersection() { " + a + "cube([1, 0, 1]); }"), 0, 1e-12);
    EXPECT_NEAR(volume("union() { cube(0); " + a + "}"), 64, 1e-9);
    EXPECT_NEAR(volume("group() { cube(9); !" + b + "}"), 64, 1e-9);  // ! without what is around it
    EXPECT_NEAR(
        bounds("group() { multmatrix([[9,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { !cube(2); } }").high.x, 2,
        1e-12);
    EXPECT_NEAR(volume("color([1, 0, 0, 1]) { render(convexity = 2) { #" + a + "} }"), 64, 1e-9);
    EXPECT_NEAR(volume("// a comment\n/* another */ cube(/* in */ 4); // end"), 64, 1e-9);
    EXPECT_NEAR(volume("multmatrix([[-1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube([1,2,3]); }"), 6,
                1e-12);
    EXPECT_NEAR(volume("multmatrix([[1,0,0,0],[0,1,0,0],[0,0,0,0],[0,0,0,1]]) { cube(3); }"), 0, 1e-12);
    EXPECT_NEAR(volume("translate([1,2,3]) { rotate(a = [10, 20, 30]) { scale([1, 2, 3]) { mirror([1, 1, 0]) "
                       "{ cube(1); } } } }"),
                6, 1e-9);
}

TEST(OpenscadCsg, AxesMayHaveAnyLength) {
    for (const std::string length : {"1", "1e-200", "1e-310", "1e200", "1e308"}) {
        const Box3 mirrored = bounds("mirror([" + length + ",0,0]) { cube([1,2,3]); }");
        EXPECT_NEAR(mirrored.low.x, -1, 1e-12) << length;
        EXPECT_NEAR(mirrored.high.y, 2, 1e-12) << length;
        const Box3 turned = bounds("rotate(a = 90, v = [0,0," + length + "]) { cube([1,2,3]); }");
        EXPECT_NEAR(turned.low.x, -2, 1e-12) << length;
        EXPECT_NEAR(turned.high.y, 1, 1e-12) << length;
    }
}

TEST(OpenscadCsg, FlatPartsBecomeSolidsByExtrusion) {
    EXPECT_NEAR(volume("linear_extrude(height = 3) { square(size = [2, 5], center = false); }"), 30, 1e-9);
    EXPECT_NEAR(volume("linear_extrude(height = 3, scale = 0) { square(2); }"), 4, 1e-9);
    // A path inside another is a hole.
    EXPECT_NEAR(volume("linear_extrude(height = 1) { polygon(points = "
                       "[[0,0],[9,0],[9,9],[0,9],[3,3],[6,3],[6,6],[3,6]], "
                       "paths = [[0,1,2,3],[4,5,6,7]], convexity = 1); }"),
                72, 1e-6);
    EXPECT_NEAR(
        volume(
            "linear_extrude(height = 1) { difference() { square(4); translate([1,1,0]) { square(2); } } }"),
        12, 1e-6);
    EXPECT_NEAR(
        volume(
            "linear_extrude(height = 1) { intersection() { square(4); translate([1,1,0]) { square(9); } } }"),
        9, 1e-6);
    EXPECT_NEAR(
        volume("linear_extrude(height = 1) { hull() { square(1); translate([3,0,0]) { square(1); } } }"), 4,
        1e-9);
    EXPECT_NEAR(volume("linear_extrude(height = 1) { offset(delta = 1) { square(2); } }"), 16, 1e-6);
    EXPECT_NEAR(volume("linear_extrude(height = 1) { offset(delta = 1, chamfer = true) { square(2); } }"),
                16 - 4 * (3 - 2 * std::sqrt(2.0)), 1e-6);
    EXPECT_NEAR(volume("linear_extrude(height = 1) { offset(r = -0.5) { square(2); } }"), 1, 1e-6);
    EXPECT_NEAR(volume("linear_extrude(height = 1) { minkowski() { square(2); square(1); } }"), 9, 1e-6);
    EXPECT_NEAR(
        volume(
            "linear_extrude(height = 1) { resize(newsize = [6, 0], auto = [false, true]) { square(2); } }"),
        36, 1e-6);
    EXPECT_NEAR(
        volume("linear_extrude(height = 1) { projection(cut = true) { translate([0,0,-1]) { cube(3); } } }"),
        9, 1e-5);
    EXPECT_NEAR(
        volume("linear_extrude(height = 1) { projection(cut = false) { translate([0,0,7]) { cube(3); } } }"),
        9, 1e-5);
    EXPECT_NEAR(volume("rotate_extrude($fn = 8) { translate([1,0,0]) { square(1); } }"),
                prism(8, 2, 1) - prism(8, 1, 1), 1e-6);
    EXPECT_NEAR(volume("rotate_extrude(angle = 90, $fn = 8) { square(1); }"), prism(8, 1, 1) / 4, 1e-9);
    EXPECT_NEAR(volume("rotate_extrude(angle = -90, $fn = 8) { square(1); }"), prism(8, 1, 1) / 4, 1e-9);
    EXPECT_NEAR(volume("rotate_extrude($fn = 8) { translate([-2,0,0]) { square(1); } }"),
                prism(8, 2, 1) - prism(8, 1, 1), 1e-6);
}

TEST(OpenscadCsg, TwistedExtrusionsHaveTheVolumesOfOpenscad) {
    // Figures of OpenSCAD 2021.01.
    const std::string square = " { square(size = [10, 4], center = true); }";
    EXPECT_NEAR(volume("linear_extrude(height = 20, twist = 90, slices = 4)" + square), 927.672, 1e-2);
    EXPECT_NEAR(volume("linear_extrude(height = 20, twist = -90, slices = 4)" + square), 927.672, 1e-2);
    EXPECT_NEAR(volume("linear_extrude(height = 20, twist = 90, slices = 4, scale = [1, 0.2])" + square),
                538.311, 1e-2);
}

TEST(OpenscadCsg, SumsHullsAndResizing) {
    EXPECT_NEAR(volume("minkowski() { cube(2); cube(1); }"), 27, 1e-9);
    EXPECT_NEAR(volume("hull() { cube(1); translate([3,0,0]) { cube(1); } }"), 4, 1e-9);
    EXPECT_NEAR(volume("hull() { difference() { cube(3); translate([1,1,1]) { cube(9); } } }"), 27 - 4.0 / 3,
                1e-6);
    EXPECT_NEAR(volume("resize(newsize = [4, 0, 0], auto = [true, true, false]) { cube([2, 3, 5]); }"),
                4 * 6 * 5, 1e-9);
    EXPECT_NEAR(
        volume(
            "resize(newsize = [1, 1, 1]) { difference() { cube(4); translate([2, -1, -1]) { cube(9); } } }"),
        1, 1e-6);
    // The sum with a solid that is not convex: an L of three cubes.
    EXPECT_NEAR(
        bounds("minkowski() { difference() { cube(2); translate([1,1,-1]) { cube(4); } } cube(1); }").high.x,
        3, 1e-9);
}

TEST(OpenscadCsg, RoundThingsStayRoundUnlessFacetsAreAskedFor) {
    const auto kinds = [](const std::string& text, bool faceted) {
        CsgReadOptions options;
        options.faceted = faceted;
        const Result<csg::NormalForm> form = csg::normal_form(read_or_die(text, options).expression);
        std::string result;
        for (const csg::PlacedPrimitive& leaf : form->leaves)
            result += static_cast<char>('0' + leaf.primitive->index());
        std::sort(result.begin(), result.end());
        return result;
    };
    EXPECT_EQ(kinds("sphere(1);", false), "1");
    EXPECT_EQ(kinds("sphere(1);", true), "6");
    EXPECT_EQ(kinds("cylinder(h = 1, r = 1);", false), "2");
    EXPECT_EQ(kinds("hull() { sphere(1); }", false), "6");
    EXPECT_EQ(kinds("rotate_extrude() { translate([1,0,0]) { square(1); } }", false), "22");
    EXPECT_EQ(kinds("rotate_extrude(angle = 90) { square(1); }", false), "244");
}

// --- Errors -----------------------------------------------------------------------------------------------------

struct Bad {
    const char* text;
    ErrorCode code;
    std::uint64_t line, column;
    const char* says;
};

TEST(OpenscadCsg, SaysWhatIsWrongAndWhere) {
    const Bad cases[] = {
        {"", ErrorCode::bad_input, 1, 1, "no node"},
        {"union() {\n\tcube(1);\n", ErrorCode::bad_input, 1, 1, "never closed"},
        {"cube(1);\n}", ErrorCode::bad_input, 2, 1, "closes nothing"},
        {"cube(1)", ErrorCode::bad_input, 1, 8, "expected ';' or '{'"},
        {"cube(1;", ErrorCode::bad_input, 1, 7, "expected ',' or ')'"},
        {"union() {\n  qube(1);\n}", ErrorCode::bad_input, 2, 3, "'qube'"},
        {"cube(size = [1, 2, nan]);", ErrorCode::bad_input, 1, 6, "finite"},
        {"sphere(r = -inf);", ErrorCode::bad_input, 1, 8, "finite"},
        {"cube(size = [1, 2, [3]);", ErrorCode::bad_input, 1, 23, "in a vector"},
        {"cube(size = size);", ErrorCode::bad_input, 1, 13, "'size' is no value"},
        {"cube(size = \"big\");", ErrorCode::bad_input, 1, 6, "must be"},
        {"multmatrix([1, 2]) { cube(1); }", ErrorCode::bad_input, 1, 12, "vector of vectors"},
        {"cube(1); /* open", ErrorCode::bad_input, 1, 10, "comment"},
        {"group() {\n text(text = \"Hi \"x\"\\ \", size = 10); }", ErrorCode::unsupported, 2, 2, "text"},
        {"surface(file = \"a.png\", center = false);", ErrorCode::unsupported, 1, 1, "surface"},
        {"import(file = \"nowhere.stl\");", ErrorCode::unsupported, 1, 1, "nowhere.stl"},
        {"square(1);", ErrorCode::not_a_solid, 1, 1, "flat"},
        {"polyhedron(points = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], faces = [[0,1,2],[0,3,1],[0,2,3]]);",
         ErrorCode::not_a_solid, 1, 1, "do not close"},
        {"rotate_extrude() { square(1, center = true); }", ErrorCode::bad_input, 1, 1, "both sides"},
        {"linear_extrude(1) { scale([1e200, 1]) { scale([1e200, 1]) { square(1); } } }", ErrorCode::limit, 1,
         21, "beyond what a double can hold"},
        {"123", ErrorCode::bad_input, 1, 1, "name of a node"},
        // The first of several.
        {"union() {\n cube(size = nan);\n sphere(r = inf);\n}", ErrorCode::bad_input, 2, 7, "finite"},
        {"cube", ErrorCode::bad_input, 1, 5, "expected '('"},
        {"cube(", ErrorCode::bad_input, 1, 6, "ends"},
        {"\xFF\xFE\x00", ErrorCode::bad_input, 1, 1, "name of a node"},
    };
    for (const Bad& bad : cases) {
        const Result<CsgFile> file = read_csg_text(bad.text, ".", facets());
        ASSERT_FALSE(file) << bad.text;
        EXPECT_EQ(file.error().code, bad.code) << bad.text;
        EXPECT_EQ(file.error().place.line, bad.line) << bad.text << "\n" << file.error().describe();
        EXPECT_EQ(file.error().place.column, bad.column) << bad.text << "\n" << file.error().describe();
        EXPECT_NE(file.error().sentence.find(bad.says), std::string::npos) << file.error().describe();
    }
}

TEST(OpenscadCsg, SkippingWhatIsUnsupportedLeavesWarnings) {
    const CsgFile file = read_or_die(
        "union() {\n\ttext(text = \"a);\", size = 3);\n\tcube(2);\n\timport(file = \"no.stl\");\n}",
        facets(true));
    ASSERT_EQ(file.warnings.size(), 2U);
    EXPECT_NE(file.warnings[0].find("line 2, column 2"), std::string::npos) << file.warnings[0];
    EXPECT_NE(file.warnings[1].find("line 4, column 2"), std::string::npos) << file.warnings[1];
    EXPECT_NEAR(csg::tight_bounds(file.expression)->high.x, 2, 1e-12);
}

TEST(OpenscadCsg, AMillionLevelsAreReadAndTooManyNodesRefused) {
    std::string deep;
    const int levels = 1'000'000;
    for (int i = 0; i < levels; ++i) deep += i % 2 ? "union(){" : "difference(){";
    deep += "cube(1);";
    deep.append(levels, '}');
    const CsgFile file = read_or_die(deep);
    EXPECT_EQ(file.nodes, 1'000'001U);
    EXPECT_TRUE(csg::normal_form(file.expression));
    CsgReadOptions options;
    options.most_nodes = 1000;
    EXPECT_EQ(read_csg_text(deep, ".", options).error().code, ErrorCode::bad_input);
    EXPECT_EQ(read_csg_text(std::string(1'000'000, '{')).error().code, ErrorCode::bad_input);
    const Result<CsgFile> vectors = read_csg_text("cube(" + std::string(1'000'000, '['));
    EXPECT_EQ(vectors.error().code, ErrorCode::bad_input);
    EXPECT_EQ(vectors.error().place.column, 70U);
}

TEST(OpenscadCsg, LongVectorsStopAtTheLimit) {
    std::string text = "polyhedron(points = [";
    for (int i = 0; i < 100'000; ++i) text += "[0,0,0],";
    text += "[0,0,0]], faces = [[0,1,2]]);";
    CsgReadOptions options;
    options.most_values = 50'000;
    const Result<CsgFile> file = read_csg_text(text, ".", options);
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error().code, ErrorCode::bad_input);
    EXPECT_EQ(file.error().place.line, 1U);
    EXPECT_GT(file.error().place.column, 20U);
}

TEST(OpenscadCsg, AbsurdSegmentCountsAreRefusedBeforeTheyAreBuilt) {
    for (const char* text :
         {"sphere(r = 1, $fn = 1000000);",
          "linear_extrude(height = 1, slices = 99999) { circle(1, $fn = 99999); }",
          "cylinder($fn = 1e9, h = 1, r = 1);", "linear_extrude(height = 1) { circle($fn = 1e9, r = 1); }",
          "linear_extrude(height = 1) { offset(r = 1, $fn = 1e9) { circle($fn = 10, r = 1); } }",
          "rotate_extrude($fn = 1e9) { translate([2, 0, 0]) { circle(1, $fn = 8); } }",
          "rotate_extrude($fn = 99999) { translate([2, 0, 0]) { circle(1, $fn = 99999); } }"}) {
        const Result<CsgFile> file = read_csg_text(text, ".", facets());
        ASSERT_FALSE(file) << text;
        EXPECT_EQ(file.error().code, ErrorCode::limit) << text;
        EXPECT_EQ(file.error().place.line, 1U);
    }
    // Truly round things need no segments.
    EXPECT_TRUE(read_csg_text("sphere(r = 1, $fn = 1e9);"));
    EXPECT_TRUE(read_csg_text("cylinder(h = 1, r = 1, $fn = 1e9);"));
    EXPECT_TRUE(read_csg_text("rotate_extrude($fn = 1e9) { translate([2, 0, 0]) { square(1); } }"));
    EXPECT_TRUE(read_csg_text("cylinder(h = 1, r = 1, $fn = 5000);", ".", facets()));
}

TEST(OpenscadCsg, ImportsAreFoundBesideTheFile) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "octavo_csg_import_test";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "tetra.off")
        << "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
    std::ofstream(folder / "a.csg")
        << "import(file = \"tetra.off\", layer = \"\", origin = [0, 0], scale = 1);\n";
    const Result<CsgFile> file = read_csg((folder / "a.csg").string());
    ASSERT_TRUE(file) << file.error().describe();
    EXPECT_NEAR(csg::tight_bounds(file->expression)->high.z, 1, 1e-12);
    const Result<CsgFile> missing = read_csg((folder / "b.csg").string());
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().code, ErrorCode::io);
    std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace octavo::io
