// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>

#include <octavo/mesh/hex_sides.hpp>

namespace octavo::mesh {
namespace {

/// Two nodes in either order.
std::uint64_t pair_of(NodeIndex a, NodeIndex b) {
    return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
}

/// A side by the diagonal that ends in its lowest node: the same from either cell.
struct Entry {
    std::uint64_t diagonal;
    CellIndex cell;
    std::uint32_t side;
};

HexSide side_of(const HexMesh& mesh, CellIndex cell, std::uint32_t side) {
    HexSide result{cell, side, {}};
    for (std::size_t i = 0; i < 4; ++i) result.corners[i] = mesh.corners[cell][corners_of_side[side][i]];
    return result;
}

std::uint64_t diagonal_of(const std::array<NodeIndex, 4>& corners) {
    const auto lowest =
        static_cast<std::size_t>(std::min_element(corners.begin(), corners.end()) - corners.begin());
    return pair_of(corners[lowest], corners[(lowest + 2) % 4]);
}

bool have_same_corners(std::array<NodeIndex, 4> a, std::array<NodeIndex, 4> b) {
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    return a == b;
}

/// Pairs of nodes that name the sides between cells of two sizes.
struct Joints {
    std::vector<std::uint64_t> larger;  ///< both diagonals of each larger side
    struct Quarter {
        std::uint64_t diagonal;
        std::uint32_t side;  ///< which larger one
    };
    std::vector<Quarter> smaller;

    explicit Joints(const HexMesh& mesh) {
        for (std::uint32_t i = 0; i < mesh.face_hanging.size(); ++i) {
            const FaceHangingNode& hanging = mesh.face_hanging[i];
            larger.push_back(pair_of(hanging.masters[0], hanging.masters[3]));
            larger.push_back(pair_of(hanging.masters[1], hanging.masters[2]));
            for (const NodeIndex master : hanging.masters)
                smaller.push_back({pair_of(master, hanging.node), i});
        }
        std::sort(larger.begin(), larger.end());
        std::sort(smaller.begin(), smaller.end(),
                  [](const Quarter& a, const Quarter& b) { return a.diagonal < b.diagonal; });
    }

    bool is_larger(const HexSide& side) const {
        const auto has = [&](std::size_t i) {
            return std::binary_search(larger.begin(), larger.end(),
                                      pair_of(side.corners[i], side.corners[i + 2]));
        };
        return has(0) && has(1);
    }
    /// The larger side of which this is a quarter, or none.
    const Quarter* quarter(const HexSide& side) const {
        for (const std::size_t i : {0U, 1U}) {
            const std::uint64_t diagonal = pair_of(side.corners[i], side.corners[i + 2]);
            const auto at =
                std::lower_bound(smaller.begin(), smaller.end(), diagonal,
                                 [](const Quarter& q, std::uint64_t value) { return q.diagonal < value; });
            if (at != smaller.end() && at->diagonal == diagonal) return &*at;
        }
        return nullptr;
    }
};

/// Drops sides that meet two halves, and these: what a layer of cells has where a large side of the boundary under it
/// meets two smaller ones.
void drop_halved(const HexMesh& mesh, std::vector<HexSide>& sides) {
    std::vector<std::pair<std::uint64_t, NodeIndex>> middles;
    for (const EdgeHangingNode& hanging : mesh.edge_hanging)
        middles.push_back({pair_of(hanging.masters[0], hanging.masters[1]), hanging.node});
    std::sort(middles.begin(), middles.end());
    constexpr NodeIndex none = ~NodeIndex{0};
    const auto middle = [&](NodeIndex a, NodeIndex b) {
        const auto at =
            std::lower_bound(middles.begin(), middles.end(), std::pair(pair_of(a, b), NodeIndex{0}));
        return at != middles.end() && at->first == pair_of(a, b) ? at->second : none;
    };
    std::vector<std::pair<std::uint64_t, std::size_t>> by_diagonal;
    for (std::size_t i = 0; i < sides.size(); ++i) by_diagonal.push_back({diagonal_of(sides[i].corners), i});
    std::sort(by_diagonal.begin(), by_diagonal.end());
    const auto find = [&](const std::array<NodeIndex, 4>& corners) {
        const std::uint64_t diagonal = diagonal_of(corners);
        auto at =
            std::lower_bound(by_diagonal.begin(), by_diagonal.end(), std::pair(diagonal, std::size_t{0}));
        for (; at != by_diagonal.end() && at->first == diagonal; ++at)
            if (have_same_corners(corners, sides[at->second].corners)) return at->second;
        return sides.size();
    };
    std::vector<bool> dropped(sides.size(), false);
    for (std::size_t i = 0; i < sides.size(); ++i)
        for (std::size_t k = 0; k < 2; ++k) {
            const auto c = [&](std::size_t j) { return sides[i].corners[(j + k) % 4]; };
            const NodeIndex low = middle(c(0), c(1)), high = middle(c(2), c(3));
            if (low == none || high == none) continue;
            const std::size_t first = find({c(0), low, high, c(3)}), second = find({low, c(1), c(2), high});
            if (first < sides.size() && second < sides.size())
                dropped[i] = dropped[first] = dropped[second] = true;
        }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < sides.size(); ++i)
        if (!dropped[i]) sides[kept++] = sides[i];
    sides.resize(kept);
}

}  // namespace

std::vector<HexSide> unshared_sides(const HexMesh& mesh) {
    std::vector<Entry> entries;
    entries.reserve(6 * mesh.cell_count());
    for (CellIndex cell = 0; cell < mesh.cell_count(); ++cell)
        for (std::uint32_t side = 0; side < 6; ++side)
            entries.push_back({diagonal_of(side_of(mesh, cell, side).corners), cell, side});
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return a.diagonal != b.diagonal ? a.diagonal < b.diagonal : a.cell < b.cell;
    });
    std::vector<HexSide> alone;
    for (std::size_t i = 0, end = 0; i < entries.size(); i = end) {
        while (end < entries.size() && entries[end].diagonal == entries[i].diagonal) ++end;
        // One or two; more only where sides that differ have a diagonal in common.
        for (std::size_t k = i; k < end; ++k) {
            const HexSide side = side_of(mesh, entries[k].cell, entries[k].side);
            bool shared = false;
            for (std::size_t other = i; other < end && !shared; ++other)
                shared = other != k &&
                         have_same_corners(side.corners,
                                           side_of(mesh, entries[other].cell, entries[other].side).corners);
            if (!shared) alone.push_back(side);
        }
    }
    std::sort(alone.begin(), alone.end(), [](const HexSide& a, const HexSide& b) {
        return a.cell != b.cell ? a.cell < b.cell : a.side < b.side;
    });
    return alone;
}

BoundarySides boundary_sides(const HexMesh& mesh) {
    const Joints joints(mesh);
    std::vector<std::uint8_t> quarters(mesh.face_hanging.size(), 0);
    BoundarySides result;
    for (const HexSide& side : unshared_sides(mesh)) {
        if (const Joints::Quarter* const quarter = joints.quarter(side))
            ++quarters[quarter->side];
        else if (!joints.is_larger(side))
            result.sides.push_back(side);
    }
    if (!mesh.is_octree()) drop_halved(mesh, result.sides);
    for (const std::uint8_t count : quarters) result.partly_covered += count > 0 && count < 4;
    return result;
}

}  // namespace octavo::mesh
