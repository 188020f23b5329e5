// SPDX-License-Identifier: Apache-2.0
// Facets on the same corners: which of them go.
//
// Those that face each other cancel, so pairs of them can always go: no winding number and no edge feels it. Those that
// face the same way are either one facet that a file has twice, or a facet each of two bodies that share it. The edges
// tell: what a file has twice leaves edges open that close when it goes, and what bodies share leaves them closed.
// Repetitions that are joined by edges are one patch, and go together or not at all.
//
// A pair back to back that is left is a wall inside a solid, a flap that stands on it, or a sheet that means something.
#include <algorithm>
#include <array>
#include <utility>

#include <octavo/mesh/disjoint_sets.hpp>
#include <octavo/mesh/repair_steps.hpp>
#include <octavo/mesh/repeats.hpp>

namespace octavo::mesh {
namespace {

/// Facets on the same corners by the way they face; the larger half first.
struct Facing {
    std::vector<FaceIndex> more, fewer;
};

Facing facing(const RepairSoup& soup, const std::vector<FaceIndex>& group) {
    Facing result;
    for (const FaceIndex face : group)
        (is_ascending(soup.triangles[face]) ? result.more : result.fewer).push_back(face);
    if (result.more.size() < result.fewer.size()) std::swap(result.more, result.fewer);
    return result;
}

/// What an edge is like, and what it would be without the repetitions of one patch.
struct EdgeBalance {
    int balance = 0, balance_of_repeated = 0;         ///< sides that run up, less those that run down
    std::size_t sides = 0, repeated = 0, others = 0;  ///< others: of facets that nothing repeats

    /// Would it become open, or have a facet without a partner? What repeats alone is an edge of an open sheet.
    bool needs_repeated() const {
        return (balance == 0 && balance_of_repeated != 0) ||
               (others > 0 && sides % 2 == 0 && repeated % 2 == 1);
    }
};

/// Repetitions the same way round, as they may go together.
class Patches {
  public:
    Patches(const RepairSoup& soup, const EdgeTable& edges)
        : soup_(soup), edges_(edges), group_of_face_(soup.triangles.size(), no_index) {}

    /// Facets that face the same way; all but the first repeat it.
    void add(const std::vector<FaceIndex>& group) {
        for (const FaceIndex face : group) group_of_face_[face] = static_cast<std::uint32_t>(groups_.size());
        groups_.push_back(group);
    }

    /// Marks those that no edge needs. What is marked already does not count.
    void mark(std::vector<bool>& dropped) const {
        if (groups_.empty()) return;
        DisjointSets patches(groups_.size());
        std::vector<std::uint32_t> needed;
        for (EdgeIndex edge = 0; edge < edges_.size(); ++edge) {
            std::uint32_t here = no_index;
            EdgeBalance balance;
            for (const SideIndex side : edges_.sides_of(edge)) {
                if (dropped[side / 3]) continue;
                const std::uint32_t group = group_of_face_[side / 3];
                const int direction = runs_upward(soup_.triangles, side) ? 1 : -1;
                balance.balance += direction;
                ++balance.sides;
                if (group == no_index) {
                    ++balance.others;
                    continue;
                }
                if (here == no_index) here = group;
                patches.unite(here, group);
                if (side / 3 == groups_[group][0]) continue;
                balance.balance_of_repeated += direction;
                ++balance.repeated;
            }
            if (here != no_index && balance.needs_repeated()) needed.push_back(here);
        }
        std::vector<bool> stays(groups_.size());
        for (const std::uint32_t group : needed) stays[patches.find(group)] = true;
        for (std::uint32_t group = 0; group < groups_.size(); ++group)
            for (std::size_t i = 1; i < groups_[group].size() && !stays[patches.find(group)]; ++i)
                dropped[groups_[group][i]] = true;
    }

  private:
    const RepairSoup& soup_;
    const EdgeTable& edges_;
    std::vector<std::uint32_t> group_of_face_;
    std::vector<std::vector<FaceIndex>> groups_;
};

}  // namespace

RepairDone drop_duplicate_facets(RepairSoup& soup) {
    const EdgeTable edges = soup.edges();
    std::vector<bool> dropped(soup.triangles.size());
    Patches patches(soup, edges);
    for (const std::vector<FaceIndex>& group : groups_of_repeated_facets(soup.triangles, edges)) {
        auto [more, fewer] = facing(soup, group);
        // What cancels goes, but for one pair where nothing else is left.
        const std::size_t left = more.size() - fewer.size(), pairs = left == 0 ? 1 : 0;
        for (std::size_t i = left + pairs; i < more.size(); ++i) dropped[more[i]] = true;
        for (std::size_t i = pairs; i < fewer.size(); ++i) dropped[fewer[i]] = true;
        more.resize(left + pairs);
        if (left > 1) patches.add(more);
    }
    patches.mark(dropped);
    return soup.drop(dropped);
}

DroppedWalls drop_walls(RepairSoup& soup) {
    // Pairs joined by edges are one wall, whose rim is the edges with one pair only or with other facets. The wall goes
    // where other facets hold it, and only where they close without it.
    const EdgeTable edges = soup.edges();
    std::vector<std::array<FaceIndex, 2>> pairs;
    std::vector<std::uint32_t> pair_of_face(soup.triangles.size(), no_index);
    for (const std::vector<FaceIndex>& group : groups_of_repeated_facets(soup.triangles, edges)) {
        if (group.size() != 2 ||
            is_ascending(soup.triangles[group[0]]) == is_ascending(soup.triangles[group[1]]))
            continue;
        for (const FaceIndex face : group) pair_of_face[face] = static_cast<std::uint32_t>(pairs.size());
        pairs.push_back({group[0], group[1]});
    }
    DisjointSets walls(pairs.size());
    enum class Rim : std::uint8_t { free, closes, opens };
    std::vector<std::pair<std::uint32_t, Rim>> rims;  // by pair
    std::vector<std::uint32_t> here;
    for (EdgeIndex edge = 0; !pairs.empty() && edge < edges.size(); ++edge) {
        here.clear();
        std::size_t others = 0;
        for (const SideIndex side : edges.sides_of(edge)) {
            const std::uint32_t pair = pair_of_face[side / 3];
            if (pair == no_index)
                ++others;
            else if (std::find(here.begin(), here.end(), pair) == here.end())
                here.push_back(pair);
        }
        for (const std::uint32_t pair : here) walls.unite(here[0], pair);
        if (here.size() > 1 && others == 0) continue;  // inside the wall
        const Rim rim = others == 0 ? Rim::free : others % 2 == 0 ? Rim::closes : Rim::opens;
        for (const std::uint32_t pair : here) rims.push_back({pair, rim});
    }
    std::vector<std::array<bool, 3>> has(pairs.size());
    for (const auto& [pair, rim] : rims) has[walls.find(pair)][static_cast<std::size_t>(rim)] = true;
    std::vector<bool> dropped(soup.triangles.size());
    DroppedWalls done;
    for (std::uint32_t pair = 0; pair < pairs.size(); ++pair) {
        const auto [is_free, closes, opens] = has[walls.find(pair)];
        if (!closes || opens) continue;
        RepairDone& kind = is_free ? done.flaps : done.inner;
        for (const FaceIndex face : pairs[pair]) {
            dropped[face] = true;
            kind.add({1, {soup.origin[face]}});
        }
    }
    soup.drop(dropped);
    return done;
}

}  // namespace octavo::mesh
