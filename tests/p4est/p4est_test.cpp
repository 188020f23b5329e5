// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <p8est_algorithms.h>
#include <p8est_bits.h>
#include <p8est_extended.h>
#include <p8est_ghost.h>
#include <p8est_io.h>
#include <p8est_lnodes.h>

#include <octavo/hexmesh/build.hpp>
#include <octavo/hexmesh/number.hpp>
#include <octavo/io/p8est.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/octree/complete.hpp>

#include "hexmesh/folder.hpp"
#include "hexmesh/trees.hpp"

// Our octrees beside p4est's, the reference of the field: the same leaves must be balanced to the same leaves and
// numbered to the same nodes, and p4est must read our files.

// OpenMPI keeps memory that it never gives back, which is not ours to mend.
extern "C" const char* __asan_default_options() { return "detect_leaks=0"; }

namespace octavo::hexmesh {
namespace {

using octree::CellKey;
using octree::Contact;

void start_p4est() {
    static const bool started = [] {
        sc_MPI_Init(nullptr, nullptr);
        sc_init(sc_MPI_COMM_WORLD, 0, 0, nullptr, SC_LP_ERROR);
        p4est_init(nullptr, SC_LP_ERROR);
        return true;
    }();
    static_cast<void>(started);
}

struct Destroy {
    void operator()(p8est_connectivity_t* it) const { p8est_connectivity_destroy(it); }
    void operator()(p8est_t* it) const { p8est_destroy(it); }
    void operator()(p8est_ghost_t* it) const { p8est_ghost_destroy(it); }
    void operator()(p8est_lnodes_t* it) const { p8est_lnodes_destroy(it); }
    void operator()(sc_array_t* it) const { sc_array_destroy(it); }
};
template <class T>
using Owned = std::unique_ptr<T, Destroy>;

struct Forest {
    Owned<p8est_connectivity_t> connectivity;
    Owned<p8est_t> forest;
};

constexpr int unit_shift = exact::coordinate_bits - P8EST_MAXLEVEL;

Forest forest_of(const std::vector<CellKey>& leaves) {
    start_p4est();
    const Owned<sc_array_t> quadrants(sc_array_new_count(sizeof(p4est_qcoord_t), 4 * leaves.size()));
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        auto* const q = static_cast<p4est_qcoord_t*>(sc_array_index(quadrants.get(), 4 * i));
        const exact::Point low = leaves[i].low();
        q[0] = low.x >> unit_shift, q[1] = low.y >> unit_shift, q[2] = low.z >> unit_shift;
        q[3] = leaves[i].level();
    }
    const auto count = static_cast<p4est_gloidx_t>(leaves.size());
    p4est_gloidx_t up_to_process[2] = {0, count}, up_to_tree[2] = {0, count};
    Forest made{Owned<p8est_connectivity_t>(p8est_connectivity_new_unitcube()), nullptr};
    made.forest.reset(p8est_inflate(sc_MPI_COMM_WORLD, made.connectivity.get(), up_to_process, up_to_tree,
                                    quadrants.get(), nullptr, nullptr));
    return made;
}

const p8est_quadrant_t& quadrant(const p8est_t& forest, std::size_t i) {
    return *p8est_quadrant_array_index(&p8est_tree_array_index(forest.trees, 0)->quadrants, i);
}

std::vector<CellKey> leaves_of(const p8est_t& forest) {
    std::vector<CellKey> leaves;
    for (std::size_t i = 0; i < static_cast<std::size_t>(forest.local_num_quadrants); ++i) {
        const p8est_quadrant_t& q = quadrant(forest, i);
        leaves.push_back(CellKey::at({q.x << unit_shift, q.y << unit_shift, q.z << unit_shift}, q.level));
    }
    return leaves;
}

p8est_connect_type_t contact_of(Contact contact) {
    return contact == Contact::face   ? P8EST_CONNECT_FACE
           : contact == Contact::edge ? P8EST_CONNECT_EDGE
                                      : P8EST_CONNECT_FULL;
}

/// Random trees, trees refined to points as deep as p4est goes, and the cells of a part.
std::vector<std::vector<CellKey>> unbalanced_trees() {
    std::mt19937 random(4);
    std::vector<std::vector<CellKey>> trees{{CellKey::root()}};
    for (unsigned round = 0; round < 6; ++round) trees.push_back(random_leaves(random, 5, 4 + round % 4));
    for (const int depth : {6, 12, P8EST_QMAXLEVEL})
        trees.push_back(
            refined_at({random_point(random), random_point(random), random_point(random)}, depth));
    constexpr std::int32_t last = exact::universe_side - 1;
    trees.push_back(refined_at({{last, last, last}, {last / 2, last / 2, 0}}, P8EST_QMAXLEVEL));
    const mesh::Mesh solid = mesh::bearing_housing();
    const Result<Built> built = build(std::span(&solid, 1), {.level = 6, .keep = Keep::all});
    EXPECT_TRUE(built);
    // The smallest cells alone, so that there is something to balance.
    int deepest = 0;
    for (const CellKey cell : built->mesh.cells) deepest = std::max(deepest, cell.level());
    std::vector<CellKey> fine;
    for (const CellKey cell : built->mesh.cells)
        if (cell.level() == deepest) fine.push_back(cell);
    trees.push_back(octree::complete(fine));
    return trees;
}

TEST(P4est, BalancesToTheSameLeaves) {
    for (const std::vector<CellKey>& leaves : unbalanced_trees())
        for (const Contact contact : {Contact::face, Contact::edge, Contact::corner}) {
            const Forest forest = forest_of(leaves);
            p8est_balance(forest.forest.get(), contact_of(contact), nullptr);
            const std::vector<CellKey> ours = octree::balance(leaves, contact);
            ASSERT_EQ(ours.size(), static_cast<std::size_t>(forest.forest->local_num_quadrants));
            EXPECT_EQ(ours, leaves_of(*forest.forest));
        }
}

/// A node of p4est and one of ours must always meet each other.
class Pairing {
  public:
    Pairing(std::size_t theirs, std::size_t ours) : ours_(theirs, none), theirs_(ours, none) {}
    bool pair(std::size_t theirs, std::size_t ours) {
        if (ours_[theirs] == none && theirs_[ours] == none) ours_[theirs] = ours, theirs_[ours] = theirs;
        return ours_[theirs] == ours && theirs_[ours] == theirs;
    }
    std::size_t ours_of(std::size_t theirs) const { return ours_[theirs]; }

