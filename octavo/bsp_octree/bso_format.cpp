// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <string>

#include <octavo/base/bytes.hpp>
#include <octavo/base/checksum.hpp>
#include <octavo/bp_octree/bit_stream.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/mesh/weld.hpp>

namespace octavo::bsp_octree {
namespace {

using bp_octree::BitReader;
using bp_octree::BitWriter;

constexpr std::array<std::uint8_t, 8> magic{0x89, 'B', 'S', 'O', '\r', '\n', 0x1A, '\n'};
constexpr std::uint32_t version = 1;

// Byte offsets of the header's fields; all integers are little-endian.
constexpr std::size_t version_at = 8, exponent_at = 12, checksum_at = 16, depth_at = 20, origin_at = 24,
                      points_at = 48, planes_at = 52, leaf_planes_at = 56, stop_at = 60, header_bytes = 64;

// Nodes of the octree, two bits each.
constexpr std::uint32_t white = 0, black = 1, split = 2, bsp_leaf = 3;

/// References to a table in the order of first use, in Elias' gamma code: 0 is the next new entry, n the entry that was
/// first used n entries ago.
class References {
  public:
    std::uint32_t used() const { return used_; }

    void put(BitWriter& bits, std::uint32_t entry) {
        const std::uint32_t number = used_ - entry + 1;
        const int width = std::bit_width(number);
        bits.put(0, width - 1);
        bits.put(1, 1);
        bits.put(number & ((1U << (width - 1)) - 1), width - 1);
        if (entry == used_) ++used_;
    }
    /// An entry up to the next new one; `limit` when it is none.
    std::uint32_t get(BitReader& bits, std::uint32_t limit) {
        int width = 1;
        while (width < 32 && !bits.overrun() && bits.get(1) == 0) ++width;
        if (width == 32 || bits.overrun()) return limit;
        const std::uint32_t back = (1U << (width - 1) | bits.get(width - 1)) - 1;
        if (back > used_ || used_ - back >= limit) return limit;
        if (back == 0) return used_++;
        return used_ - back;
    }

  private:
    std::uint32_t used_ = 0;
};

class Encoder {
  public:
    explicit Encoder(const BspOctree& octree)
        : store_(octree.store()), number_(store_.planes.size(), unknown) {
        write(octree.root());
    }

    std::vector<std::uint8_t> finish(const BspOctree& octree) {
        std::vector<exact::Point> corners;
        for (const bsp::PlaneId plane : order_)
            corners.insert(corners.end(), store_.planes.points(plane).begin(),
                           store_.planes.points(plane).end());
        const mesh::WeldMap weld = mesh::equal_vertices(corners);  // numbers in the order of first use
        BitWriter tables;
        for (const mesh::VertexIndex kept : weld.kept)
            for (int axis = 0; axis < 3; ++axis)
                tables.put(static_cast<std::uint32_t>(corners[kept][axis]), exact::coordinate_bits);
        References points;
        for (const mesh::VertexIndex point : weld.index) points.put(tables, point);
        std::vector<std::uint8_t> bytes(header_bytes, 0);
        std::copy(magic.begin(), magic.end(), bytes.begin());
        octavo::store(&bytes[version_at], version);
        octavo::store(&bytes[exponent_at], static_cast<std::int32_t>(octree.lattice().exponent()));
        octavo::store(&bytes[depth_at], static_cast<std::uint32_t>(octree.options().depth));
        for (std::size_t axis = 0; axis < 3; ++axis)
            octavo::store(&bytes[origin_at + 8 * axis], octree.lattice().origin()[axis]);
        octavo::store(&bytes[points_at], static_cast<std::uint32_t>(weld.kept.size()));
        octavo::store(&bytes[planes_at], static_cast<std::uint32_t>(order_.size()));
        octavo::store(&bytes[leaf_planes_at], octree.options().planes);
        octavo::store(&bytes[stop_at], static_cast<std::uint32_t>(octree.options().stop));
        for (const std::vector<std::uint8_t>& part : {std::move(tables).take(), std::move(bits_).take()})
            bytes.insert(bytes.end(), part.begin(), part.end());
        octavo::store(&bytes[checksum_at], crc32_around(bytes, checksum_at));
        return bytes;
    }

  private:
    static constexpr std::uint32_t unknown = ~std::uint32_t{0};

