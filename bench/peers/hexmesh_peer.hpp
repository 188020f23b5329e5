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
