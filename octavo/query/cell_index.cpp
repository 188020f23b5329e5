// SPDX-License-Identifier: Apache-2.0
#include <octavo/query/cell_index.hpp>

namespace octavo::query {
namespace {

/// The dense table has about as many cells as there are leaves, and at most 2^18 (level 6, 1 MiB): larger ones fall
/// out of the cache, smaller ones put a brick between more points and their leaf.
int top_level_for(std::size_t leaves) {
    int level = 0;
    while (level < 6 && (std::size_t{1} << (3 * (level + 1))) <= leaves) ++level;
    return level;
}

}  // namespace

/// Walks the leaves once, in Morton order.
class CellIndex::Builder {
  public:
    Builder(CellIndex& index, std::span<const Item> items) : index_(index), items_(items) {}

    void run() {
        index_.top_level_ = top_level_for(items_.size());
        const std::uint64_t cells = std::uint64_t{1} << (3 * index_.top_level_);
        index_.top_.reserve(cells);
        for (std::uint64_t cell = 0; cell < cells; ++cell) {
            const Entry entry = entry_of(cell, index_.top_level_);
            index_.top_.push_back(static_cast<std::uint32_t>(entry.kind) << 30 | entry.value);
        }
        index_.bricks_.shrink_to_fit();
    }

  private:
    /// The cell of this level with this code; the next item lies in it or fills it.
    Entry entry_of(std::uint64_t cell, int level) {
        const Item& item = items_[next_];
        if (item.key.level() <= level) {
            if (ends_with(item.key, cell, level)) ++next_;
            return item.entry;
        }
        std::array<Entry, brick_cells> entries;
        for (std::uint64_t i = 0; i < brick_cells; ++i)
            entries[i] = entry_of(cell << (3 * brick_levels) | i, level + brick_levels);
        return {Kind::brick, write(entries)};
    }

    /// Whether the cell is the last of its level in the leaf.
    static bool ends_with(const octree::CellKey& leaf, std::uint64_t cell, int level) {
        const std::uint64_t within = (std::uint64_t{1} << (3 * (level - leaf.level()))) - 1;
        return (cell & within) == within;
    }

    std::uint32_t write(const std::array<Entry, brick_cells>& entries) {
        const auto at = static_cast<std::uint32_t>(index_.bricks_.size());
        std::array<std::uint64_t, 3> masks{};
        index_.bricks_.resize(at + head_words);
        for (std::size_t i = 0; i < brick_cells; ++i) {
            const Entry& entry = entries[i];
            const auto kind = static_cast<std::uint64_t>(entry.kind);
            masks[0] |= (kind & 1) << i;
            masks[1] |= (kind >> 1) << i;
            if (kind < 2 ||
                (i > 0 && entries[i - 1].kind == entry.kind && entries[i - 1].value == entry.value))
                continue;
            masks[2] |= std::uint64_t{1} << i;
            index_.bricks_.push_back(entry.value);
        }
        std::memcpy(index_.bricks_.data() + at, masks.data(), sizeof masks);
        return at;
    }

    CellIndex& index_;
    std::span<const Item> items_;
    std::size_t next_ = 0;
};

CellIndex::CellIndex(std::span<const Item> items) { Builder(*this, items).run(); }

}  // namespace octavo::query
