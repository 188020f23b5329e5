// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bp_octree/bpo_reader.hpp>

namespace octavo::bp_octree {
namespace {

using octree::Cell;
using octree::Node;

std::vector<std::uint8_t> copy_of(const io::ByteBlock& block) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(block.bytes().data());
    return {bytes, bytes + block.size()};
}

}  // namespace

Result<BpoReader> BpoReader::open(const std::string& path) {
    auto file = io::RangeReader::open(path);
    if (!file) return file.error();
    BpoReader reader(std::move(*file));
    const auto in_file = [&](Error error) {
        error.place.file = path;
        return error;
    };
    // Head, levels and the index of most files.
    constexpr std::uint64_t first_read = 65536;
    auto beginning =
        reader.file_.read(0, static_cast<std::size_t>(std::min(reader.file_.size(), first_read)));
    if (!beginning) return beginning.error();
    std::vector<std::uint8_t> bytes = copy_of(*beginning);
    auto head = get_head(bytes);
    if (!head) return in_file(head.error());
    reader.head_ = head->head;
    reader.levels_ = std::move(head->levels);
    const std::uint64_t pages = (std::uint64_t{reader.head_.chunks} + entries_a_page - 1) / entries_a_page;
    const std::uint64_t needed = reader.head_.index_at() + pages * page_size;
    if (needed > bytes.size()) {
        auto all = reader.file_.read(0, static_cast<std::size_t>(std::min(reader.file_.size(), needed)));
        if (!all) return all.error();
        bytes = copy_of(*all);
    }
    auto entries = get_index(reader.head_, bytes);
    if (!entries) return in_file(entries.error());
    reader.entries_ = std::move(*entries);
    std::size_t at = 0;
    for (std::size_t level = 0; level < reader.levels_.size(); ++level) {
        reader.level_begin_.push_back(at);
        while (at < reader.entries_.size() && reader.entries_[at].kind == ChunkKind::envelopes &&
               reader.entries_[at].level == level)
            ++at;
        if (at == reader.level_begin_.back())
            return in_file(damaged_bpo("a level is missing", Place::no_byte));
    }
    reader.level_begin_.push_back(at);
    const auto is_envelopes = [](const ChunkEntry& entry) { return entry.kind == ChunkKind::envelopes; };
    if (std::any_of(reader.entries_.begin() + static_cast<std::ptrdiff_t>(at), reader.entries_.end(),
                    is_envelopes))
        return in_file(damaged_bpo("its levels are not in order", Place::no_byte));
    return reader;
}

Result<std::vector<std::uint8_t>> BpoReader::bytes_of(const ChunkEntry& entry) {
    auto block = file_.read(entry.offset, entry.size);
    if (!block) return block.error();
    return copy_of(*block);
}

Result<const BpoReader::Envelopes*> BpoReader::envelopes(std::size_t entry) {
    if (const auto found = envelopes_.find(entry); found != envelopes_.end()) return &found->second;
    auto bytes = bytes_of(entries_[entry]);
    if (!bytes) return bytes.error();
    auto chunk = decode_envelope_chunk(entries_[entry], *bytes, head_.is_solid);
    if (!chunk) return chunk.error();
    Envelopes envelopes{std::move(*chunk), {}};
    std::uint32_t split = 0, gray = 0;
    for (const Node node : envelopes.chunk.nodes)
        envelopes.number.push_back(node == Node::split ? split++ : node == Node::gray ? gray++ : 0);
    return &envelopes_.emplace(entry, std::move(envelopes)).first->second;
}

/// The chunk of `level` with the octants of this parent.
Result<std::size_t> BpoReader::entry_of(std::size_t level, std::uint32_t parent) const {
    const auto begin = entries_.begin() + static_cast<std::ptrdiff_t>(level_begin_[level]),
               end = entries_.begin() + static_cast<std::ptrdiff_t>(level_begin_[level + 1]);
    const auto after = std::upper_bound(
        begin, end, parent, [](std::uint32_t value, const ChunkEntry& entry) { return value < entry.first; });
    if (after == begin || parent - (after - 1)->first >= (after - 1)->count)
        return damaged_bpo("a chunk is missing", Place::no_byte);
    return static_cast<std::size_t>(after - 1 - entries_.begin());
}

Result<BpoReader::Leaf> BpoReader::leaf_at(const std::array<std::int64_t, 3>& doubled) {
    std::array<std::int32_t, 3> place{};  // the cell of the deepest level
    const int deepest = static_cast<int>(levels_.size()) - 1;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const std::int64_t from_low = doubled[i] - head_.frame.low()[i];
        if (from_low < 0 || from_low >= head_.frame.side()[i]) return Leaf{};
        place[i] = static_cast<std::int32_t>(from_low / head_.frame.side(axis, deepest));
    }
    Leaf leaf;
    leaf.cell = Cell::root();
    std::size_t entry = 0, node = 0;
    for (int level = 0;; ++level) {
        const auto found = envelopes(entry);
        if (!found) return found.error();
        const Envelopes& here = **found;
        leaf.node = here.chunk.nodes[node];
        if (leaf.node != Node::split) {
            if (leaf.node == Node::gray) leaf.winding = here.chunk.windings[here.number[node]];
            return leaf;
        }
        if (level == deepest) return damaged_bpo("the deepest level is split", entries_[entry].offset);
        const std::uint32_t parent = entries_[entry].splits_before + here.number[node];
        const auto next = entry_of(static_cast<std::size_t>(level) + 1, parent);
        if (!next) return next.error();
        entry = *next;
        int octant = 0;
        for (int axis = 0; axis < 3; ++axis)
            octant |= (place[static_cast<std::size_t>(axis)] >> (deepest - level - 1) & 1) << axis;
        node = std::size_t{8} * (parent - entries_[entry].first) + static_cast<std::size_t>(octant);
        leaf.cell = leaf.cell.child(octant);
    }
}

Result<const DecodedGeometry*> BpoReader::triangles_near(const Cell& leaf) {
    const std::uint64_t key = leaf.key().bits();
    const auto begin = entries_.begin() + static_cast<std::ptrdiff_t>(level_begin_.back());
    const auto after = std::upper_bound(
        begin, entries_.end(), key,
        [](std::uint64_t value, const ChunkEntry& entry) { return value < entry.first_key; });
    if (after == begin) return damaged_bpo("the triangles of a leaf are missing", Place::no_byte);
    const auto entry = static_cast<std::size_t>(after - 1 - entries_.begin());
    if (entry != geometry_entry_) {
        auto bytes = bytes_of(entries_[entry]);
        if (!bytes) return bytes.error();
        auto chunk = decode_triangle_chunk(entries_[entry], *bytes);
        if (!chunk) return chunk.error();
        geometry_ = std::move(chunk->geometry);
        geometry_entry_ = entry;
    }
    return static_cast<const DecodedGeometry*>(&geometry_);
}

}  // namespace octavo::bp_octree
