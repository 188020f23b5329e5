// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include <octavo/base/bytes.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/bsp_octree/bso_layout.hpp>
#include <octavo/exact/orient.hpp>

namespace octavo::bsp_octree {
namespace {

Error refuse(std::string sentence, std::size_t byte) {
    Error error{ErrorCode::bad_input, std::move(sentence), {}};
    error.place.byte = byte;
    return error;
}

struct Header {
    exact::Lattice lattice;
    Options options;
};

Result<Header> read_header(BlockReader& reader) {
    const std::span<const std::uint8_t> bytes = reader.header(bso::header_bytes);
    if (reader.failed()) return reader.error();
    if (!looks_like_bso(bytes)) return refuse("this is no .bso file: it does not begin like one", 0);
    if (bytes.size() >= bso::exponent_at)
        if (const auto found = load<std::uint32_t>(&bytes[bso::version_at]); found != bso::version) {
            Error error = refuse("the .bso file has version " + std::to_string(found) +
                                     "; this program knows version " + std::to_string(bso::version),
                                 bso::version_at);
            error.code = ErrorCode::unsupported;
            return error;
        }
    if (bytes.size() < bso::header_bytes)
        return refuse("the .bso file ends inside its header of 56 bytes", bytes.size());
    reader.check_header();
    if (reader.failed()) return reader.error();

    const auto depth = load<std::uint32_t>(&bytes[bso::depth_at]),
               planes = load<std::uint32_t>(&bytes[bso::leaf_planes_at]),
               stop = load<std::uint32_t>(&bytes[bso::stop_at]);
    if (depth > exact::coordinate_bits)
        return refuse("the depth of the .bso file is not in 0 to 26", bso::depth_at);
    if (planes < 1 || planes > Options::most_planes)
        return refuse("the most planes of a leaf are not in 1 to 1000 in the .bso file", bso::leaf_planes_at);
    if (stop > 1) return refuse("the .bso file has a stop rule that is not known", bso::stop_at);
    std::array<std::int64_t, 3> origin;
    for (std::size_t axis = 0; axis < 3; ++axis)
        origin[axis] = load<std::int64_t>(&bytes[bso::origin_at + 8 * axis]);
    Result<exact::Lattice> lattice =
        exact::Lattice::from_parts(load<std::int32_t>(&bytes[bso::exponent_at]), origin);
    if (!lattice) return refuse(lattice.error().sentence, bso::exponent_at);
    Header header{*lattice, {}};
    header.options.depth = static_cast<int>(depth);
    header.options.planes = planes;
    header.options.stop = static_cast<StopRule>(stop);
    return header;
}

/// Reads the tree; where the reader has failed, it reads white and is soon through.
class Decoder {
  public:
    Decoder(Store& store, BlockReader& bits) : store_(store), bits_(bits) {}

    NodeRef read_node(int level) {
        switch (bits_.failed() ? bso::white : bits_.get(2)) {
            case bso::white:
                return NodeRef::white();
            case bso::black:
                return NodeRef::black();
            case bso::bsp_leaf:
                return read_leaf();
            default:
                break;
        }
        if (level == exact::coordinate_bits) {
            bits_.fail("a cell of the last level is split");
            return NodeRef::white();
        }
        Octants octants;
        for (NodeRef& octant : octants) octant = read_node(level + 1);
        if (store_.grays.size() == NodeRef::most) fail_for_size();
        return bits_.failed() ? NodeRef::white() : store_.add_gray(octants);
    }

