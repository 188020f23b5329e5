// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include <octavo/hexmesh/cell_tree.hpp>
#include <octavo/hexmesh/number.hpp>

namespace octavo::hexmesh {
namespace {

using mesh::NodeIndex;
using octree::CellKey;
using octree::max_level;
using Leaf = std::uint32_t;

// Slots of a leaf: the low corner; the middles of the low edges along x, y, z; the centres of the low faces across z,
// y, x; and, on those edges, the first and the last quarters, which only balance by face leaves in use.
constexpr int slot_count = 13;
constexpr std::uint8_t no_slot = 255;

/// The slot of a position inside a leaf, given in quarters of its side: bits 3-5 are the halves, 0-2 the quarters.
constexpr std::array<std::uint8_t, 64> make_slots() {
    std::array<std::uint8_t, 64> slots{};
    for (std::uint8_t& slot : slots) slot = no_slot;
    slots[0] = 0;
    for (std::uint8_t axis = 0; axis < 3; ++axis) {
        const std::size_t bit = std::size_t{1} << axis;
        slots[bit << 3] = static_cast<std::uint8_t>(1 + axis);
        slots[(7 ^ bit) << 3] = static_cast<std::uint8_t>(6 - axis);
        slots[bit] = static_cast<std::uint8_t>(7 + axis);
        slots[bit << 3 | bit] = static_cast<std::uint8_t>(10 + axis);
    }
    return slots;
}
constexpr std::array<std::uint8_t, 64> slots = make_slots();
static_assert(slots[3 << 3] == 4 && slots[5 << 3] == 5 && slots[6 << 3] == 6);

constexpr std::uint64_t lane_of(int axis) { return (0x1249249249249249ULL << axis) & 0x7FFFFFFFFFFFFFFFULL; }

/// The left-aligned code of the point that lies one side of a cell of `level` away from `code` along the axes in
/// `offset`. Must stay inside the universe.
constexpr std::uint64_t moved(std::uint64_t code, unsigned offset, int level) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(offset >> axis & 1)) continue;
        const std::uint64_t lane = lane_of(axis), step = std::uint64_t{1} << (3 * (max_level - level) + axis);
        code = (code & ~lane) | (((code | ~lane) + step) & lane);
    }
    return code;
}

std::uint8_t slot_of(CellKey home, std::uint64_t point) {
    const std::uint64_t inside = point - home.code();
    const int spare = 3 * (max_level - 2 - home.level());
    const std::uint64_t quarters = spare >= 0 ? inside >> spare : inside << -spare;
    if (quarters >= 64 || (spare >= 0 && quarters << spare != inside)) return no_slot;
    return slots[quarters];
}

exact::Point corner_point(CellKey key, unsigned corner) {
    const exact::Point low = key.low();
    const std::int32_t side = key.side();
    return {low.x + (corner & 1 ? side : 0), low.y + (corner & 2 ? side : 0),
            low.z + (corner & 4 ? side : 0)};
}

/// Which leaves are kept, and how many before a leaf: 1.5 bits a leaf.
class KeptLeaves {
  public:
    KeptLeaves(std::span<const std::uint8_t> kept, std::size_t leaves) : words_(leaves / 64 + 1) {
        for (std::size_t leaf = 0; leaf < leaves; ++leaf)
            if (kept.empty() || kept[leaf]) words_[leaf / 64].bits |= std::uint64_t{1} << leaf % 64;
        for (Word& word : words_) {
            word.before = count_;
            count_ += static_cast<std::uint32_t>(std::popcount(word.bits));
        }
    }

    std::uint32_t count() const { return count_; }
    bool contains(Leaf leaf) const { return words_[leaf / 64].bits >> leaf % 64 & 1; }
    mesh::CellIndex rank(Leaf leaf) const {
        const Word& word = words_[leaf / 64];
        const std::uint64_t before = word.bits & ((std::uint64_t{1} << leaf % 64) - 1);
        return word.before + static_cast<std::uint32_t>(std::popcount(before));
    }

  private:
    struct Word {
        std::uint64_t bits = 0;
        std::uint32_t before = 0;
    };
    std::vector<Word> words_;
    std::uint32_t count_ = 0;
};

class Numberer {
  public:
    Numberer(std::span<const CellKey> leaves, std::span<const std::uint8_t> kept)
        : leaves_(leaves), kept_(kept, leaves.size()), tree_(leaves), used_(leaves.size()) {
        for (const CellKey leaf : leaves) deepest_ = std::max(deepest_, leaf.level());
    }

    Status run() {
        find_homes();
        if (!count_nodes()) return Error{ErrorCode::limit, "the mesh has more than 2^32 - 1 nodes", {}};
        number_corners();
        find_hanging();
        // Nodes last, when all that they do not need is gone: the peak of memory is here.
        tree_ = CellTree({});
        listed_ = {};
        first_node_ = {};
        place_nodes();
        return Done{};
    }
    Numbering take() { return std::move(result_); }

