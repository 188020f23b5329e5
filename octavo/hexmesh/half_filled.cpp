// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include <octavo/hexmesh/find_leaf.hpp>
#include <octavo/hexmesh/half_filled.hpp>
#include <octavo/mesh/filled_parts.hpp>

namespace octavo::hexmesh {
namespace {

using exact::Point;
using octree::CellKey;

/// Octants round a corner as bits: bit i is octant i.
using Octants = unsigned;

/// Whether each of the octants can be reached from any other through common sides.
bool is_connected(Octants octants) {
    Octants reached = octants & (0 - octants);
    for (Octants before = 0; before != reached;) {
        before = reached;
        for (unsigned i = 0; i < 8; ++i)
            if (before >> i & 1)
                for (unsigned axis = 0; axis < 3; ++axis) reached |= octants & 1U << (i ^ 1U << axis);
    }
    return reached == octants;
}

/// Whether sides between in and out that lie across one axis all face the same way.
bool faces_one_way(Octants in) {
    for (unsigned axis = 0; axis < 3; ++axis) {
        bool up = false, down = false;
        for (unsigned low = 0; low < 8; ++low) {
            if (low >> axis & 1) continue;
            const bool below = in >> low & 1, above = in >> (low | 1U << axis) & 1;
            up |= below && !above;
            down |= !below && above;
        }
        if (up && down) return false;
    }
    return true;
}

std::array<bool, 256> make_plain_corners() {
    std::array<bool, 256> plain{};
    for (Octants in = 0; in < 256; ++in)
        plain[in] = is_connected(in) && is_connected(~in & 0xFFU) && faces_one_way(in);
    return plain;
}

/// Turns boundary cells in or out until all corners are plain.
class ManifoldBoundary {
  public:
    ManifoldBoundary(const ClassifiedCells& cells, const std::vector<double>& filled,
                     std::vector<std::uint8_t>& kept)
        : cells_(cells), filled_(filled), kept_(kept), turned_(kept.size(), 0) {}

    void run() {
        for (std::size_t i = 0; i < kept_.size(); ++i)
            if (!cells_.sets[cells_.set_of_cell[i]].boundary.empty()) look_round(i);
        // Each cell is turned once at most, so this ends; more than a few rounds find nothing new to turn.
        constexpr int rounds = 8;
        for (int round = 0; round < rounds && !next_.empty(); ++round)
            for (const Point corner : take_next()) mend_by_turning(corner);
        for (std::size_t i = 0; i < kept_.size(); ++i)
            if (turned_[i]) look_round(i);
        next_.insert(next_.end(), unmended_.begin(), unmended_.end());
        while (!next_.empty())
            for (const Point corner : take_next()) mend_by_leaving_out(corner);
    }

  private:
    static constexpr std::size_t nowhere = ~std::size_t{0};

    /// The leaves of the octants round a corner, and which of them are kept.
    struct Corner {
        std::array<std::size_t, 8> leaves;
        Octants in = 0;
    };
    Corner corner_at(Point p) const {
        Corner corner{};
        for (unsigned i = 0; i < 8; ++i) {
            const Point inside{p.x - (i & 1 ? 0 : 1), p.y - (i & 2 ? 0 : 1), p.z - (i & 4 ? 0 : 1)};
            corner.leaves[i] = find_leaf(cells_.keys, inside).value_or(nowhere);
            if (corner.leaves[i] != nowhere && kept_[corner.leaves[i]]) corner.in |= 1U << i;
        }
        return corner;
    }
    /// Corners of a cell, and middles of its edges and sides, where smaller cells may have corners.
    void look_round(std::size_t leaf) {
        const Point low = cells_.keys[leaf].low();
        const std::int32_t half = cells_.keys[leaf].side() / 2;
        for (int i = 0; i < 27; ++i)
            if (i != 13)
                next_.push_back({low.x + i % 3 * half, low.y + i / 3 % 3 * half, low.z + i / 9 * half});
    }
    std::vector<Point> take_next() {
        std::sort(next_.begin(), next_.end());
        next_.erase(std::unique(next_.begin(), next_.end()), next_.end());
        return std::exchange(next_, {});
    }

    static Octants octants_of(const Corner& corner, std::size_t leaf) {
        Octants octants = 0;
        for (unsigned i = 0; i < 8; ++i) octants |= unsigned{corner.leaves[i] == leaf} << i;
        return octants;
    }

    void mend_by_turning(Point p) {
        const Corner corner = corner_at(p);
        if (plain_[corner.in]) return;
        std::size_t best = nowhere;
        for (const std::size_t leaf : corner.leaves) {
            if (leaf == nowhere || turned_[leaf] || cells_.sets[cells_.set_of_cell[leaf]].boundary.empty())
                continue;
            if (!plain_[corner.in ^ octants_of(corner, leaf)]) continue;
            if (best == nowhere || std::fabs(filled_[leaf] - 0.5) < std::fabs(filled_[best] - 0.5))
                best = leaf;
        }
        if (best == nowhere) {
            unmended_.push_back(p);
            return;
        }
        kept_[best] ^= 1U;
        turned_[best] = 1;
        look_round(best);
    }

