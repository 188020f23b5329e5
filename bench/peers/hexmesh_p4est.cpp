// SPDX-License-Identifier: Apache-2.0
#include <ctime>

#include <p8est_bits.h>
#include <p8est_extended.h>
#include <p8est_ghost.h>
#include <p8est_io.h>
#include <p8est_lnodes.h>

#include "hexmesh_peer.hpp"

namespace octavo::bench {
namespace {

double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The leaves as p8est wants them: x, y, z and level of each.
p8est_t* forest_of(const std::vector<octree::CellKey>& leaves, p8est_connectivity_t* connectivity) {
    sc_array_t* quadrants = sc_array_new_count(sizeof(p4est_qcoord_t), 4 * leaves.size());
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        auto* const q = static_cast<p4est_qcoord_t*>(sc_array_index(quadrants, 4 * i));
        const exact::Point low = leaves[i].low();
        constexpr int shift = exact::coordinate_bits - P8EST_MAXLEVEL;
        q[0] = low.x >> shift, q[1] = low.y >> shift, q[2] = low.z >> shift;
        q[3] = leaves[i].level();
    }
    p4est_gloidx_t first[2] = {0, static_cast<p4est_gloidx_t>(leaves.size())};
    sc_array_t* per_tree = sc_array_new_count(sizeof(p4est_gloidx_t), 2);
    *static_cast<p4est_gloidx_t*>(sc_array_index(per_tree, 0)) = 0;
    *static_cast<p4est_gloidx_t*>(sc_array_index(per_tree, 1)) = first[1];
    p8est_t* forest =
        p8est_inflate(sc_MPI_COMM_WORLD, connectivity, first,
                      static_cast<p4est_gloidx_t*>(sc_array_index(per_tree, 0)), quadrants, nullptr, nullptr);
    sc_array_destroy(per_tree);
    sc_array_destroy(quadrants);
    return forest;
}

}  // namespace

std::optional<BalancedAndNumbered> p4est_balance_and_number(const std::vector<octree::CellKey>& leaves,
                                                            octree::Contact contact) {
    static const bool started = [] {
        sc_MPI_Init(nullptr, nullptr);
        sc_init(sc_MPI_COMM_WORLD, 0, 0, nullptr, SC_LP_ERROR);
        p4est_init(nullptr, SC_LP_ERROR);
        return true;
    }();
    static_cast<void>(started);
    for (const octree::CellKey leaf : leaves)
        if (leaf.level() > P8EST_QMAXLEVEL) return std::nullopt;
    p8est_connectivity_t* connectivity = p8est_connectivity_new_unitcube();
    p8est_t* forest = forest_of(leaves, connectivity);
    BalancedAndNumbered result;
    double start = cpu_seconds();
    p8est_balance(forest,
                  contact == octree::Contact::face   ? P8EST_CONNECT_FACE
                  : contact == octree::Contact::edge ? P8EST_CONNECT_EDGE
                                                     : P8EST_CONNECT_FULL,
                  nullptr);
    result.balance_seconds = cpu_seconds() - start;
    result.cells = static_cast<std::size_t>(forest->local_num_quadrants);
    if (contact == octree::Contact::corner) {
        p8est_ghost_t* ghost = p8est_ghost_new(forest, P8EST_CONNECT_FULL);
        start = cpu_seconds();
        p8est_lnodes_t* nodes = p8est_lnodes_new(forest, ghost, 1);
        result.number_seconds = cpu_seconds() - start;
        p8est_lnodes_destroy(nodes);
        p8est_ghost_destroy(ghost);
    }
    p8est_destroy(forest);
    p8est_connectivity_destroy(connectivity);
    return result;
}

}  // namespace octavo::bench
