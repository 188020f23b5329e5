// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include <octavo/hexmesh/cell_template.hpp>
#include <octavo/hexmesh/quality.hpp>
#include <octavo/mesh/hex_sides.hpp>

namespace octavo::hexmesh {
namespace {

using Square = std::set<TemplatePoint>;

CellCorners corners_of_hex(const TemplateHex& hex) {
    CellCorners corners;
    for (std::size_t i = 0; i < 8; ++i)
        corners[i] = {static_cast<double>(hex[i][0]), static_cast<double>(hex[i][1]),
                      static_cast<double>(hex[i][2])};
    return corners;
}

/// How many hexahedra have each square.
std::map<Square, int> squares_of(const std::vector<TemplateHex>& hexes) {
    std::map<Square, int> squares;
    for (const TemplateHex& hex : hexes)
        for (const auto& side : mesh::corners_of_side) {
            Square square;
            for (const std::uint8_t corner : side) square.insert(hex[corner]);
            ++squares[square];
        }
    return squares;
}

bool lies_in_side(const Square& square, std::size_t axis, std::int64_t at) {
    return std::all_of(square.begin(), square.end(), [&](const TemplatePoint& p) { return p[axis] == at; });
}

/// The cut edges of a face, and the face's squares, with the face's axis left out.
using FacePattern = std::pair<unsigned, std::set<std::set<std::array<std::int64_t, 2>>>>;

FacePattern on_face(EdgeSet cut, const std::map<Square, int>& squares, std::size_t normal, unsigned end) {
    FacePattern pattern;
    const std::size_t first = std::min((normal + 1) % 3, (normal + 2) % 3), second = 3 - normal - first;
    for (const std::size_t along : {first, second})
        for (unsigned place = 0; place < 4; ++place) {
            const unsigned b = place & 1, c = place >> 1;
            const bool normal_is_b = (along + 1) % 3 == normal;
            if ((normal_is_b ? b : c) != end) continue;
            const unsigned other = normal_is_b ? c : b;
            if (cut >> (4 * along + place) & 1) pattern.first |= 1U << (2 * (along == second) + other);
        }
    for (const auto& [square, count] : squares) {
        if (!lies_in_side(square, normal, end * template_side)) continue;
        std::set<std::array<std::int64_t, 2>> flat;
        for (const TemplatePoint& p : square) flat.insert({p[first], p[second]});
        pattern.second.insert(flat);
    }
    return pattern;
}

TEST(CutCell, ConformsInsideAndIsPositiveEverywhere) {
    int templates = 0;
    double least = 1;
    for (unsigned cut = 0; cut < 4096; ++cut) {
        const std::vector<TemplateHex> hexes = cut_cell(static_cast<EdgeSet>(cut));
        if (hexes.empty()) continue;
        ++templates;
        for (const TemplateHex& hex : hexes) {
            ASSERT_TRUE(is_positive_everywhere(corners_of_hex(hex))) << cut;
            least = std::min(least, scaled_jacobian(corners_of_hex(hex)));
        }
        for (const auto& [square, count] : squares_of(hexes)) {
            bool outside = false;
            for (std::size_t axis = 0; axis < 3; ++axis)
                for (const std::int64_t at : {std::int64_t{0}, template_side})
                    outside = outside || lies_in_side(square, axis, at);
            ASSERT_EQ(count, outside ? 1 : 2) << cut;
        }
    }
    EXPECT_EQ(cut_cell(0).size(), 1u);
    EXPECT_EQ(cut_cell(1).size(), 5u);
    EXPECT_GT(templates, 2000);
    EXPECT_GT(least, 0.13);
}

TEST(CutCell, DividesAFaceByTheCutEdgesOfThatFaceAlone) {
    // All faces of all templates, looked at along their axis: with the same edges cut they have the same squares. So do
    // faces of different axes, which neighbours never share; it is enough that high and low faces of one axis agree.
    std::array<std::map<unsigned, FacePattern>, 3> seen;
    for (unsigned cut = 0; cut < 4096; ++cut) {
        const std::vector<TemplateHex> hexes = cut_cell(static_cast<EdgeSet>(cut));
        if (hexes.empty()) continue;
        const auto squares = squares_of(hexes);
        for (std::size_t normal = 0; normal < 3; ++normal)
            for (const unsigned end : {0U, 1U}) {
                const FacePattern pattern = on_face(static_cast<EdgeSet>(cut), squares, normal, end);
                const auto [at, fresh] = seen[normal].try_emplace(pattern.first, pattern);
                ASSERT_EQ(at->second.second, pattern.second) << cut;
            }
    }
    for (const auto& patterns : seen) {
        EXPECT_EQ(patterns.size(), 16u);
        EXPECT_EQ(patterns.at(15).second.size(), 9u);
    }
}

}  // namespace
}  // namespace octavo::hexmesh