    void write(NodeRef node) {
        if (node.is_uniform()) return bits_.put(node.is_black() ? black : white, 2);
        if (node.is_gray()) {
            bits_.put(split, 2);
            for (const NodeRef octant : store_.octants(node)) write(octant);
            return;
        }
        bits_.put(bsp_leaf, 2);
        const bsp::Tree tree = store_.tree(node);
        pending_.assign(1, bsp::Tree::root);
        while (!pending_.empty()) {
            const bsp::Child child = pending_.back();
            pending_.pop_back();
            bits_.put(child.is_leaf() ? 0 : 1, 1);
            if (child.is_leaf()) {
                bits_.put(tree.label(child) == bsp::Label::in ? 1 : 0, 1);
                continue;
            }
            const bsp::Node& at = tree.nodes[child.index()];
            std::uint32_t& number = number_[at.plane];
            if (number == unknown) {
                number = static_cast<std::uint32_t>(order_.size());
                order_.push_back(at.plane);
            }
            planes_.put(bits_, number);
            pending_.push_back(at.back);
            pending_.push_back(at.front);
        }
    }

    const Store& store_;
    std::vector<std::uint32_t> number_;  ///< of a plane in the file
    std::vector<bsp::PlaneId> order_;
    References planes_;
    BitWriter bits_;
    std::vector<bsp::Child> pending_;
};

Error refuse(std::string sentence, std::size_t byte) {
    Error error{ErrorCode::bad_input, std::move(sentence), {}};
    error.place.byte = byte;
    return error;
}

class Decoder {
  public:
    Decoder(Store& store, std::span<const std::uint8_t> bytes, std::uint32_t points, std::uint32_t planes)
        : store_(store), bytes_(bytes), points_(points), planes_(planes) {}

    /// The root, or what is wrong.
    Result<NodeRef> read() {
        BitReader tables(bytes_);
        if (const char* trouble = read_tables(tables)) return refuse(trouble, header_bytes);
        const std::size_t used = (8 * bytes_.size() - tables.bits_left() + 7) / 8;
        bits_ = BitReader(bytes_.subspan(used));
        const NodeRef root = read_node(0);
        if (bits_.overrun()) trouble_ = "the .bso file ends inside its tree";
        if (!trouble_ && references_.used() != planes_)
            trouble_ = "the .bso file has planes that no tree uses";
        if (!trouble_ && !bits_.finished()) trouble_ = "the .bso file goes on after its tree";
        if (trouble_) return refuse(trouble_, header_bytes + used);
        return root;
    }

  private:
    const char* read_tables(BitReader& bits) {
        constexpr std::uint64_t point_bits = 3 * exact::coordinate_bits, least_plane_bits = 3;
        if (point_bits * points_ + least_plane_bits * planes_ > bits.bits_left())
            return "the .bso file is too short for the points and planes that it claims";
        std::vector<exact::Point> points(points_);
        for (exact::Point& point : points) {
            point.x = static_cast<std::int32_t>(bits.get(exact::coordinate_bits));
            point.y = static_cast<std::int32_t>(bits.get(exact::coordinate_bits));
            point.z = static_cast<std::int32_t>(bits.get(exact::coordinate_bits));
        }
        References references;
        for (std::uint32_t plane = 0; plane < planes_; ++plane) {
            exact::Point corner[3];
            for (exact::Point& point : corner) {
                const std::uint32_t index = references.get(bits, points_);
                if (index == points_) return "a plane of the .bso file names a point that is not there";
                point = points[index];
            }
            if (exact::collinear(corner[0], corner[1], corner[2]))
                return "the points of a plane of the .bso file lie on one line";
            const bsp::Facing facing = store_.planes.add(corner[0], corner[1], corner[2]);
            if (facing.plane() != plane || facing.reversed())
                return "a plane of the .bso file comes twice or is turned over";
        }
        return references.used() == points_ ? nullptr : "the .bso file has points that no plane uses";
    }

    NodeRef read_node(int level) {
        switch (trouble_ || bits_.overrun() ? white : bits_.get(2)) {
            case white:
                return NodeRef::white();
            case black:
                return NodeRef::black();
            case bsp_leaf:
                return read_leaf();
            default:
                break;
        }
        if (level == exact::coordinate_bits) {
            trouble_ = "a cell of the last level is split";
            return NodeRef::white();
        }
        Octants octants;
        for (NodeRef& octant : octants) octant = read_node(level + 1);
        return store_.add_gray(octants);
    }

