// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include <octavo/csg/leaves_in_cells.hpp>
#include <octavo/octree/morton.hpp>

namespace octavo::csg {
namespace {

using octree::Color;

// Fewer are as fast without; of more than twice as many places as leaves these are not small.
constexpr std::size_t fewest_leaves = 2000, most_places_a_leaf = 2;

Color without(std::uint32_t leaf_word) {
    return leaf_word & word::complement_bit ? Color::black : Color::white;
}

/// The cells of a level whose interior the box of a leaf meets, from the first to the last along each axis.
struct CellsOfBox {
    std::array<std::uint32_t, 3> first, last;

    CellsOfBox(const Leaf& leaf, int level) {
        const int shift = exact::coordinate_bits - level;
        for (std::size_t a = 0; a < 3; ++a) {
            first[a] = static_cast<std::uint32_t>(leaf.low[a]) >> shift;
            last[a] = static_cast<std::uint32_t>(leaf.high[a] - 1) >> shift;
        }
    }
    std::size_t count() const {
        std::size_t product = 1;
        for (std::size_t a = 0; a < 3; ++a) product *= last[a] - first[a] + 1;
        return product;
    }
    template <class Visit>
    void each(const Visit& visit) const {
        for (std::uint32_t z = first[2]; z <= last[2]; ++z)
            for (std::uint32_t y = first[1]; y <= last[1]; ++y)
                for (std::uint32_t x = first[0]; x <= last[0]; ++x)
                    visit(static_cast<std::uint32_t>(octree::spread_bits(x) | octree::spread_bits(y) << 1 |
                                                     octree::spread_bits(z) << 2));
    }
};

}  // namespace

std::optional<LeavesInCells> LeavesInCells::sort(const Program& program, std::span<const std::uint32_t> words,
                                                 int last) {
    if (words.size() <= fewest_leaves) return {};
    LeavesInCells result;
    if (!result.read(words) || !result.choose_level(program, last)) return {};
    result.place(program);
    return result;
}

/// Lists leaves and operations. False when there are too few leaves, or any that is not foreseen.
bool LeavesInCells::read(std::span<const std::uint32_t> words) {
    words_ = words;
    leaves_.reserve(words.size());
    std::vector<std::uint32_t> open;
    const auto add_operand = [&](Color color) {
        if (open.empty())
            color_without_ = color;
        else
            operations_[open.back()].decided_without += color == operations_[open.back()].deciding();
    };
    for (std::uint32_t at = 0; at < words.size(); ++at) {
        const std::uint32_t w = words[at];
        const std::uint32_t parent = open.empty() ? 0 : open.back();
        if (!word::is_leaf(w)) {
            if (word::operation(w) > word::intersection || open.size() == most_depth) return false;
            open.push_back(static_cast<std::uint32_t>(operations_.size()));
            operations_.push_back({w, at + (w & word::size_mask), parent, 0, Color::gray});
            continue;
        }
        if (open.empty() || (w & word::payload_bit)) return false;
        leaves_.push_back({at, parent});
        add_operand(without(w));
        while (!open.empty() && operations_[open.back()].end == at + 1) {
            Operation& closed = operations_[open.back()];
            const bool decided = closed.decided_without > 0;
            closed.without = decided ? closed.deciding() : octree::complement(closed.deciding());
            open.pop_back();
            add_operand(closed.without);
        }
    }
    return leaves_.size() >= fewest_leaves;
}

bool LeavesInCells::choose_level(const Program& program, int last) {
    for (int level = 1; level <= last && (std::size_t{1} << (3 * level)) <= leaves_.size(); ++level) {
        std::size_t places = 0;
        for (const PlacedLeaf& leaf : leaves_) places += CellsOfBox(leaf_of(program, leaf), level).count();
        if (places > most_places_a_leaf * leaves_.size()) break;
        level_ = level;
    }
    return level_ > 0;
}

void LeavesInCells::place(const Program& program) {
    begin_.resize((std::size_t{1} << (3 * level_)) + 1);
    for (const PlacedLeaf& leaf : leaves_)
        CellsOfBox(leaf_of(program, leaf), level_).each([&](std::uint32_t cell) { ++begin_[cell + 1]; });
    for (std::size_t cell = 1; cell < begin_.size(); ++cell) begin_[cell] += begin_[cell - 1];
    placed_.resize(begin_.back());
    // Backwards: the end of a cell's leaves, which is where the next begin, moves down to its own beginning.
    for (std::uint32_t i = static_cast<std::uint32_t>(leaves_.size()); i-- > 0;)
        CellsOfBox(leaf_of(program, leaves_[i]), level_).each([&](std::uint32_t cell) {
            placed_[--begin_[cell + 1]] = i;
        });
    std::copy(begin_.begin() + 1, begin_.end(), begin_.begin());
    begin_.back() = static_cast<std::uint32_t>(placed_.size());
}

Color LeavesInCells::write(std::uint32_t cell, Scratch<std::uint32_t>& to) const {
    std::array<Open, most_depth> open;
    std::size_t depth = 0;
    Color color = Color::gray;
    const std::size_t start = to.size();
    // The leaves, and at most as many operations as have one of them for their first.
    std::uint32_t* const words = to.room(count(cell, 1) * (most_depth + 1)) - start;
    std::size_t size = start;
    const auto close = [&] {
        const Open closed = open[--depth];
        const Operation& operation = operations_[closed.operation];
        color = Color::gray;
        if (closed.decided || closed.decided_without > 0)
            color = operation.deciding();
        else if (closed.operands == 0)
            color = octree::complement(operation.deciding());
        if (is_decided(color))
            size = closed.begin;
        else if (closed.operands == 1)
            words[closed.begin] = std::uint32_t{word::skip} << word::operation_shift;
        else
            words[closed.begin] =
                (operation.word & ~word::size_mask) | static_cast<std::uint32_t>(size - closed.begin);
        if (depth == 0) return;
        Open& around = open[depth - 1];
        around.operands += color == Color::gray;
        around.decided |= color == operations_[around.operation].deciding();
    };
    /// An operand that has a leaf here decides nothing by being without.
    const auto take_in = [&](Color color_of_operand) {
        Open& around = open[depth - 1];
        around.decided_without -= color_of_operand == operations_[around.operation].deciding();
    };
    for (std::uint32_t i = begin_[cell]; i < begin_[cell + 1]; ++i) {
        const PlacedLeaf& leaf = leaves_[placed_[i]];
        while (depth > 0 && operations_[open[depth - 1].operation].end <= leaf.at) close();
        // The operations from the one that is open down to the leaf's own.
        std::array<std::uint32_t, most_depth> path;
        std::size_t steps = 0;
        for (std::uint32_t up = leaf.parent; depth == 0 || up != open[depth - 1].operation;
             up = operations_[up].parent) {
            path[steps++] = up;
            if (up == 0) break;
        }
        while (steps-- > 0) {
            const Operation& operation = operations_[path[steps]];
            if (depth > 0) take_in(operation.without);
            open[depth++] = {path[steps], size++, 0, operation.decided_without, false};
        }
        take_in(without(words_[leaf.at]));
        words[size++] = words_[leaf.at];
        ++open[depth - 1].operands;
    }
    while (depth > 0) close();
    to.end_at(words + size);
    return color;
}

std::size_t LeavesInCells::memory_bytes() const {
    return operations_.capacity() * sizeof(Operation) + leaves_.capacity() * sizeof(PlacedLeaf) +
           (begin_.capacity() + placed_.capacity()) * sizeof(std::uint32_t);
}

}  // namespace octavo::csg
