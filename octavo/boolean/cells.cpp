// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/boolean/cells.hpp>

namespace octavo::boolean {
namespace {

/// The corner of the triangle round everything lies in no polygon.
std::uint32_t outer_triangle(const Subdivision& subdivision) {
    const auto triangles = subdivision.triangles();
    for (std::uint32_t i = 0;; ++i)
        for (const Subdivision::VertexId v : triangles[i].v)
            if (subdivision.point_of(v) == no_index) return i;
}

}  // namespace

Cells find_cells(const Subdivision& subdivision, std::uint32_t no_border) {
    const auto triangles = subdivision.triangles();
    Cells cells;
    cells.of_triangle.assign(triangles.size(), no_index);
    cells.covers.emplace_back();
    const auto is_border = [&](std::uint32_t owner) {
        for (; owner; owner = subdivision.owner(owner - 1).next)
            if (subdivision.owner(owner - 1).tag != no_border) return true;
        return false;
    };
    const auto toggled = [&](std::vector<std::uint32_t> tags, std::uint32_t owner) {
        for (; owner; owner = subdivision.owner(owner - 1).next) {
            const std::uint32_t tag = subdivision.owner(owner - 1).tag;
            if (tag == no_border) continue;
            const auto place = std::lower_bound(tags.begin(), tags.end(), tag);
            if (place != tags.end() && *place == tag)
                tags.erase(place);
            else
                tags.insert(place, tag);
        }
        return tags;
    };
    // Cells are flooded whole, so that few lists are made: triangles beyond borders wait.
    std::vector<std::uint32_t> stack{outer_triangle(subdivision)};
    std::vector<std::pair<std::uint32_t, std::uint32_t>>
        beyond;  ///< triangle and its edge to where it is known
    cells.of_triangle[stack[0]] = 0;
    for (;;) {
        while (!stack.empty()) {
            const std::uint32_t at = stack.back();
            stack.pop_back();
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t next = triangles[at].neighbour[k];
                if (next == no_index || cells.of_triangle[next] != no_index) continue;
                if (is_border(triangles[at].owner[k])) {
                    beyond.push_back({at, k});
                } else {
                    cells.of_triangle[next] = cells.of_triangle[at];
                    stack.push_back(next);
                }
            }
        }
        while (!beyond.empty() &&
               cells.of_triangle[triangles[beyond.back().first].neighbour[beyond.back().second]] != no_index)
            beyond.pop_back();
        if (beyond.empty()) return cells;
        const auto [at, k] = beyond.back();
        beyond.pop_back();
        const std::uint32_t next = triangles[at].neighbour[k];
        cells.of_triangle[next] = static_cast<std::uint32_t>(cells.covers.size());
        cells.covers.push_back(toggled(cells.covers[cells.of_triangle[at]], triangles[at].owner[k]));
        stack.push_back(next);
    }
}

}  // namespace octavo::boolean
