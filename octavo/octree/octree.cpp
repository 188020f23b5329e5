// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/octree/octree.hpp>

namespace octavo::octree {

Result<Octree> Octree::from_untrusted(const exact::Lattice& lattice, int depth, DfCode code) {
    if (depth < 0 || depth > max_level)
        return Error{ErrorCode::bad_input,
                     "the depth of the octree is " + std::to_string(depth) + ", not in 0 to 21",
                     {}};
    if (Status status = check_tree(code, depth); !status) return status.error();
    return Octree(lattice, depth, std::move(code));
}

OctreeStats Octree::stats() const {
    std::array<std::array<std::uint64_t, 4>, max_level + 1> counts{};
    for (DfCursor cursor(code_); !cursor.done(); cursor.next())
        ++counts[static_cast<std::size_t>(cursor.level())][static_cast<std::size_t>(cursor.node())];

    OctreeStats stats;
    for (int level = 0; level <= max_level; ++level) {
        const auto [white, black, gray, split] = counts[static_cast<std::size_t>(level)];
        stats.levels[static_cast<std::size_t>(level)] = {white, black, gray, split};
        stats.white += white;
        stats.black += black;
        stats.gray += gray;
        stats.splits += split;
        if (white + black + gray > 0) stats.deepest = level;
        stats.black_volume += black * cell_volume(level);
        stats.gray_volume += gray * cell_volume(level);
    }
    return stats;
}

double world_volume(const exact::Lattice& lattice, LatticeVolume volume) {
    return std::ldexp(static_cast<double>(volume), 3 * lattice.exponent());
}

}  // namespace octavo::octree
