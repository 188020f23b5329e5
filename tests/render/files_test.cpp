// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <iterator>
#include <string>

#include <pugixml.hpp>

#include <octavo/mesh/shapes.hpp>
#include <octavo/render/cairo_drawing.hpp>
#include <octavo/render/hidden_parts.hpp>
#include <octavo/render/svg.hpp>

#include "io/folder.hpp"
#include "render/views.hpp"

namespace octavo::render {
namespace {

std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

Drawing drawing_of_a_box() {
    const Scene box = scene_of(mesh::box({0, 0, 0}, {3, 2, 1}));
    const Camera camera = tests::camera_for(box, {}, 400, 300);
    return *remove_hidden_parts(box, camera,
                                {.width = 400, .height = 300, .hidden_lines = HiddenLines::dash});
}

TEST(Svg, HasOneGroupForEachKindAndOnePathForEachFace) {
    const io::Folder folder;
    ASSERT_TRUE(write_svg(folder / "a.svg", drawing_of_a_box()));
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file((folder / "a.svg").c_str()));
    const pugi::xml_node svg = document.child("svg");
    EXPECT_STREQ(svg.attribute("viewBox").value(), "0 0 400 300");
    std::vector<std::string> groups;
    for (const pugi::xml_node& group : svg.children("g")) groups.emplace_back(group.attribute("id").value());
    EXPECT_EQ(groups, (std::vector<std::string>{"faces", "hidden-lines", "edges"}));
    const pugi::xml_node faces = svg.child("g");
    EXPECT_EQ(std::distance(faces.begin(), faces.end()), 3);
    EXPECT_LT(text_of(folder / "a.svg").size(), 2000U);
}

TEST(Svg, WritesCoordinatesShortAndExactly) {
    Drawing drawing{10, 10, palette::paper, {}, {}, {}, 1.2};
    drawing.regions.push_back({{1, 0, 0.5F}, {{{5, 100}, {-295, 1234}, {705, 1230}}}});
    drawing.edges.push_back({palette::ink, {{{0, 0}, {100, 0}, {100, 50}, {0, 0}}, {{250, 0}, {300, 0}}}});
    const io::Folder folder;
    ASSERT_TRUE(write_svg(folder / "a.svg", drawing));
    const std::string text = text_of(folder / "a.svg");
    EXPECT_NE(text.find("fill=\"#ff0080\""), std::string::npos) << text;
    EXPECT_NE(text.find("d=\"M.05 1l-3 11.34 10-.04z\""), std::string::npos) << text;
    EXPECT_NE(text.find("d=\"M0 0l1 0 0 .5z\""), std::string::npos) << text;
    EXPECT_NE(text.find("d=\"M2.5 0l.5 0\""), std::string::npos) << text;
}

TEST(Pdf, IsOneAndTheSameEveryTime) {
    const io::Folder folder;
    ASSERT_TRUE(write_pdf(folder / "a.pdf", drawing_of_a_box()));
    ASSERT_TRUE(write_pdf(folder / "b.pdf", drawing_of_a_box()));
    const std::string text = text_of(folder / "a.pdf");
    EXPECT_EQ(text.substr(0, 5), "%PDF-");
    EXPECT_EQ(text, text_of(folder / "b.pdf"));
    EXPECT_EQ(text.find("CreationDate"), std::string::npos);
    EXPECT_NE(text.find("[ 0 0 300 225 ]"), std::string::npos);
}

TEST(Files, AreNotLeftHalfWritten) {
    const io::Folder folder;
    EXPECT_FALSE(write_svg(folder / "no/a.svg", drawing_of_a_box()));
    EXPECT_FALSE(write_pdf(folder / "no/a.pdf", drawing_of_a_box()));
    EXPECT_EQ(folder.files(), 0U);
}

TEST(Paint, FillsAreasAndDrawsLinesOverThem) {
    Drawing drawing{20, 20, palette::paper, {}, {}, {}, 2};
    drawing.regions.push_back({{1, 0, 0}, {{{0, 0}, {1000, 0}, {1000, 2000}, {0, 2000}}}});
    drawing.regions.push_back({{0, 0, 1}, {{{1000, 0}, {2000, 0}, {2000, 2000}, {1000, 2000}}}});
    drawing.edges.push_back({{0, 0, 0}, {{{0, 1500}, {2000, 1500}}}});
    const Image image = *paint(drawing);
    EXPECT_EQ(image.at(4, 4), (Color{1, 0, 0}));
    EXPECT_EQ(image.at(15, 4), (Color{0, 0, 1}));
    EXPECT_EQ(image.at(4, 14), (Color{0, 0, 0}));
    // No seam of paper between the areas.
    for (const int column : {9, 10}) EXPECT_EQ(image.at(column, 4).green, 0);
}

TEST(Paint, PutsLargePicturesTogetherFromTiles) {
    Drawing drawing{1500, 1100, palette::paper, {}, {}, {}, 2};
    drawing.regions.push_back({{1, 0, 0}, {{{0, 0}, {150000, 0}, {150000, 110000}, {0, 110000}}}});
    const Image image = *paint(drawing);
    for (int row = 0; row < image.height; row += 3)
        for (int column = 0; column < image.width; column += 3)
            ASSERT_EQ(image.at(column, row), (Color{1, 0, 0})) << column << ' ' << row;
}

}  // namespace
}  // namespace octavo::render
