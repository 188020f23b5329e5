// SPDX-License-Identifier: Apache-2.0
#include <octavo/query/cell_index.hpp>
#include <octavo/query/leaf_record.hpp>

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
    Builder(CellIndex& index, std::span<const Item> items, std::span<const std::uint32_t> records)
        : index_(index), items_(items), records_(records) {}

    void run() {
        const int level = top_level_for(items_.size());
        index_.top_level_ = level;
        const std::uint64_t cells = std::uint64_t{1} << (3 * level);
        index_.kinds_.resize((8 * cells + cells_a_word - 1) / cells_a_word);
        index_.top_.reserve(cells);
        index_.words_.reserve(count_words());
        Entry last, kept;  // Coarse leaves fill several cells in a row.
        for (std::uint64_t cell = 0; cell < cells; ++cell) {
            const Entry entry = entry_of(cell, level);
            if (!(entry == last)) {
                last = kept = entry;
                if (entry.kind == Kind::gray) kept.value = keep_record(entry.value);
            }
            keep_kinds(cell, kept);
            index_.top_.push_back(static_cast<std::uint32_t>(kept.kind) << 30 | kept.value);
        }
    }

  private:
    /// The kinds of the octants of a cell of the table.
    void keep_kinds(std::uint64_t cell, Entry entry) {
        static_assert(brick_levels == 2, "an octant of the brick is a byte of its masks");
        std::array<std::uint64_t, 2> masks{};
        if (entry.kind == Kind::brick)
            std::memcpy(masks.data(), index_.words_.data() + entry.value, sizeof masks);
        for (std::uint64_t octant = 8 * cell; octant < 8 * cell + 8; ++octant) {
            Kind kind = entry.kind;
            const std::uint64_t shift = octant % 8 * 8, a = masks[0] >> shift & 0xff,
                                b = masks[1] >> shift & 0xff;
            if (kind == Kind::brick && b == 0 && a == 0) kind = Kind::white;
            if (kind == Kind::brick && b == 0 && a == 0xff) kind = Kind::black;
            index_.kinds_[octant / cells_a_word] |= static_cast<std::uint64_t>(kind)
                                                    << 2 * (octant % cells_a_word);
        }
    }

    /// Of all bricks and records, so that they never have to move while they grow.
    std::size_t count_words() const {
        std::size_t words = records_.size();
        for (std::size_t i = 0; i < items_.size(); ++i) {
            const Item& item = items_[i];
            if (item.entry.kind == Kind::gray && item.key.level() > index_.top_level_) ++words;
            // A brick begins with its first leaf, and all but those of the table have a word in another.
            for (int level = index_.top_level_; level < item.key.level(); level += brick_levels) {
                const int shift = 3 * (octree::max_level - level);
                if (i == 0 || item.key.code() >> shift != items_[i - 1].key.code() >> shift)
                    words += head_words + (level > index_.top_level_);
            }
        }
        return words;
    }

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
        auto& words = index_.words_;
        const auto at = static_cast<std::uint32_t>(words.size());
        std::array<std::uint64_t, 3> masks{};
        words.resize(at + head_words);
        for (std::size_t i = 0; i < brick_cells; ++i) {
            const Entry& entry = entries[i];
            const auto kind = static_cast<std::uint64_t>(entry.kind);
            masks[0] |= (kind & 1) << i;
            masks[1] |= (kind >> 1) << i;
            if (kind < 2 || (i > 0 && entries[i - 1] == entry)) continue;
            masks[2] |= std::uint64_t{1} << i;
            words.push_back(entry.value);
        }
        std::memcpy(words.data() + at, masks.data(), sizeof masks);
        std::size_t word = at + head_words;
        for (std::uint64_t begun = masks[2]; begun != 0; begun &= begun - 1, ++word)
            if (entries[static_cast<std::size_t>(std::countr_zero(begun))].kind == Kind::gray)
                words[word] = keep_record(words[word]);
        return at;
    }

    std::uint32_t keep_record(std::uint32_t record) {
        const std::uint32_t* words = records_.data() + record;
        const auto at = static_cast<std::uint32_t>(index_.words_.size());
        index_.words_.insert(index_.words_.end(), words, words + LeafRecord::size_of(words));
        return at;
    }

    CellIndex& index_;
    std::span<const Item> items_;
    std::span<const std::uint32_t> records_;
    std::size_t next_ = 0;
};

CellIndex::CellIndex(std::span<const Item> items, std::span<const std::uint32_t> records) {
    Builder(*this, items, records).run();
}

}  // namespace octavo::query