    NodeRef read_leaf() {
        /// A child to read: of which node, and the planes above it.
        struct Pending {
            std::int32_t parent;
            bool is_front;
            std::uint32_t depth;
        };
        const std::size_t begin = store_.nodes.size();
        std::vector<Pending> pending{{-1, false, 0}};
        path_.clear();
        while (!pending.empty() && !trouble_ && !bits_.overrun()) {
            const Pending at = pending.back();
            pending.pop_back();
            path_.resize(at.depth);
            bsp::Child child = bsp::Child::leaf(bsp::Label::out);
            if (bits_.get(1) == 0) {
                child = bsp::Child::leaf(bits_.get(1) ? bsp::Label::in : bsp::Label::out);
                if (at.parent < 0) trouble_ = "a BSP tree of the .bso file has no node";
            } else {
                const std::uint32_t plane = references_.get(bits_, planes_);
                if (plane == planes_) {
                    trouble_ = "a BSP node of the .bso file names a plane that is not there";
                    break;
                }
                if (std::find(path_.begin(), path_.end(), plane) != path_.end())
                    trouble_ = "a plane comes twice on a path of a BSP tree of the .bso file";
                path_.push_back(plane);
                child = bsp::Child::node(store_.nodes.size() - begin);
                store_.nodes.push_back({plane, {}, {}});
                const auto depth = static_cast<std::uint32_t>(path_.size());
                pending.push_back({child.value, false, depth});
                pending.push_back({child.value, true, depth});
            }
            if (at.parent < 0) continue;
            bsp::Node& parent = store_.nodes[begin + static_cast<std::size_t>(at.parent)];
            (at.is_front ? parent.front : parent.back) = child;
        }
        return trouble_ || bits_.overrun() ? NodeRef::white() : store_.add_leaf(begin);
    }

    Store& store_;
    std::span<const std::uint8_t> bytes_;
    std::uint32_t points_, planes_;
    BitReader bits_{{}};  ///< of the tree
    References references_;
    std::vector<std::uint32_t> path_;  ///< planes above the node at hand
    const char* trouble_ = nullptr;
};

}  // namespace

bool looks_like_bso(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= magic.size() && std::equal(magic.begin(), magic.end(), bytes.begin());
}

std::vector<std::uint8_t> encode(const BspOctree& octree) { return Encoder(octree).finish(octree); }

Result<BspOctree> decode(std::span<const std::uint8_t> bytes) {
    if (!looks_like_bso(bytes)) return refuse("this is no .bso file: it does not begin like one", 0);
    if (bytes.size() < header_bytes)
        return refuse("the .bso file ends inside its header of 64 bytes", bytes.size());
    if (const auto found = load<std::uint32_t>(&bytes[version_at]); found != version) {
        Error error =
            refuse("the .bso file has version " + std::to_string(found) + "; this program knows version 1",
                   version_at);
        error.code = ErrorCode::unsupported;
        return error;
    }
    if (load<std::uint32_t>(&bytes[checksum_at]) != crc32_around(bytes, checksum_at))
        return refuse("the .bso file is damaged: its checksum does not agree", checksum_at);
    const auto depth = load<std::uint32_t>(&bytes[depth_at]),
               leaf_planes = load<std::uint32_t>(&bytes[leaf_planes_at]),
               stop = load<std::uint32_t>(&bytes[stop_at]);
    if (depth > exact::coordinate_bits)
        return refuse("the depth of the .bso file is not in 0 to 26", depth_at);
    if (stop > 1) return refuse("the .bso file has a stop rule that is not known", stop_at);
    std::array<std::int64_t, 3> origin;
    for (std::size_t axis = 0; axis < 3; ++axis)
        origin[axis] = load<std::int64_t>(&bytes[origin_at + 8 * axis]);
    const Result<exact::Lattice> lattice =
        exact::Lattice::from_parts(load<std::int32_t>(&bytes[exponent_at]), origin);
    if (!lattice) return refuse(lattice.error().sentence, exponent_at);

    auto store = std::make_shared<Store>();
    const Result<NodeRef> root =
        Decoder(*store, bytes.subspan(header_bytes), load<std::uint32_t>(&bytes[points_at]),
                load<std::uint32_t>(&bytes[planes_at]))
            .read();
    if (!root) return root.error();
    Options options;
    options.depth = static_cast<int>(depth);
    options.planes = leaf_planes;
    options.stop = static_cast<StopRule>(stop);
    return BspOctree(*lattice, options, std::move(store), *root);
}

}  // namespace octavo::bsp_octree
