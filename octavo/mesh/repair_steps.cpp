// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include <octavo/mesh/repair_steps.hpp>
#include <octavo/mesh/repeats.hpp>

namespace octavo::mesh {

RepairDone RepairSoup::drop(const std::vector<bool>& dropped) {
    RepairDone done;
    std::size_t next = 0;
    for (std::size_t face = 0; face < triangles.size(); ++face) {
        if (dropped[face]) {
            ++done.count;
            done.faces.push_back(origin[face]);
            continue;
        }
        triangles[next] = triangles[face];
        origin[next++] = origin[face];
    }
    triangles.resize(next);
    origin.resize(next);
    return done;
}

RepairDone drop_collapsed_facets(RepairSoup& soup) {
    std::vector<bool> dropped;
    for (const Triangle& t : soup.triangles) dropped.push_back(names_a_vertex_twice(t));
    return soup.drop(dropped);
}

RepairDone orient_neighbours(RepairSoup& soup, std::vector<bool>& mixed) {
    const EdgeTable edges = soup.edges();
    const std::size_t count = soup.triangles.size();
    mixed.assign(count, false);
    std::vector<std::int8_t> turned(count, -1);
    std::vector<FaceIndex> surface;
    RepairDone done;
    for (FaceIndex seed = 0; seed < count; ++seed) {
        if (turned[seed] >= 0) continue;
        surface.assign(1, seed);
        turned[seed] = 0;
        bool orientable = true;
        for (std::size_t i = 0; i < surface.size(); ++i) {
            const FaceIndex face = surface[i];
            for (SideIndex side = 3 * face; side < 3 * face + 3; ++side) {
                if (edges.edge_of_side[side] == no_index) continue;
                const auto sides = edges.sides_of(edges.edge_of_side[side]);
                if (sides.size() != 2) continue;
                const SideIndex other = sides[0] == side ? sides[1] : sides[0];
                const bool agree = runs_upward(soup.triangles, side) != runs_upward(soup.triangles, other);
                const auto wanted = static_cast<std::int8_t>(agree ? turned[face] : 1 - turned[face]);
                std::int8_t& found = turned[other / 3];
                if (found < 0) {
                    found = wanted;
                    surface.push_back(other / 3);
                } else if (found != wanted) {
                    orientable = false;
                }
            }
        }
        std::size_t turns = 0;
        for (const FaceIndex face : surface) turns += turned[face] == 1;
        if (turns == 0 || !orientable) continue;
        const std::int8_t minority = 2 * turns <= surface.size() ? 1 : 0;
        for (const FaceIndex face : surface) {
            mixed[face] = true;
            if (turned[face] != minority) continue;
            std::swap(soup.triangles[face][1], soup.triangles[face][2]);
            ++done.count;
            done.faces.push_back(soup.origin[face]);
        }
    }
    return done;
}

}  // namespace octavo::mesh
