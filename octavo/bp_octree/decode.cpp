// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>
#include <string>

#include <octavo/base/parallel.hpp>
#include <octavo/bp_octree/bpo_chunks.hpp>
#include <octavo/bp_octree/bpo_format.hpp>
#include <octavo/bp_octree/bpo_layout.hpp>
#include <octavo/bp_octree/leaf_lists.hpp>
#include <octavo/mesh/weld.hpp>

namespace octavo::bp_octree {
namespace {

using octree::Node;

constexpr auto damaged = damaged_bpo;

Result<std::span<const std::uint8_t>> chunk_bytes(const ChunkEntry& entry,
                                                  std::span<const std::uint8_t> file) {
    if (entry.offset > file.size() || entry.size > file.size() - entry.offset)
        return damaged("it ends within a chunk", file.size());
    return file.subspan(entry.offset, entry.size);
}

/// Rebuilds nodes and planes from the envelope chunks, level by level.
class TreeDecoder {
  public:
    TreeDecoder(BpOctree& tree, const std::vector<LevelFigures>& levels, int last_level)
        : tree_(tree), levels_(levels), last_level_(last_level) {
        tree_.level_begin = {0};
        tree_.plane_begin = {0};
        tree_.leaf_begin = {0};
    }

    Status add(const ChunkEntry& entry, std::span<const std::uint8_t> file) {
        auto bytes = chunk_bytes(entry, file);
        if (!bytes) return bytes.error();
        if (entry.level != level_ && !(parents_done_ == parents() && entry.level == level_ + 1))
            return damaged("a level is not complete", entry.offset);
        if (entry.level != level_) finish_level();
        if (level_ == 0 && !tree_.nodes.empty()) return damaged("it has two roots", entry.offset);
        if (entry.first != parents_done_ || entry.count > parents() - parents_done_)
            return damaged("a chunk does not follow the one before it", entry.offset);
        auto chunk = decode_envelope_chunk(entry, *bytes, tree_.is_solid);
        if (!chunk) return chunk.error();
        parents_done_ += entry.count;
        append(*chunk);
        return Done{};
    }

    /// After the last chunk; everything must be there.
    Status finish() {
        if (parents_done_ != parents() || level_ != static_cast<std::size_t>(last_level_))
            return damaged("a level is not complete", Place::no_byte);
        finish_level();
        if (!sound_) return damaged("the figures of its levels are wrong", Place::no_byte);
        return Done{};
    }

  private:
    /// How many parents the chunks of the present level are about; the root has none.
    std::uint64_t parents() const { return level_ == 0 ? 0 : levels_[level_ - 1].split; }

    void append(const EnvelopeChunk& chunk) {
        const auto planes_before = static_cast<std::uint32_t>(tree_.planes.size());
        const bool is_last = static_cast<int>(level_) == last_level_;
        std::size_t gray = 0;
        for (std::size_t i = 0; i < chunk.nodes.size(); ++i) {
            const Node kind = chunk.nodes[i];
            ++(kind == Node::split   ? seen_.split
               : kind == Node::gray  ? seen_.gray
               : kind == Node::white ? seen_.white
                                     : seen_.black);
            const std::int32_t winding = kind == Node::gray ? chunk.windings[gray++] : 0;
            tree_.nodes.push_back(kind == Node::split && is_last ? Node::gray : kind);
            tree_.link.push_back(0);
            if (tree_.nodes.back() == Node::split) {
                tree_.link.back() = static_cast<std::uint32_t>(1 + 8 * splits_++);
            } else if (tree_.nodes.back() == Node::gray) {
                tree_.link.back() = static_cast<std::uint32_t>(tree_.leaf_count());
                tree_.leaf_begin.push_back(0);
                tree_.leaf_winding.push_back(winding);
            }
            tree_.plane_begin.push_back(planes_before + chunk.plane_begin[i + 1]);
        }
        tree_.planes.insert(tree_.planes.end(), chunk.planes.begin(), chunk.planes.end());
        seen_.planes += chunk.planes.size();
    }

    void finish_level() {
        seen_.volume = levels_[level_].volume;
        if (!(seen_ == levels_[level_])) sound_ = false;
        tree_.levels.push_back(seen_);
        tree_.level_begin.push_back(static_cast<NodeIndex>(tree_.nodes.size()));
        seen_ = {};
        parents_done_ = 0;
        ++level_;
    }