  private:
    /// Notes for each corner its home leaf, and marks the home's slot as used.
    void find_homes() {
        result_.corners.reserve(kept_.count());
        away_.reserve(kept_.count());
        tree_.for_each_leaf([&](Leaf leaf, int level, const CellTree::Block& block) {
            if (!kept_.contains(leaf)) return;
            std::array<NodeIndex, 8>& corners = result_.corners.emplace_back();
            std::uint8_t away = 0;
            corners[0] = leaf;
            used_[leaf] |= 1;
            for (unsigned corner = 1; corner < 8; ++corner) {
                const CellTree::Ref ref = block[corner];
                if (ref == CellTree::none) {
                    sides_.push_back(corner_point(leaves_[leaf], corner));
                    away = static_cast<std::uint8_t>(away | 1U << corner);
                    corners[corner] = CellTree::none;
                    continue;
                }
                const Leaf home = tree_.first_leaf(ref);
                std::uint8_t slot = 0;
                if (block.larger >> corner & 1) {
                    slot = slot_of(leaves_[home], moved(leaves_[leaf].code(), corner, level));
                    OCTAVO_CHECK(slot != no_slot, "the leaves are not balanced");
                    if (slot != 0) away = static_cast<std::uint8_t>(away | 1U << corner);
                }
                used_[home] = static_cast<std::uint16_t>(used_[home] | 1U << slot);
                corners[corner] = home;
            }
            away_.push_back(away);
        });
        std::sort(sides_.begin(), sides_.end());
        sides_.erase(std::unique(sides_.begin(), sides_.end()), sides_.end());
    }

