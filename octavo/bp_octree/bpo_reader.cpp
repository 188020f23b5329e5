// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bp_octree/bpo_format.hpp>
#include <octavo/bp_octree/bpo_reader.hpp>

namespace octavo::bp_octree {
namespace {

using octree::Cell;
using octree::Node;

// Head, levels and the index of most files.
constexpr std::uint64_t first_request = 65536;
// A request costs more than so many bytes that nobody asked for.
constexpr std::uint64_t bridged_gap = 16384;

Error in_source(Error error, const io::ByteSource& source) {
    error.place.file = source.name();
    return error;
}

}  // namespace

Result<BpoReader> BpoReader::open(std::unique_ptr<io::ByteSource> source) {
    BpoReader reader(std::move(source));
    if (Status read = reader.read_head_and_index(); !read)
        return in_source(std::move(read).error(), *reader.source_);
    if (Status found = reader.find_levels(); !found)
        return in_source(std::move(found).error(), *reader.source_);
    return reader;
}

Result<BpoReader> BpoReader::open(const std::string& path) {
    auto source = io::open_file(path);
    if (!source) return source.error();
    return open(std::move(*source));
}

Status BpoReader::read_head_and_index() {
    auto beginning = read(0, std::min(source_->size(), first_request));
    if (!beginning) return beginning.error();
    auto head = get_head(beginning->octets());
    if (!head) return head.error();
    head_ = head->head;
    levels_ = std::move(head->levels);
    const std::uint64_t needed = std::min(head_.chunks_at(), source_->size());
    if (needed > first_request) {
        beginning = read(0, needed);
        if (!beginning) return beginning.error();
    }
    auto entries = get_index(head_, beginning->octets());
    if (!entries) return entries.error();
    entries_ = std::move(*entries);
    return Done{};
}

Status BpoReader::find_levels() {
    std::size_t at = 0;
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        level_begin_.push_back(at);
        while (at < entries_.size() && entries_[at].kind == ChunkKind::envelopes &&
               entries_[at].level == level)
            ++at;
        if (at == level_begin_.back()) return damaged_bpo("a level is missing", Place::no_byte);
    }
    level_begin_.push_back(at);
    const auto is_envelopes = [](const ChunkEntry& entry) { return entry.kind == ChunkKind::envelopes; };
    if (std::any_of(entries_.begin() + static_cast<std::ptrdiff_t>(at), entries_.end(), is_envelopes))
        return damaged_bpo("its levels are not in order", Place::no_byte);
    return Done{};
}

std::vector<std::uint64_t> BpoReader::bytes_to_level() const {
    std::vector<std::uint64_t> sizes;
    for (std::size_t level = 0; level < levels_.size(); ++level)
        sizes.push_back(entries_[level_begin_[level + 1] - 1].end());
    return sizes;
}

BpoArrived BpoReader::arrived() const {
    BpoArrived arrived;
    arrived.bytes = source_->size();
    for (const std::uint64_t end : bytes_to_level()) arrived.levels += end <= arrived.bytes;
    for (std::size_t i = level_begin_.back(); i < entries_.size(); ++i) {
        if (entries_[i].end() > arrived.bytes) break;
        arrived.triangles += entries_[i].count;
        arrived.leaves += entries_[i].leaves_before;
    }
    return arrived;
}

Result<io::ByteRange> BpoReader::read(std::uint64_t offset, std::uint64_t size) {
    bytes_read_ += size;
    return source_->read(offset, static_cast<std::size_t>(size));
}

Result<BpOctree> BpoReader::read_levels(int last) {
    const int complete = arrived().levels;
    if (complete == 0)
        return in_source(damaged_bpo("it ends before its first level", source_->size()), *source_);
    const int level = std::clamp(last, 0, complete - 1);
    const auto bytes = read(0, bytes_to_level()[static_cast<std::size_t>(level)]);
    if (!bytes) return bytes.error();
    auto tree = decode_beginning(bytes->octets(), {.levels = level});
    if (!tree) return in_source(std::move(tree).error(), *source_);
    return tree;
}

Result<BpOctree> BpoReader::read_all(const Context& context) {
    const auto bytes = read(0, source_->size());
    if (!bytes) return bytes.error();
    auto tree = decode(bytes->octets(), {}, context);
    if (!tree) return in_source(std::move(tree).error(), *source_);
    return tree;
}

/// Decodes a chunk and numbers its nodes.
Status BpoReader::keep(std::size_t entry, std::span<const std::uint8_t> bytes) {
    auto chunk = decode_envelope_chunk(entries_[entry], bytes, head_.is_solid);
    if (!chunk) return chunk.error();
    Envelopes envelopes{std::move(*chunk), {}, {}};
    std::uint32_t split = entries_[entry].splits_before, gray = 0;
    for (const Node node : envelopes.chunk.nodes) {
        envelopes.split.push_back(node == Node::split ? split++ : 0);
        envelopes.gray.push_back(node == Node::gray ? gray++ : 0);
    }
    envelopes_.emplace(entry, std::move(envelopes));
    return Done{};
}