    BpOctree& tree_;
    const std::vector<LevelFigures>& levels_;
    int last_level_;
    std::size_t level_ = 0;
    std::uint64_t parents_done_ = 0, splits_ = 0;
    LevelFigures seen_;
    bool sound_ = true;
};

/// The triangles that are new in a chunk, and its points.
Result<DecodedGeometry> decode_triangles(const ChunkEntry& entry, std::span<const std::uint8_t> file) {
    auto bytes = chunk_bytes(entry, file);
    if (!bytes) return bytes.error();
    auto chunk = decode_triangle_chunk(entry, *bytes);
    if (!chunk) return chunk.error();
    std::vector<mesh::Triangle> fresh;
    for (std::size_t i = 0; i < chunk->is_new.size(); ++i)
        if (chunk->is_new[i]) fresh.push_back(chunk->geometry.triangles[i]);
    chunk->geometry.triangles = std::move(fresh);
    return std::move(chunk->geometry);
}

Status add_mesh(BpOctree& tree, const BpoHead& head, std::span<const ChunkEntry> entries,
                std::span<const std::uint8_t> bytes, const Context& context) {
    std::uint64_t expected = 0;
    for (const ChunkEntry& entry : entries) {
        if (entry.kind != ChunkKind::triangles || entry.first != expected)
            return damaged("a chunk of triangles does not follow the one before it", entry.offset);
        expected += entry.count;
    }
    if (expected != head.triangles) return damaged("triangles are missing", 112);
    std::vector<std::optional<Result<DecodedGeometry>>> parts(entries.size());
    parallel_chunks(context, entries.size(), 1, [&](std::size_t i, std::size_t) {
        parts[i].emplace(decode_triangles(entries[i], bytes));
    });
    if (context.cancelled()) return Context::cancelled_error();
    mesh::LatticeMesh all;
    all.lattice = head.lattice;
    for (auto& part : parts) {
        if (!part->has_value()) return part->error();
        DecodedGeometry& geometry = part->value();
        const auto base = static_cast<mesh::VertexIndex>(all.points.size());
        for (const mesh::Triangle& t : geometry.triangles)
            all.triangles.push_back({base + t[0], base + t[1], base + t[2]});
        all.points.insert(all.points.end(), geometry.points.begin(), geometry.points.end());
        part.reset();
    }
    tree.mesh = mesh::weld(all);
    if (tree.mesh.points.size() != head.points) return damaged("the number of its points is wrong", 120);
    return fill_leaf_lists(tree, context);
}

struct Opened {
    HeadAndLevels head;
    std::vector<ChunkEntry> entries;
    std::size_t envelope_chunks = 0;
};

Result<Opened> open(std::span<const std::uint8_t> bytes) {
    auto head = get_head(bytes);
    if (!head) return head.error();
    auto entries = get_index(head->head, bytes);
    if (!entries) return entries.error();
    Opened opened{std::move(*head), std::move(*entries), 0};
    while (opened.envelope_chunks < opened.entries.size() &&
           opened.entries[opened.envelope_chunks].kind == ChunkKind::envelopes)
        ++opened.envelope_chunks;
    return opened;
}

Result<BpOctree> decode_levels(const Opened& opened, std::span<const std::uint8_t> bytes, int last_level) {
    BpOctree tree;
    tree.mesh.lattice = opened.head.head.lattice;
    tree.frame = opened.head.head.frame;
    tree.is_solid = opened.head.head.is_solid;
    tree.solid_volume = opened.head.head.solid_volume;
    TreeDecoder decoder(tree, opened.head.levels, last_level);
    for (std::size_t i = 0; i < opened.envelope_chunks; ++i) {
        if (opened.entries[i].level > last_level) break;
        if (Status added = decoder.add(opened.entries[i], bytes); !added) return added.error();
    }
    if (Status finished = decoder.finish(); !finished) return finished.error();
    return tree;
}

}  // namespace

Result<BpOctree> decode(std::span<const std::uint8_t> bytes, const DecodeOptions& options,
                        const Context& context) {
    auto opened = open(bytes);
    if (!opened) return opened.error();
    if (bytes.size() != opened->head.head.file_size)
        return damaged(
            bytes.size() < opened->head.head.file_size ? "it ends early" : "it goes on after its end",
            std::min<std::uint64_t>(bytes.size(), opened->head.head.file_size));
    const int deepest = static_cast<int>(opened->head.levels.size()) - 1;
    auto tree = decode_levels(*opened, bytes, std::clamp(options.levels, 0, deepest));
    if (!tree || options.levels < deepest) return tree;
    const std::span triangles = std::span(opened->entries).subspan(opened->envelope_chunks);
    if (Status added = add_mesh(*tree, opened->head.head, triangles, bytes, context); !added)
        return added.error();
    return tree;
}

Result<BpOctree> decode_beginning(std::span<const std::uint8_t> bytes, const DecodeOptions& options) {
    auto opened = open(bytes);
    if (!opened) return opened.error();
    int complete = static_cast<int>(opened->head.levels.size()) - 1;
    for (std::size_t i = 0; i < opened->envelope_chunks; ++i) {
        const ChunkEntry& entry = opened->entries[i];
        if (entry.offset + entry.size > bytes.size()) {
            complete = entry.level - 1;
            break;
        }
    }
    if (complete < 0) return damaged("it ends before its first level", bytes.size());
    return decode_levels(*opened, bytes, std::clamp(options.levels, 0, complete));
}

bool looks_like_bpo(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= bpo_magic.size() && std::equal(bpo_magic.begin(), bpo_magic.end(), bytes.begin());
}

Result<std::vector<std::uint64_t>> bytes_to_level(std::span<const std::uint8_t> bytes) {
    auto opened = open(bytes);
    if (!opened) return opened.error();
    std::vector<std::uint64_t> sizes(opened->head.levels.size(), 0);
    for (std::size_t i = 0; i < opened->envelope_chunks; ++i) {
        const ChunkEntry& entry = opened->entries[i];
        sizes[entry.level] = std::max(sizes[entry.level], entry.offset + entry.size);
    }
    return sizes;
}

Result<std::uint64_t> size_in_head(std::span<const std::uint8_t> bytes) {
    auto head = get_head(bytes);
    if (!head) return head.error();
    return head->head.file_size;
}

}  // namespace octavo::bp_octree
