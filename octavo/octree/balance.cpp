// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>

#include <octavo/octree/balance.hpp>

namespace octavo::octree {
namespace {

/// A Morton code of one level, right-aligned: 3 · level bits, x lowest.
using Code = std::uint64_t;

constexpr Code lane_x = 0x1249249249249249ULL;

/// The 26 directions to a neighbour, and the code that lies there. A direction is 9 (dz + 1) + 3 (dy + 1) + dx + 1.
class Neighbours {
  public:
    explicit Neighbours(int level) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            lanes_[a] = (lane_x << axis) & ((Code{1} << (3 * level)) - 1);
        }
    }

    /// True, and the neighbour in `result`, unless that lies outside the universe.
    bool step(Code code, int direction, Code& result) const {
        for (std::size_t axis = 0; axis < 3; ++axis, direction /= 3) {
            const Code lane = lanes_[axis], own = code & lane;
            if (direction % 3 == 0) {
                if (own == 0) return false;
                code = (code & ~lane) | ((own - 1) & lane);
            } else if (direction % 3 == 2) {
                if (own == lane) return false;
                // Ones in the other lanes carry the sum on to the next bit of this one.
                code = (code & ~lane) | (((code | ~lane) + 1) & lane);
            }
        }
        result = code;
        return true;
    }

  private:
    std::array<Code, 3> lanes_;
};

constexpr int own_direction = 13;

/// For each set of split octants of a cell, the directions (a bit each) in which the cell's neighbours must be split.
std::array<std::uint32_t, 256> directions_asked_for(Contact contact) {
    std::array<std::uint32_t, 256> table{};
    const int most_axes = contact == Contact::face ? 1 : contact == Contact::edge ? 2 : 3;
    for (unsigned octants = 0; octants < 256; ++octants)
        for (int octant = 0; octant < 8; ++octant) {
            if (!(octants >> octant & 1)) continue;
            for (int axes = 1; axes < 8; ++axes) {
                if (std::popcount(static_cast<unsigned>(axes)) > most_axes) continue;
                int direction = own_direction;
                for (int axis = 0, weight = 1; axis < 3; ++axis, weight *= 3)
                    if (axes >> axis & 1) direction += octant >> axis & 1 ? weight : -weight;
                table[octants] |= 1U << direction;
            }
        }
    return table;
}

/// Sorts codes of `bits` bits. Bytes from the lowest: three or four passes for the levels that matter, where
/// std::sort takes a comparison for each of twenty.
void radix_sort(std::vector<Code>& codes, std::vector<Code>& spare, int bits) {
    if (codes.size() < 256) {
        std::sort(codes.begin(), codes.end());
        return;
    }
    spare.resize(codes.size());
    for (int shift = 0; shift < bits; shift += 8) {
        std::array<std::size_t, 256> begin{};
        for (const Code code : codes) ++begin[code >> shift & 255];
        std::size_t sum = 0;
        for (std::size_t& entry : begin) sum += std::exchange(entry, sum);
        for (const Code code : codes) spare[begin[code >> shift & 255]++] = code;
        codes.swap(spare);
    }
}

/// The split cells of a tree, sorted, a list for each level.
struct SplitCells {
    std::array<std::vector<Code>, max_level> of_level;

    std::size_t size() const {
        std::size_t sum = 0;
        for (const std::vector<Code>& codes : of_level) sum += codes.size();
        return sum;
    }
};

SplitCells split_cells_of(std::span<const CellKey> leaves) {
    SplitCells split;
    // A cell is split when its octant 0 is a leaf or split; both begin with the same leaf.
    for (const CellKey leaf : leaves) {
        Code code = leaf.code() >> (3 * (max_level - leaf.level()));
        for (int level = leaf.level(); level > 0 && (code & 7) == 0; --level) {
            code >>= 3;
            split.of_level[static_cast<std::size_t>(level - 1)].push_back(code);
        }
    }
    return split;
}

/// Merges the sorted `wanted`, which repeats itself, into the sorted `codes`.
void unite(std::vector<Code>& codes, std::vector<Code>& wanted, std::vector<Code>& spare) {
    wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
    spare.clear();
    spare.reserve(codes.size() + wanted.size());
    std::set_union(codes.begin(), codes.end(), wanted.begin(), wanted.end(), std::back_inserter(spare));
    codes.assign(spare.begin(), spare.end());
}

