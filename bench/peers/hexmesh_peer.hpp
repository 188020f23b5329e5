// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <octavo/octree/balance.hpp>

// What the comparison of hexahedral meshing asks of a peer. A peer that is not installed answers nothing.

namespace octavo::bench {

struct BalancedAndNumbered {
    std::size_t cells = 0;
    double balance_seconds = 0;
    double number_seconds = 0;  ///< 0 when the peer cannot number nodes under this balance
};

/// The coarsest tree that has these leaves, which are sorted and are first octants.
inline std::vector<octree::CellKey> completed(const std::vector<octree::CellKey>& fine) {
    std::vector<octree::CellKey> leaves;
    std::size_t next = 0;
    const auto visit = [&](const auto& self, octree::CellKey cell) -> void {
        if (next == fine.size() || !cell.contains(fine[next]) || cell == fine[next]) {
            next += next < fine.size() && cell == fine[next];
            leaves.push_back(cell);
            return;
        }
        for (int octant = 0; octant < 8; ++octant) self(self, cell.child(octant));
    };
    visit(visit, octree::CellKey::root());
    return leaves;
}

#ifdef OCTAVO_WITH_P4EST
std::optional<BalancedAndNumbered> p4est_balance_and_number(const std::vector<octree::CellKey>& leaves,
                                                            octree::Contact contact);
#else
inline std::optional<BalancedAndNumbered> p4est_balance_and_number(const std::vector<octree::CellKey>&,
                                                                   octree::Contact) {
    return std::nullopt;
}
#endif

}  // namespace octavo::bench
