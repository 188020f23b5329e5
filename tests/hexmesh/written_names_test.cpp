// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include <octavo/hexmesh/conforming.hpp>
#include <octavo/hexmesh/to_polyhedra.hpp>
#include <octavo/io/abaqus.hpp>
#include <octavo/io/gmsh.hpp>
#include <octavo/io/openfoam.hpp>

#include "hexmesh/folder.hpp"
#include "hexmesh/written_meshes.hpp"

// Names of materials in files: each format has rules of its own, and no two may become one.

namespace octavo::hexmesh {
namespace {

/// What comes after `word` in the lines of a text that have it, without what follows the name.
std::vector<std::string> names_after(const std::string& word, const std::string& text) {
    std::vector<std::string> names;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
        const std::size_t begin = at + word.size();
        names.push_back(text.substr(begin, text.find_first_of(",\n", begin) - begin));
    }
    return names;
}

std::size_t distinct(const std::vector<std::string>& names) {
    return std::set<std::string>(names.begin(), names.end()).size();
}

/// Boxes in a row, of which neighbours overlap, and one beside them, with cells outside.
mesh::HexMesh row_of_boxes() {
    const std::vector<mesh::Mesh> solids{mesh::box({0, 0, 0}, {2, 1, 1}), mesh::box({1, 0, 0}, {3, 1, 1}),
                                         mesh::box({4, 0, 0}, {5, 1, 1})};
    const Result<Built> built = build(solids, {.precision = 0.5, .keep = Keep::all});
    EXPECT_TRUE(built);
    return built->mesh;
}

/// Names that a format spells alike, or as it calls overlaps or the outside.
const std::vector<std::vector<std::string>> names_alike{
    {"a", "b", "a_and_b"},
    {"a", "b", "a+b"},
    {"a-b", "a_b", "a b"},
    {"outside", "7up", "S7UP"},
    {std::string(90, 'x') + "1", std::string(90, 'x') + "2", "c"}};

TEST(WriteAbaqus, GivesNoTwoMaterialsOneName) {
    const mesh::HexMesh mesh = row_of_boxes();
    for (const std::vector<std::string>& names : names_alike) {
        const Folder folder;
        ASSERT_TRUE(io::write_abaqus((folder / "m.inp").string(), mesh, {.names = names}));
        const std::string text = text_of(folder / "m.inp");
        const std::vector<std::string> sets = names_after("ELSET=", text);
        EXPECT_EQ(sets.size(), 5u);
        EXPECT_EQ(distinct(sets), 5u) << names[0];
        for (const std::string& surface : names_after("ELEMENT, NAME=", text)) {
            EXPECT_EQ(surface.rfind("SURFACE_OF_", 0), 0u);
            EXPECT_LE(surface.size(), 80u);
            EXPECT_EQ(std::count(sets.begin(), sets.end(), surface.substr(11)), 1) << surface;
        }
    }
}

TEST(WriteGmsh, GivesNoTwoGroupsOneName) {
    const std::vector<mesh::Mesh> solids{mesh::box({0, 0, 0}, {2, 1, 1}), mesh::box({1, 0, 0}, {3, 1, 1}),
                                         mesh::box({4, 0, 0}, {5, 1, 1})};
    const Result<Built> built = build_conforming(solids, {.precision = 0.5});
    ASSERT_TRUE(built);
    const Folder folder;
    const std::string names[] = {"a\"", "a_", "a_+a__2"};
    ASSERT_TRUE(io::write_gmsh((folder / "m.msh").string(), built->mesh, names));
    const std::vector<std::string> volumes = names_after("\n3 ", text_of(folder / "m.msh"));
    EXPECT_EQ(volumes,
              (std::vector<std::string>{"1 \"a_\"", "2 \"a_+a__2_2\"", "3 \"a__2\"", "4 \"a_+a__2\""}));
}

TEST(WriteOpenFoam, GivesNoTwoZonesOrPatchesOneName) {
    const mesh::HexMesh mesh = row_of_boxes();
    for (const std::vector<std::string>& names : names_alike) {
        const Folder folder;
        ASSERT_TRUE(io::write_openfoam(folder.string(), to_polyhedra(mesh, names)));
        for (const auto& [file, after_name] : {std::pair("cellZones", "\n{\n    type cellZone"),
                                               std::pair("boundary", "\n    {\n        type ")}) {
            const std::string text = text_of(folder / "constant/polyMesh" / file);
            std::vector<std::string> found;
            for (std::size_t at = text.find(after_name); at != std::string::npos;
                 at = text.find(after_name, at + 1)) {
                const std::size_t begin = text.find_last_of(" \n", at - 1) + 1;
                found.push_back(text.substr(begin, at - begin));
            }
            EXPECT_EQ(distinct(found), found.size()) << file << names[0];
            EXPECT_GE(found.size(), std::string(file) == "boundary" ? 1u : 5u);
        }
    }
}

}  // namespace
}  // namespace octavo::hexmesh