/// Adds to `coarse`, split cells of `level`, those that `fine`, the split cells of the next level, ask for.
void close_level(const std::vector<Code>& fine, std::vector<Code>& coarse, int level,
                 const std::array<std::uint32_t, 256>& asked_for) {
    const Neighbours neighbours(level);
    std::vector<Code> wanted, spare;
    for (std::size_t i = 0; i < fine.size();) {
        const Code parent = fine[i] >> 3;
        unsigned octants = 0;
        for (; i < fine.size() && fine[i] >> 3 == parent; ++i) octants |= 1U << (fine[i] & 7);
        wanted.push_back(parent);
        for (std::uint32_t set = asked_for[octants]; set != 0; set &= set - 1) {
            Code neighbour = 0;
            if (neighbours.step(parent, std::countr_zero(set), neighbour)) wanted.push_back(neighbour);
        }
    }
    radix_sort(wanted, spare, 3 * level);
    unite(coarse, wanted, spare);
}

/// Writes the leaves of a tree that is given by its split cells.
class LeafWriter {
  public:
    explicit LeafWriter(const SplitCells& split) : split_(split) {
        leaves_.reserve(1 + 7 * split.size());
        visit(0, 0);
    }
    std::vector<CellKey> take() { return std::move(leaves_); }

  private:
    void visit(Code code, int level) {
        if (level < max_level) {
            const auto l = static_cast<std::size_t>(level);
            const std::vector<Code>& split = split_.of_level[l];
            if (next_[l] < split.size() && split[next_[l]] == code) {
                ++next_[l];
                for (Code octant = 0; octant < 8; ++octant) visit(code << 3 | octant, level + 1);
                return;
            }
        }
        leaves_.push_back(CellKey::from_code(code << (3 * (max_level - level)), level));
    }

    const SplitCells& split_;
    std::array<std::size_t, max_level> next_{};
    std::vector<CellKey> leaves_;
};

/// The leaf that contains `key` or whose first descendant is the last one not after it.
LeafIndex find(std::span<const CellKey> leaves, CellKey key) {
    const auto after =
        std::upper_bound(leaves.begin(), leaves.end(), key.first_descendant(),
                         [](CellKey first, CellKey leaf) { return first < leaf.first_descendant(); });
    return static_cast<LeafIndex>(after - leaves.begin() - 1);
}

}  // namespace

std::vector<CellKey> balance(std::span<const CellKey> leaves, Contact contact) {
    OCTAVO_CHECK(!leaves.empty(), "the leaves of an octree fill the universe");
    SplitCells split = split_cells_of(leaves);
    const std::array<std::uint32_t, 256> asked_for = directions_asked_for(contact);
    for (int level = max_level - 2; level >= 0; --level) {
        const auto l = static_cast<std::size_t>(level);
        close_level(split.of_level[l + 1], split.of_level[l], level, asked_for);
    }
    return LeafWriter(split).take();
}

bool is_balanced(std::span<const CellKey> leaves, Contact contact) {
    const int most_axes = contact == Contact::face ? 1 : contact == Contact::edge ? 2 : 3;
    for (const CellKey leaf : leaves)
        for (int direction = 0; direction < 27; ++direction) {
            const int dx = direction % 3 - 1, dy = direction / 3 % 3 - 1, dz = direction / 9 - 1;
            const int axes = (dx != 0) + (dy != 0) + (dz != 0);
            if (axes == 0 || axes > most_axes) continue;
            // Larger neighbours are looked at from the smaller side, so only these can breach the rule here.
            const std::optional<CellKey> next = leaf.neighbour(dx, dy, dz);
            if (next && leaves[find(leaves, *next)].level() + 1 < leaf.level() &&
                leaves[find(leaves, *next)].contains(*next))
                return false;
        }
    return true;
}

std::vector<LeafIndex> origins(std::span<const CellKey> fine, std::span<const CellKey> coarse) {
    std::vector<LeafIndex> result(fine.size());
    LeafIndex at = 0;
    for (std::size_t i = 0; i < fine.size(); ++i) {
        while (coarse[at].last_descendant() < fine[i]) ++at;
        result[i] = at;
    }
    return result;
}

}  // namespace octavo::octree
