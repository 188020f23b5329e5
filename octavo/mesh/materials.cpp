// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include <octavo/mesh/materials.hpp>

namespace octavo::mesh {

Materials materials_of(const HexMesh& mesh) {
    std::vector<bool> occurs(mesh.sets.size(), false);
    for (const std::uint16_t set : mesh.set_of_cell) occurs[set] = true;
    std::vector<std::vector<SolidIndex>> solids_of_set;
    std::map<std::vector<SolidIndex>, std::uint32_t> numbers;
    for (std::size_t i = 0; i < mesh.sets.size(); ++i) {
        std::vector<SolidIndex>& solids = solids_of_set.emplace_back(mesh.sets[i].inside);
        solids.insert(solids.end(), mesh.sets[i].boundary.begin(), mesh.sets[i].boundary.end());
        std::sort(solids.begin(), solids.end());
        if (occurs[i]) numbers.emplace(solids, 0);
    }
    Materials materials;
    for (auto& [solids, number] : numbers) {
        number = static_cast<std::uint32_t>(materials.solids.size());
        materials.solids.push_back(solids);
    }
    for (const auto& solids : solids_of_set) {
        const auto found = numbers.find(solids);
        materials.of_set.push_back(found == numbers.end() ? 0 : found->second);
    }
    return materials;
}

}  // namespace octavo::mesh