  private:
    static constexpr std::size_t none = ~std::size_t{0};
    std::vector<std::size_t> ours_, theirs_;
};

TEST(P4est, NumbersTheSameIndependentNodesAndMasters) {
    for (const std::vector<CellKey>& unbalanced : unbalanced_trees()) {
        const std::vector<CellKey> leaves = octree::balance(unbalanced, Contact::corner);
        const Forest forest = forest_of(leaves);
        const Owned<p8est_ghost_t> ghost(p8est_ghost_new(forest.forest.get(), P8EST_CONNECT_FULL));
        const Owned<p8est_lnodes_t> theirs(p8est_lnodes_new(forest.forest.get(), ghost.get(), 1));
        const Result<Numbering> ours = number_nodes(leaves);
        ASSERT_TRUE(ours);
        std::vector<std::vector<mesh::NodeIndex>> masters(ours->nodes.size());
        for (const auto& h : ours->edge_hanging) masters[h.node].assign(h.masters.begin(), h.masters.end());
        for (const auto& h : ours->face_hanging) masters[h.node].assign(h.masters.begin(), h.masters.end());
        const std::size_t hanging = ours->edge_hanging.size() + ours->face_hanging.size();
        ASSERT_EQ(ours->nodes.size() - hanging, static_cast<std::size_t>(theirs->num_local_nodes));

        Pairing pairing(static_cast<std::size_t>(theirs->num_local_nodes), ours->nodes.size());
        const auto their_node = [&](std::size_t cell, std::size_t corner) {
            return static_cast<std::size_t>(theirs->element_nodes[8 * cell + corner]);
        };
        for (std::size_t cell = 0; cell < leaves.size(); ++cell)
            for (std::size_t corner = 0; corner < 8; ++corner)
                if (const mesh::NodeIndex node = ours->corners[cell][corner]; masters[node].empty()) {
                    ASSERT_TRUE(pairing.pair(their_node(cell, corner), node));
                }
        // Where one of our nodes hangs p4est names one of its masters.
        for (std::size_t cell = 0; cell < leaves.size(); ++cell)
            for (std::size_t corner = 0; corner < 8; ++corner)
                if (const auto& of_node = masters[ours->corners[cell][corner]]; !of_node.empty()) {
                    const std::size_t master = pairing.ours_of(their_node(cell, corner));
                    ASSERT_NE(std::find(of_node.begin(), of_node.end(), master), of_node.end());
                }
    }
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(P4est, LoadsOurFilesAndSavesTheSameBytes) {
    start_p4est();
    const Folder folder;
    std::vector<mesh::Mesh> solids{mesh::gear(), mesh::cube(2)};
    for (Vec3& vertex : solids[1].vertices) vertex = vertex + Vec3{5, 1, -3};
    for (const Keep keep : {Keep::touched, Keep::all}) {
        const Result<Built> built = build(solids, {.level = 5, .keep = keep});
        ASSERT_TRUE(built);
        const mesh::HexMesh& mesh = built->mesh;
        const std::string ours = (folder / "ours.p8est").string(),
                          theirs = (folder / "theirs.p8est").string();
        const auto written = io::write_p8est(ours, mesh);
        ASSERT_TRUE(written) << written.error().describe();
        EXPECT_EQ(written->bytes, std::filesystem::file_size(ours));

        p8est_connectivity_t* connectivity = nullptr;
        Forest loaded;
        loaded.forest.reset(
            p8est_load(ours.c_str(), sc_MPI_COMM_WORLD, sizeof(std::int32_t), 1, nullptr, &connectivity));
        loaded.connectivity.reset(connectivity);
        ASSERT_TRUE(loaded.forest && p8est_is_valid(loaded.forest.get()));
        EXPECT_TRUE(p8est_is_balanced(loaded.forest.get(), P8EST_CONNECT_EDGE));
        const std::vector<CellKey> leaves = leaves_of(*loaded.forest);
        std::size_t next = 0;
        for (std::size_t i = 0; i < leaves.size(); ++i) {
            const std::int32_t set = *static_cast<std::int32_t*>(quadrant(*loaded.forest, i).p.user_data);
            if (set == -1) continue;
            ASSERT_LT(next, mesh.cells.size());
            ASSERT_EQ(leaves[i], mesh.cells[next]);
            ASSERT_EQ(set, mesh.set_of_cell[next]);
            // The cell lies where p4est thinks it does.
            double corner[3];
            const p8est_quadrant_t& q = quadrant(*loaded.forest, i);
            p8est_qcoord_to_vertex(loaded.connectivity.get(), 0, q.x, q.y, q.z, corner);
            const Vec3 at = mesh.position(mesh.corners[next][0]);
            for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(corner[axis], at[axis]);
            ++next;
        }
        EXPECT_EQ(next, mesh.cells.size());
        EXPECT_TRUE(keep == Keep::touched || leaves.size() == next);
        p8est_save(theirs.c_str(), loaded.forest.get(), 1);
        EXPECT_EQ(bytes_of(ours), bytes_of(theirs));
    }
}

}  // namespace
}  // namespace octavo::hexmesh