/// Reads chunks of envelopes that are not in memory; `entries` ascend. Neighbours are read at once, as are those whose
/// distance costs less than another request.
Status BpoReader::load(std::span<const std::size_t> entries) {
    std::vector<std::size_t> missing;
    std::copy_if(entries.begin(), entries.end(), std::back_inserter(missing),
                 [&](std::size_t entry) { return envelopes_.count(entry) == 0; });
    for (std::size_t first = 0, last = 0; first < missing.size(); first = last) {
        for (last = first + 1; last < missing.size() && entries_[missing[last]].offset <=
                                                            entries_[missing[last - 1]].end() + bridged_gap;)
            ++last;
        const std::uint64_t offset = entries_[missing[first]].offset;
        const auto range = read(offset, entries_[missing[last - 1]].end() - offset);
        if (!range) return range.error();
        for (std::size_t i = first; i < last; ++i) {
            const ChunkEntry& entry = entries_[missing[i]];
            const Status kept = keep(missing[i], range->octets().subspan(entry.offset - offset, entry.size));
            if (!kept) return in_source(kept.error(), *source_);
        }
    }
    return Done{};
}

/// The chunk of `level` with the octants of this parent.
Result<std::size_t> BpoReader::entry_of(std::size_t level, std::uint32_t parent) const {
    if (level == 0) return std::size_t{0};
    const auto begin = entries_.begin() + static_cast<std::ptrdiff_t>(level_begin_[level]),
               end = entries_.begin() + static_cast<std::ptrdiff_t>(level_begin_[level + 1]);
    const auto after = std::upper_bound(
        begin, end, parent, [](std::uint32_t value, const ChunkEntry& entry) { return value < entry.first; });
    if (after == begin || parent - (after - 1)->first >= (after - 1)->count)
        return in_source(damaged_bpo("a chunk is missing", Place::no_byte), *source_);
    return static_cast<std::size_t>(after - 1 - entries_.begin());
}

Result<std::vector<BpoReader::Octants>> BpoReader::octants(std::size_t level,
                                                           std::span<const std::uint32_t> parents) {
    if (level >= levels_.size())
        return in_source(damaged_bpo("the deepest level is split", Place::no_byte), *source_);
    std::vector<std::size_t> entries, wanted;
    for (const std::uint32_t parent : parents) {
        const auto entry = entry_of(level, parent);
        if (!entry) return entry.error();
        entries.push_back(*entry);
        if (wanted.empty() || wanted.back() != *entry) wanted.push_back(*entry);
    }
    if (Status loaded = load(wanted); !loaded) return loaded.error();
    std::vector<Octants> octants;
    for (std::size_t i = 0; i < parents.size(); ++i) {
        const Envelopes& found = envelopes_.at(entries[i]);
        const std::size_t first = level == 0 ? 0 : std::size_t{8} * (parents[i] - entries_[entries[i]].first);
        octants.push_back({&found.chunk, first, found.split, found.gray});
    }
    return octants;
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
    std::uint32_t parent = 0;
    std::size_t octant = 0;
    for (int level = 0;; ++level) {
        const auto found = octants(static_cast<std::size_t>(level), {&parent, 1});
        if (!found) return found.error();
        const Octants& here = found->front();
        const std::size_t node = here.first + octant;
        leaf.node = here.chunk->nodes[node];
        if (leaf.node == Node::gray) leaf.winding = here.chunk->windings[here.gray[node]];
        if (leaf.node != Node::split) return leaf;
        parent = here.split[node];
        octant = 0;
        for (int axis = 0; level < deepest && axis < 3; ++axis)
            octant |=
                (static_cast<std::size_t>(place[static_cast<std::size_t>(axis)]) >> (deepest - level - 1) &
                 1U)
                << axis;
        leaf.cell = leaf.cell.child(static_cast<int>(octant));
    }
}

Result<const DecodedGeometry*> BpoReader::triangles_near(const Cell& leaf) {
    const std::uint64_t key = leaf.key().bits();
    const auto begin = entries_.begin() + static_cast<std::ptrdiff_t>(level_begin_.back());
    const auto after = std::upper_bound(
        begin, entries_.end(), key,
        [](std::uint64_t value, const ChunkEntry& entry) { return value < entry.first_key; });
    if (after == begin)
        return in_source(damaged_bpo("the triangles of a leaf are missing", Place::no_byte), *source_);
    const auto entry = static_cast<std::size_t>(after - 1 - entries_.begin());
    if (entry != geometry_entry_) {
        const auto bytes = read(entries_[entry].offset, entries_[entry].size);
        if (!bytes) return bytes.error();
        auto chunk = decode_triangle_chunk(entries_[entry], bytes->octets());
        if (!chunk) return in_source(std::move(chunk).error(), *source_);
        geometry_ = std::move(chunk->geometry);
        geometry_entry_ = entry;
    }
    return static_cast<const DecodedGeometry*>(&geometry_);
}

}  // namespace octavo::bp_octree
