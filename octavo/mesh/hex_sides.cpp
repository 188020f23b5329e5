// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

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
    /// A diagonal of a larger side, or of a quarter of one.
    struct Diagonal {
        std::uint64_t diagonal;
        std::uint32_t side;  ///< which larger one: the index of its middle in `face_hanging`
    };
    std::vector<Diagonal> larger, smaller;

    explicit Joints(const HexMesh& mesh) {
        for (std::uint32_t i = 0; i < mesh.face_hanging.size(); ++i) {
            const FaceHangingNode& hanging = mesh.face_hanging[i];
            larger.push_back({pair_of(hanging.masters[0], hanging.masters[3]), i});
            larger.push_back({pair_of(hanging.masters[1], hanging.masters[2]), i});
            for (const NodeIndex master : hanging.masters)
                smaller.push_back({pair_of(master, hanging.node), i});
        }
        const auto by_diagonal = [](const Diagonal& a, const Diagonal& b) { return a.diagonal < b.diagonal; };
        std::sort(larger.begin(), larger.end(), by_diagonal);
        std::sort(smaller.begin(), smaller.end(), by_diagonal);
    }

    /// The larger side that this is, or none.
    const Diagonal* whole(const HexSide& side) const {
        const Diagonal* const first = find(larger, pair_of(side.corners[0], side.corners[2]));
        return first && find(larger, pair_of(side.corners[1], side.corners[3])) ? first : nullptr;
    }
    /// The larger side of which this is a quarter, or none.
    const Diagonal* quarter(const HexSide& side) const {
        const Diagonal* const first = find(smaller, pair_of(side.corners[0], side.corners[2]));
        return first ? first : find(smaller, pair_of(side.corners[1], side.corners[3]));
    }

  private:
    static const Diagonal* find(const std::vector<Diagonal>& sorted, std::uint64_t diagonal) {
        const auto at =
            std::lower_bound(sorted.begin(), sorted.end(), diagonal,
                             [](const Diagonal& d, std::uint64_t value) { return d.diagonal < value; });
        return at != sorted.end() && at->diagonal == diagonal ? &*at : nullptr;
    }
};

/// Takes out sides that meet two halves, and these: what a layer of cells has where a large side of the boundary under
/// it meets two smaller ones. Returns the halves.
std::vector<InnerSide> take_halved(const HexMesh& mesh, std::vector<HexSide>& sides) {
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
    std::vector<InnerSide> halves;
    std::vector<bool> taken(sides.size(), false);
    for (std::size_t i = 0; i < sides.size(); ++i)
        for (std::size_t k = 0; k < 2; ++k) {
            const auto c = [&](std::size_t j) { return sides[i].corners[(j + k) % 4]; };
            const NodeIndex low = middle(c(0), c(1)), high = middle(c(2), c(3));
            if (low == none || high == none) continue;
            const std::size_t first = find({c(0), low, high, c(3)}), second = find({low, c(1), c(2), high});
            if (first == sides.size() || second == sides.size()) continue;
            taken[i] = taken[first] = taken[second] = true;
            halves.push_back({sides[first], sides[i].cell});
            halves.push_back({sides[second], sides[i].cell});
        }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < sides.size(); ++i)
        if (!taken[i]) sides[kept++] = sides[i];
    sides.resize(kept);
    return halves;
}

/// Calls `shared(side, other)` for each side that two cells have, from the first of them, and `alone(side)` for the
/// others.
template <class Shared, class Alone>
void for_each_side(const HexMesh& mesh, const Shared& shared, const Alone& alone) {
    std::vector<Entry> entries;
    entries.reserve(6 * mesh.cell_count());
    for (CellIndex cell = 0; cell < mesh.cell_count(); ++cell)
        for (std::uint32_t side = 0; side < 6; ++side)
            entries.push_back({diagonal_of(side_of(mesh, cell, side).corners), cell, side});
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return a.diagonal != b.diagonal ? a.diagonal < b.diagonal : a.cell < b.cell;
    });
    for (std::size_t i = 0, end = 0; i < entries.size(); i = end) {
        while (end < entries.size() && entries[end].diagonal == entries[i].diagonal) ++end;
        // One or two; more only where sides that differ have a diagonal in common.
        for (std::size_t k = i; k < end; ++k) {
            const HexSide side = side_of(mesh, entries[k].cell, entries[k].side);
            std::size_t other = i;
            while (other < end &&
                   (other == k ||
                    !have_same_corners(side.corners,
                                       side_of(mesh, entries[other].cell, entries[other].side).corners)))
                ++other;
            if (other == end)
                alone(side);
            else if (k < other)
                shared(side, entries[other].cell);
        }
    }
}