    /// False when there are too many.
    bool count_nodes() {
        first_node_.resize(leaves_.size());
        std::uint64_t count = 0;
        for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) {
            first_node_[leaf] = static_cast<NodeIndex>(count);
            count += static_cast<std::uint64_t>(std::popcount(used_[leaf]));
        }
        first_side_ = static_cast<NodeIndex>(count);
        node_count_ = count + sides_.size();
        return node_count_ < ~NodeIndex{0};
    }

    bool is_used(Leaf home, unsigned slot) const { return used_[home] >> slot & 1; }
    NodeIndex node_of(Leaf home, unsigned slot) const {
        const unsigned before = used_[home] & ((1U << slot) - 1);
        return first_node_[home] + static_cast<NodeIndex>(std::popcount(before));
    }
    /// The node on a high side of the universe; `node_count` when there is none.
    NodeIndex node_on_side(exact::Point point) const {
        const auto found = std::lower_bound(sides_.begin(), sides_.end(), point);
        if (found == sides_.end() || *found != point) return static_cast<NodeIndex>(node_count_);
        return first_side_ + static_cast<NodeIndex>(found - sides_.begin());
    }

    /// Replaces homes by nodes.
    void number_corners() {
        std::size_t cell = 0;
        for (Leaf leaf = 0; leaf < leaves_.size(); ++leaf) {
            if (!kept_.contains(leaf)) continue;
            std::array<NodeIndex, 8>& corners = result_.corners[cell];
            const unsigned away = away_[cell++];
            for (unsigned corner = 0; corner < 8; ++corner) {
                NodeIndex& entry = corners[corner];
                if (!(away >> corner & 1))
                    entry = first_node_[entry];  // slot 0 is the first
                else if (entry == CellTree::none)
                    entry = node_on_side(corner_point(leaves_[leaf], corner));
                else
                    entry = node_of(entry, slot_of(leaves_[entry], moved(leaves_[leaf].code(), corner,
                                                                         leaves_[leaf].level())));
            }
        }
        away_ = {};
    }

    void place_nodes() {
        result_.nodes.reserve(node_count_);
        for (Leaf leaf = 0; leaf < leaves_.size(); ++leaf) {
            const exact::Point low = used_[leaf] ? leaves_[leaf].low() : exact::Point{};
            const std::int32_t quarter = leaves_[leaf].side() / 4;
            for (unsigned set = used_[leaf]; set != 0; set &= set - 1) {
                const std::array<std::int8_t, 3>& at =
                    quarters_of_slot[static_cast<std::size_t>(std::countr_zero(set))];
                result_.nodes.push_back(
                    {low.x + at[0] * quarter, low.y + at[1] * quarter, low.z + at[2] * quarter});
            }
        }
        result_.nodes.insert(result_.nodes.end(), sides_.begin(), sides_.end());
    }

    /// Looks at the middles of the edges and faces of every kept cell that is not of the smallest size.
    void find_hanging() {
        listed_.assign(node_count_ / 64 + 1, 0);
        // More than enough as a rule; what is not written to takes no memory, and growing would take twice as much.
        result_.edge_hanging.reserve(kept_.count());
        result_.face_hanging.reserve(kept_.count());
        const auto visit = [&](Leaf leaf, int level, const CellTree::Block& block) {
            if (level == deepest_ || !kept_.contains(leaf) || !may_have_hanging(block)) return;
            const std::array<NodeIndex, 8>& corners = result_.corners[kept_.rank(leaf)];
            for (unsigned axis = 0; axis < 3; ++axis) {
                const unsigned along = 1U << axis, first = 1U << (axis + 1) % 3,
                               second = 1U << (axis + 2) % 3;
                for (const unsigned edge : {0U, first, second, first | second}) {
                    const NodeIndex node = node_at(leaf, level, block, edge, along);
                    if (list(node))
                        result_.edge_hanging.push_back({node, {corners[edge], corners[edge | along]}});
                }
                for (const unsigned face : {0U, along}) {
                    const NodeIndex node = node_at(leaf, level, block, face, first | second);
                    if (list(node))
                        result_.face_hanging.push_back(
                            {node,
                             {corners[face], corners[face | first], corners[face | second],
                              corners[face | first | second]}});
                }
            }
        };
        // Octants of cells of the last level but one are of the smallest size.
        tree_.for_each_leaf(visit, deepest_ - 1);
    }

    /// False only when no edge or face of the block's first cell has a node in its middle.
    bool may_have_hanging(const CellTree::Block& block) const {
        for (std::size_t i = 0; i < 7; ++i) {
            const CellTree::Ref ref = block[i];
            if (CellTree::is_leaf(ref) ? used_[ref] > 1 : ref != CellTree::none || !sides_.empty())
                return true;
        }
        return false;
    }

    /// The node half a side along the axes of `middle` from the corner `corner` of a leaf; `node_count` when there is
    /// none.
    NodeIndex node_at(Leaf leaf, int level, const CellTree::Block& block, unsigned corner,
                      unsigned middle) const {
        const CellTree::Ref ref = block[corner];
        const auto nothing = static_cast<NodeIndex>(node_count_);
        if (ref == CellTree::none) {
            if (sides_.empty()) return nothing;
            exact::Point point = corner_point(leaves_[leaf], corner);
            const std::int32_t half = leaves_[leaf].side() / 2;
            point = {point.x + (middle & 1 ? half : 0), point.y + (middle & 2 ? half : 0),
                     point.z + (middle & 4 ? half : 0)};
            return node_on_side(point);
        }
        if (CellTree::is_inner(ref)) {
            const Leaf home = tree_.first_leaf(tree_.octant(ref, static_cast<int>(middle)));
            return is_used(home, 0) ? first_node_[home] : nothing;
        }
        std::uint8_t slot = slots[middle << 3];
        if (block.larger >> corner & 1) {
            // Only face balance gets here with a node: a smaller cell and a larger one that meet at an edge.
            const std::uint64_t point = moved(moved(leaves_[leaf].code(), corner, level), middle, level + 1);
            slot = slot_of(leaves_[ref], point);
        }
        return slot != no_slot && is_used(ref, slot) ? node_of(ref, slot) : nothing;
    }

    /// Whether the node exists and is not listed yet.
    bool list(NodeIndex node) {
        if (node == node_count_) return false;
        std::uint64_t& word = listed_[node / 64];
        const std::uint64_t bit = std::uint64_t{1} << node % 64;
        if (word & bit) return false;
        word |= bit;
        return true;
    }

    static constexpr std::array<std::array<std::int8_t, 3>, slot_count> quarters_of_slot{{{0, 0, 0},
                                                                                          {2, 0, 0},
                                                                                          {0, 2, 0},
                                                                                          {0, 0, 2},
                                                                                          {2, 2, 0},
                                                                                          {2, 0, 2},
                                                                                          {0, 2, 2},
                                                                                          {1, 0, 0},
                                                                                          {0, 1, 0},
                                                                                          {0, 0, 1},
                                                                                          {3, 0, 0},
                                                                                          {0, 3, 0},
                                                                                          {0, 0, 3}}};

    std::span<const CellKey> leaves_;
    KeptLeaves kept_;
    CellTree tree_;
    int deepest_ = 0;                  ///< level of the smallest leaves
    std::vector<std::uint16_t> used_;  ///< per leaf, a bit for each slot
    std::vector<std::uint8_t> away_;   ///< per kept leaf, the corners that are not low corners of their homes
    std::vector<exact::Point> sides_;  ///< nodes on the high sides of the universe, sorted
    std::vector<NodeIndex> first_node_;  ///< per leaf
    NodeIndex first_side_ = 0;
    std::uint64_t node_count_ = 0;
    std::vector<std::uint64_t> listed_;  ///< a bit per node
    Numbering result_;
};

}  // namespace

Result<Numbering> number_nodes(std::span<const CellKey> leaves, std::vector<std::uint8_t> kept) {
    OCTAVO_CHECK(kept.empty() || kept.size() == leaves.size(), "one entry of kept for each leaf");
    if (leaves.size() > CellTree::most_leaves)
        return Error{ErrorCode::limit, "the octree has more than 2^31 - 2 leaves", {}};
    Numberer numberer(leaves, kept);
    kept = {};  // it has its own bits
    if (Status status = numberer.run(); !status) return status.error();
    return numberer.take();
}

}  // namespace octavo::hexmesh
