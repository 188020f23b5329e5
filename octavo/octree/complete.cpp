// SPDX-License-Identifier: Apache-2.0
#include <octavo/octree/complete.hpp>

namespace octavo::octree {

std::vector<CellKey> complete(std::span<const CellKey> cells) {
    std::vector<CellKey> leaves;
    std::size_t next = 0;
    const auto visit = [&](const auto& self, CellKey cell) -> void {
        const bool is_gap = next == cells.size() || !cell.contains(cells[next]);
        if (is_gap || cell == cells[next]) {
            next += !is_gap;
            leaves.push_back(cell);
            return;
        }
        for (int octant = 0; octant < 8; ++octant) self(self, cell.child(octant));
    };
    visit(visit, CellKey::root());
    return leaves;
}

}  // namespace octavo::octree