  private:
    NodeRef read_leaf() {
        /// A child to read: of which node, and how many planes are above it.
        struct Pending {
            std::int32_t parent;
            bool is_front;
            std::uint32_t depth;
        };
        const std::size_t begin = store_.nodes.size();
        bool has_in = false, has_out = false;
        std::vector<Pending> pending{{-1, false, 0}};
        while (!pending.empty() && !bits_.failed()) {
            const Pending at = pending.back();
            pending.pop_back();
            bsp::Child child = bsp::Child::leaf(bsp::Label::out);
            if (bits_.get(1) == 0) {
                const bool is_in = bits_.get(1) != 0;
                (is_in ? has_in : has_out) = true;
                child = bsp::Child::leaf(is_in ? bsp::Label::in : bsp::Label::out);
                if (at.parent < 0) bits_.fail("a BSP tree of the .bso file has no node");
            } else {
                path_.resize(at.depth);
                path_.push_back(read_plane());
                child = bsp::Child::node(store_.nodes.size() - begin);
                store_.nodes.push_back({path_.back(), {}, {}});
                pending.push_back({child.value, false, at.depth + 1});
                pending.push_back({child.value, true, at.depth + 1});
            }
            if (at.parent < 0) continue;
            bsp::Node& parent = store_.nodes[begin + static_cast<std::size_t>(at.parent)];
            (at.is_front ? parent.front : parent.back) = child;
        }
        if (!has_in || !has_out) bits_.fail("a BSP tree of the .bso file is inside or outside all over");
        if (store_.leaves.size() == NodeRef::most || store_.nodes.size() >= most_nodes) fail_for_size();
        return bits_.failed() ? NodeRef::white() : store_.add_leaf(begin);
    }

    /// A plane that is not on the path yet.
    bsp::PlaneId read_plane() {
        const std::uint32_t known = planes_.used(), plane = planes_.get(bits_);
        if (plane == bso::References::none || plane == bsp::PlaneTable::most) {
            bits_.fail("a BSP node of the .bso file names a plane that is not there");
            return 0;
        }
        if (plane == known) {
            read_new_plane(plane);
            place_on_path_.resize(planes_.used());
        }
        std::uint32_t& place = place_on_path_[plane];
        if (place < path_.size() && path_[place] == plane)
            bits_.fail("a plane comes twice on a path of a BSP tree of the .bso file");
        place = static_cast<std::uint32_t>(path_.size());
        return plane;
    }

    void read_new_plane(bsp::PlaneId plane) {
        exact::Point corners[3];
        for (exact::Point& corner : corners) {
            const std::uint32_t known = references_.used(), point = references_.get(bits_);
            if (point == bso::References::none)
                return bits_.fail("a plane of the .bso file names a point that is not there");
            if (point == known) points_.push_back(read_point());
            corner = points_[point];
        }
        if (bits_.failed()) return;
        if (exact::collinear(corners[0], corners[1], corners[2]))
            return bits_.fail("the points of a plane of the .bso file lie on one line");
        const bsp::Facing facing = store_.planes.add(corners[0], corners[1], corners[2]);
        if (facing.plane() != plane || facing.reversed())
            bits_.fail("a plane of the .bso file comes twice or is turned over");
    }

    exact::Point read_point() {
        const auto coordinate = [&] { return static_cast<std::int32_t>(bits_.get(exact::coordinate_bits)); };
        const std::int32_t x = coordinate(), y = coordinate(), z = coordinate();
        return {x, y, z};
    }

    void fail_for_size() {
        bits_.fail({ErrorCode::limit, "the .bso file has more nodes than this program can hold", {}});
    }

    static constexpr std::size_t most_nodes = ~std::uint32_t{0};
    Store& store_;
    BlockReader& bits_;
    bso::References planes_, references_;
    std::vector<exact::Point> points_;
    std::vector<bsp::PlaneId> path_;            ///< planes above the node at hand
    std::vector<std::uint32_t> place_on_path_;  ///< of each plane, when it was there last
};

}  // namespace

bool looks_like_bso(std::span<const std::uint8_t> bytes) {
    return bytes.size() >= bso::magic.size() &&
           std::equal(bso::magic.begin(), bso::magic.end(), bytes.begin());
}

Result<BspOctree> decode(const ByteSource& source, const Context& context) {
    BlockReader bits(source, context);
    Result<Header> header = read_header(bits);
    if (!header) return header.error();
    auto store = std::make_shared<Store>();
    const NodeRef root = Decoder(*store, bits).read_node(0);
    bits.finish();
    if (bits.failed()) return bits.error();
    return BspOctree(header->lattice, header->options, std::move(store), root);
}

Result<BspOctree> decode(std::span<const std::uint8_t> bytes) {
    return decode([&](std::span<std::uint8_t> room) -> Result<std::size_t> {
        const std::size_t given = std::min(room.size(), bytes.size());
        std::copy_n(bytes.begin(), given, room.begin());
        bytes = bytes.subspan(given);
        return given;
    });
}

}  // namespace octavo::bsp_octree
