// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/corner_table.hpp>

namespace octavo::boolean {

CornerTable corners_by_point(std::span<const mesh::Triangle> triangles, std::uint32_t first_number,
                             std::size_t points, const Context& context) {
    constexpr std::size_t block = 1024;
    const std::size_t ranges = context.threads == 1 ? 1 : 8, range = points / ranges + 1;
    std::vector<std::uint8_t> ranges_of(triangles.size() / block + 1, ranges == 1);
    const auto for_each_corner_of = [&](std::size_t number, const auto& visit) {
        const std::size_t end = std::min((number + 1) * block, triangles.size());
        for (std::size_t i = number * block; i < end; ++i) {
            const mesh::Triangle corners = triangles[i];
            const std::uint32_t triangle = first_number + static_cast<std::uint32_t>(i);
            for (std::uint32_t k = 0; k < 3; ++k) visit(corners[k], 4 * triangle + k);
        }
    };
    if (ranges > 1)
        parallel_chunks(context, ranges_of.size(), 64, [&](std::size_t first, std::size_t last) {
            for (std::size_t number = first; number < last; ++number) {
                unsigned found = 0;
                for_each_corner_of(number,
                                   [&](std::uint32_t point, std::uint32_t) { found |= 1u << point / range; });
                ranges_of[number] = static_cast<std::uint8_t>(found);
            }
        });
    const auto for_each_corner = [&](std::size_t first, std::size_t last, const auto& visit) {
        for (std::size_t number = 0; number < ranges_of.size(); ++number)
            if (ranges_of[number] >> first / range & 1)
                for_each_corner_of(number, [&](std::uint32_t point, std::uint32_t corner) {
                    if (point >= first && point < last) visit(point, corner);
                });
    };
    // The corners of a point are counted two places on, and then its end is counted up from where it begins.
    CornerTable table;
    table.begin.assign(points + 2, 0);
    parallel_chunks(context, points, range, [&](std::size_t first, std::size_t last) {
        std::uint32_t* const counts = table.begin.data() + 2;
        for_each_corner(first, last, [&](std::uint32_t point, std::uint32_t) { ++counts[point]; });
    });
    for (std::size_t point = 2; point < table.begin.size(); ++point)
        table.begin[point] += table.begin[point - 1];
    table.corners.resize(table.begin.back());
    parallel_chunks(context, points, range, [&](std::size_t first, std::size_t last) {
        std::uint32_t *const ends = table.begin.data() + 1, *const to = table.corners.data();
        for_each_corner(first, last,
                        [&](std::uint32_t point, std::uint32_t corner) { to[ends[point]++] = corner; });
    });
    return table;
}

}  // namespace octavo::boolean
