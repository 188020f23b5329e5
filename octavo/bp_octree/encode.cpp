// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include <octavo/base/bytes.hpp>
#include <octavo/base/checksum.hpp>
#include <octavo/bp_octree/bit_stream.hpp>
#include <octavo/bp_octree/bpo_format.hpp>
#include <octavo/bp_octree/bpo_layout.hpp>
#include <octavo/bp_octree/geometry_codec.hpp>

namespace octavo::bp_octree {
namespace {

using octree::CellKey;
using octree::Node;

// 4096 nodes: 20 to 40 KB where all have planes, about what a network delivers in the time of a request.
constexpr std::uint32_t parents_a_chunk = 512;
// 15 to 20 KB. Smaller chunks repeat more triangles at their borders, larger ones make readers of one leaf
// wait: 12 000 instead save 5 % of the file, and the first answer takes twice as long.
constexpr std::size_t triangles_a_chunk = 4000;

/// The names of all nodes.
std::vector<CellKey> keys_of(const BpOctree& tree) {
    std::vector<CellKey> keys(tree.nodes.size());
    keys[0] = CellKey::root();
    for (NodeIndex node = 0; node < tree.nodes.size(); ++node)
        if (tree.nodes[node] == Node::split)
            for (unsigned i = 0; i < 8; ++i)
                keys[tree.link[node] + i] = keys[node].child(static_cast<int>(i));
    return keys;
}

class Encoder {
  public:
    explicit Encoder(const BpOctree& tree) : tree_(tree), keys_(keys_of(tree)) {}

    std::vector<std::uint8_t> run() {
        for (std::size_t level = 0; level < tree_.levels.size(); ++level) add_level(level);
        add_triangles();
        return file();
    }

  private:
    void add_chunk(ChunkEntry entry, std::vector<std::uint8_t> bytes) {
        entry.size = static_cast<std::uint32_t>(bytes.size());
        entry.checksum = crc32_of(bytes);
        entries_.push_back(entry);
        chunks_.push_back(std::move(bytes));
    }

    void add_level(std::size_t level) {
        const NodeIndex begin = tree_.level_begin[level], end = tree_.level_begin[level + 1];
        std::uint32_t splits = 0, grays = 0;
        std::vector<CellKey> parents;
        if (level > 0)
            for (NodeIndex node = begin; node < end; node += 8) parents.push_back(keys_[node].parent());
        for (NodeIndex first = begin; first < end; first += 8 * parents_a_chunk) {
            const NodeIndex last = std::min(end, first + 8 * parents_a_chunk);
            ChunkEntry entry;
            entry.level = static_cast<std::uint8_t>(level);
            entry.first = (first - begin) / 8;
            entry.count = (last - first) / 8;
            entry.splits_before = splits;
            entry.leaves_before = grays;
            entry.first_key = level == 0 ? CellKey::root().bits() : parents[entry.first].bits();
            BitWriter bits;
            for (NodeIndex node = first; node < last; ++node) {
                bits.put(static_cast<std::uint32_t>(tree_.nodes[node]), 2);
                splits += tree_.nodes[node] == Node::split;
                grays += tree_.nodes[node] == Node::gray;
            }
            for (NodeIndex node = first; node < last; ++node) put_envelope(node, bits);
            add_chunk(entry, std::move(bits).take());
        }
    }

    void put_envelope(NodeIndex node, BitWriter& bits) const {
        if (tree_.nodes[node] != Node::split && tree_.nodes[node] != Node::gray) return;
        const auto planes = tree_.planes_of(node);
        if (planes.size() < 15) {
            bits.put(static_cast<std::uint32_t>(planes.size()), 4);
        } else {
            bits.put(15, 4);
            bits.put(static_cast<std::uint32_t>(planes.size() - 15), 16);
        }
        for (const BoundingPlane& plane : planes) {
            bits.put(plane.direction, 16);
            bits.put(plane.offset, 12);
        }
        if (tree_.nodes[node] == Node::gray && tree_.is_solid)
            bits.put_rice(zigzag(tree_.leaf_winding[tree_.link[node]]), 1);
    }

