// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <octavo/mesh/materials.hpp>

// Names of solids and materials as a format of files takes them, no two alike: solvers join sets of one name without a
// word, and so the materials in them.
//
// Formats allow few characters, or one case, or short names, so files with different names may be spelled alike, and a
// file may be called as an overlap is: `a-b` and `a_b`; `a_and_b` beside `a` and `b`; `outside`. The first keeps its
// spelling, later ones get "_2", "_3", …, and none of these is a spelling that another one has by itself. Solids
// come first, in their order, whether they have cells or not; then "outside"; then overlaps, which are made of the
// solids' names as spelled. So the name of a solid depends on the names of the solids alone, not on the mesh.

namespace octavo::mesh {

/// How a format spells names.
struct NameRules {
    std::string joint = "+";         ///< between the solids of an overlap
    bool (*allows)(char) = nullptr;  ///< other characters become '_'; null allows all
    bool upper_case = false;
    std::string before_other_than_letters;    ///< goes before a name that begins with no letter
    std::size_t longest = std::string::npos;  ///< in bytes; what is longer is cut
};

/// Words as finite-volume codes take them: letters, digits and "_+-.", a letter first.
NameRules word_rules();

/// The names as the rules spell them, no two alike.
std::vector<std::string> distinct_names(std::span<const std::string> wanted, const NameRules& rules = {});

struct MaterialNames {
    std::vector<std::string> solids;  ///< of each, also of those without cells
    std::string outside;              ///< of what is in no solid
    std::vector<std::string>
        materials;  ///< of each: its solid's, "a+b" for an overlap, or that of the outside
};

/// Solids without a name in `names` are called solid_0, solid_1, …
MaterialNames name_materials(const Materials& materials, std::span<const std::string> names,
                             const NameRules& rules);

}  // namespace octavo::mesh