std::vector<HexSide> by_cell(std::vector<HexSide> sides) {
    std::sort(sides.begin(), sides.end(), [](const HexSide& a, const HexSide& b) {
        return a.cell != b.cell ? a.cell < b.cell : a.side < b.side;
    });
    return sides;
}

/// Larger sides and the quarters of them that smaller cells have.
class JoinedSides {
  public:
    explicit JoinedSides(const HexMesh& mesh)
        : mesh_(mesh),
          joints_(mesh),
          larger_(mesh.face_hanging.size()),
          quarters_(mesh.face_hanging.size()) {}

    /// False when the side is neither.
    bool take(const HexSide& side) {
        if (const Joints::Diagonal* const quarter = joints_.quarter(side)) {
            quarters_[quarter->side].push_back(side);
            return true;
        }
        if (const Joints::Diagonal* const whole = joints_.whole(side)) {
            larger_[whole->side] = side;
            return true;
        }
        return false;
    }
    void append_to(AllSides& sides) const {
        for (std::size_t i = 0; i < larger_.size(); ++i) {
            if (!larger_[i]) continue;
            CoveredInPart part{*larger_[i], mesh_.face_hanging[i].node, {}};
            for (const HexSide& quarter : quarters_[i]) {
                sides.inner.push_back({quarter, part.side.cell});
                for (std::size_t k = 0; k < 4; ++k)
                    part.covered[k] =
                        part.covered[k] || std::find(quarter.corners.begin(), quarter.corners.end(),
                                                     part.side.corners[k]) != quarter.corners.end();
            }
            if (quarters_[i].size() < 4) sides.covered_in_part.push_back(part);
        }
    }

  private:
    const HexMesh& mesh_;
    Joints joints_;
    std::vector<std::optional<HexSide>> larger_;  ///< per node in the middle of one
    std::vector<std::vector<HexSide>> quarters_;
};

}  // namespace

std::vector<HexSide> unshared_sides(const HexMesh& mesh) {
    std::vector<HexSide> sides;
    for_each_side(
        mesh, [](const HexSide&, CellIndex) {}, [&](const HexSide& side) { sides.push_back(side); });
    return by_cell(std::move(sides));
}

BoundarySides boundary_sides(const HexMesh& mesh) {
    const Joints joints(mesh);
    std::vector<std::uint8_t> quarters(mesh.face_hanging.size(), 0);
    BoundarySides result;
    for (const HexSide& side : unshared_sides(mesh)) {
        if (const Joints::Diagonal* const quarter = joints.quarter(side))
            ++quarters[quarter->side];
        else if (!joints.whole(side))
            result.sides.push_back(side);
    }
    if (!mesh.is_octree()) take_halved(mesh, result.sides);
    for (const std::uint8_t count : quarters) result.partly_covered += count > 0 && count < 4;
    return result;
}

AllSides all_sides(const HexMesh& mesh) {
    AllSides sides;
    JoinedSides joined(mesh);
    std::vector<HexSide> alone;
    for_each_side(
        mesh,
        [&](const HexSide& side, CellIndex other) {
            sides.inner.push_back({side, other});
        },
        [&](const HexSide& side) {
            if (!joined.take(side)) alone.push_back(side);
        });
    sides.boundary = by_cell(std::move(alone));
    joined.append_to(sides);
    if (!mesh.is_octree()) {
        const std::vector<InnerSide> halves = take_halved(mesh, sides.boundary);
        sides.inner.insert(sides.inner.end(), halves.begin(), halves.end());
    }
    return sides;
}

}  // namespace octavo::mesh