    /// Leaves in Morton order, in groups; each group's triangles make a chunk.
    void add_triangles() {
        std::vector<NodeIndex> leaves;
        for (NodeIndex node = 0; node < tree_.nodes.size(); ++node)
            if (tree_.nodes[node] == Node::gray) leaves.push_back(node);
        std::sort(leaves.begin(), leaves.end(),
                  [&](NodeIndex a, NodeIndex b) { return keys_[a] < keys_[b]; });

        constexpr std::uint32_t unnumbered = 0xffffffff;
        number_.assign(tree_.mesh.triangles.size(), unnumbered);
        std::vector<std::uint32_t> group_of(tree_.mesh.triangles.size(), unnumbered);
        for (std::size_t first = 0, group = 0; first < leaves.size(); ++group) {
            std::vector<mesh::FaceIndex> members;
            std::size_t last = first;
            for (std::size_t fresh = 0; last < leaves.size() && fresh < triangles_a_chunk; ++last)
                for (const mesh::FaceIndex face : tree_.triangles_of(leaves[last])) {
                    if (group_of[face] == group) continue;
                    fresh += number_[face] == unnumbered;
                    group_of[face] = static_cast<std::uint32_t>(group);
                    members.push_back(face);
                }
            ChunkEntry entry;
            entry.kind = ChunkKind::triangles;
            entry.level = static_cast<std::uint8_t>(tree_.deepest());
            entry.splits_before = static_cast<std::uint32_t>(first);
            entry.leaves_before = static_cast<std::uint32_t>(last - first);
            entry.first_key = keys_[leaves[first]].bits();
            add_group(entry, members);
            first = last;
        }
    }

    void add_group(ChunkEntry entry, const std::vector<mesh::FaceIndex>& members) {
        std::vector<mesh::Triangle> triangles;
        for (const mesh::FaceIndex face : members) triangles.push_back(tree_.mesh.triangles[face]);
        const CodedGeometry coded = encode_geometry(tree_.mesh.points, triangles);
        entry.first = numbered_;
        const int bits_a_number = std::bit_width(numbered_);
        BitWriter flags;
        std::vector<std::uint32_t> repeated;
        for (const std::uint32_t i : coded.order) {
            std::uint32_t& number = number_[members[i]];
            const bool is_new = number == 0xffffffff;
            flags.put(is_new, 1);
            if (is_new)
                number = numbered_++;
            else
                repeated.push_back(number);
        }
        for (const std::uint32_t number : repeated) flags.put(number, bits_a_number);
        entry.count = numbered_ - entry.first;

        std::vector<std::uint8_t> bytes(8);
        octavo::store(bytes.data(), static_cast<std::uint32_t>(members.size()));
        octavo::store(bytes.data() + 4, static_cast<std::uint32_t>(coded.bytes.size()));
        bytes.insert(bytes.end(), coded.bytes.begin(), coded.bytes.end());
        const std::vector<std::uint8_t> tail = std::move(flags).take();
        bytes.insert(bytes.end(), tail.begin(), tail.end());
        add_chunk(entry, std::move(bytes));
    }

    std::vector<std::uint8_t> file() {
        BpoHead head;
        head.is_solid = tree_.is_solid;
        head.lattice = tree_.mesh.lattice;
        head.frame = tree_.frame;
        head.levels = static_cast<std::uint32_t>(tree_.levels.size());
        head.solid_volume = tree_.solid_volume;
        head.nodes = tree_.nodes.size();
        head.planes = tree_.planes.size();
        head.leaves = tree_.leaf_count();
        head.triangles = tree_.mesh.triangles.size();
        head.points = tree_.mesh.points.size();
        head.chunks = static_cast<std::uint32_t>(entries_.size());
        std::uint64_t at = head.chunks_at();
        for (ChunkEntry& entry : entries_) {
            entry.offset = at;
            at = entry.end();
        }
        head.file_size = at;
        std::vector<std::uint8_t> out;
        out.reserve(at);
        put_head(head, tree_.levels, out);
        put_index(entries_, out);
        for (const auto& chunk : chunks_) out.insert(out.end(), chunk.begin(), chunk.end());
        return out;
    }

    const BpOctree& tree_;
    std::vector<CellKey> keys_;
    std::vector<ChunkEntry> entries_;
    std::vector<std::vector<std::uint8_t>> chunks_;
    std::vector<std::uint32_t> number_;  ///< of each triangle, in the file
    std::uint32_t numbered_ = 0;
};

}  // namespace

std::vector<std::uint8_t> encode(const BpOctree& tree) {
    OCTAVO_CHECK(tree.leaf_triangles.size() >= tree.mesh.triangles.size(),
                 "only a tree with its triangles has a file");
    return Encoder(tree).run();
}

}  // namespace octavo::bp_octree