    void mend_by_leaving_out(Point p) {
        Corner corner = corner_at(p);
        while (!plain_[corner.in]) {
            std::size_t least = nowhere;
            for (unsigned i = 0; i < 8; ++i)
                if (corner.in >> i & 1 && (least == nowhere || filled_[corner.leaves[i]] < filled_[least]))
                    least = corner.leaves[i];
            corner.in &= ~octants_of(corner, least);
            kept_[least] = 0;
            look_round(least);
        }
    }

    const ClassifiedCells& cells_;
    const std::vector<double>& filled_;
    std::vector<std::uint8_t>& kept_;
    std::vector<std::uint8_t> turned_;
    std::vector<Point> next_, unmended_;
    const std::array<bool, 256> plain_ = make_plain_corners();
};

/// Parts of cells, as far as they decide anything, in steps. Sums over facets are rounded, and a cell that is exactly
/// half filled would be in or out by how its surface happens to be cut into triangles. A step is 16 times the error
/// where a facet is 2^21 times as large as the cell, 2^-32 (cell_volume.hpp), and no more than half a unit of the
/// lattice, which is what rounding moves a vertex by, makes of any cell: the largest is 2^26 units wide.
std::vector<double> in_steps(const std::vector<double>& parts) {
    constexpr double step = 0x1p-28;
    std::vector<double> result;
    result.reserve(parts.size());
    for (const double part : parts) result.push_back(step * std::nearbyint(part / step));
    return result;
}

/// The solids that a kept cell goes to. `fractions` are those of `set.boundary`.
mesh::SolidSet decided(const mesh::SolidSet& set, std::span<const double> fractions) {
    mesh::SolidSet result;
    result.inside = set.inside;
    for (std::size_t i = 0; i < fractions.size(); ++i)
        if (fractions[i] >= 0.5) result.boundary.push_back(set.boundary[i]);
    if (result.boundary.empty() && set.inside.empty())
        result.boundary.push_back(set.boundary[static_cast<std::size_t>(
            std::max_element(fractions.begin(), fractions.end()) - fractions.begin())]);
    return result;
}

/// Gives each cell the set of the solids that it goes to by `parts`, none when it is not kept. False when there are too
/// many sets.
bool assign_sets(ClassifiedCells& cells, const std::vector<double>& parts,
                 const std::vector<std::uint8_t>& kept) {
    std::map<std::pair<std::vector<mesh::SolidIndex>, std::vector<mesh::SolidIndex>>, std::uint16_t> numbers;
    std::vector<mesh::SolidSet> sets{mesh::SolidSet{}};
    numbers.emplace(std::pair(sets[0].inside, sets[0].boundary), std::uint16_t{0});
    std::vector<double> kept_fractions;
    std::size_t next = 0;
    for (std::size_t cell = 0; cell < kept.size(); ++cell) {
        std::uint16_t& number = cells.set_of_cell[cell];
        const mesh::SolidSet& set = cells.sets[number];
        mesh::SolidSet changed =
            kept[cell] ? decided(set, std::span(parts).subspan(next, set.boundary.size())) : mesh::SolidSet{};
        for (std::size_t i = 0; i < set.boundary.size(); ++i)
            if (std::find(changed.boundary.begin(), changed.boundary.end(), set.boundary[i]) !=
                changed.boundary.end())
                kept_fractions.push_back(cells.fractions[next + i]);
        next += set.boundary.size();
        const auto [at, fresh] = numbers.try_emplace(std::pair(changed.inside, changed.boundary),
                                                     static_cast<std::uint16_t>(sets.size()));
        if (fresh) sets.push_back(std::move(changed));
        if (sets.size() > most_sets) return false;
        number = at->second;
    }
    cells.sets = std::move(sets);
    cells.fractions = std::move(kept_fractions);
    return true;
}

}  // namespace

Result<HalfFilled> decide_by_half(ClassifiedCells& cells, Keep keep) {
    const std::vector<double> parts = in_steps(cells.fractions);
    const std::vector<double> filled = mesh::filled_parts(cells.sets, cells.set_of_cell, parts);
    std::vector<std::uint8_t> kept(cells.keys.size());
    for (std::size_t i = 0; i < filled.size(); ++i) kept[i] = filled[i] >= 0.5;
    HalfFilled changes;
    if (keep == Keep::manifold) {
        const std::vector<std::uint8_t> before = kept;
        ManifoldBoundary(cells, filled, kept).run();
        for (std::size_t i = 0; i < kept.size(); ++i) {
            changes.added += kept[i] && !before[i];
            changes.left_out += before[i] && !kept[i];
        }
    }
    if (!assign_sets(cells, parts, kept)) return too_many_sets();
    return changes;
}

}  // namespace octavo::hexmesh
