// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/base/bytes.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/bsp_octree/bso_layout.hpp>
#include <octavo/mesh/weld.hpp>

namespace octavo::bsp_octree {
namespace {

using Header = std::array<std::uint8_t, bso::checksum_at>;

Header header_of(const BspOctree& octree) {
    Header bytes{};
    std::copy(bso::magic.begin(), bso::magic.end(), bytes.begin());
    octavo::store(&bytes[bso::version_at], bso::version);
    octavo::store(&bytes[bso::exponent_at], static_cast<std::int32_t>(octree.lattice().exponent()));
    for (std::size_t axis = 0; axis < 3; ++axis)
        octavo::store(&bytes[bso::origin_at + 8 * axis], octree.lattice().origin()[axis]);
    octavo::store(&bytes[bso::depth_at], static_cast<std::uint32_t>(octree.options().depth));
    octavo::store(&bytes[bso::leaf_planes_at], octree.options().planes);
    octavo::store(&bytes[bso::stop_at], static_cast<std::uint32_t>(octree.options().stop));
    return bytes;
}

class Encoder {
  public:
    Encoder(const BspOctree& octree, ByteSink sink)
        : store_(octree.store()),
          bits_(std::move(sink), header_of(octree)),
          plane_number_(store_.planes.size(), unknown) {
        std::vector<exact::Point> corners;
        corners.reserve(3 * store_.planes.size());
        for (bsp::PlaneId plane = 0; plane < store_.planes.size(); ++plane)
            corners.insert(corners.end(), store_.planes.points(plane).begin(),
                           store_.planes.points(plane).end());
        mesh::WeldMap weld = mesh::equal_vertices(corners);
        point_ = std::move(weld.index);
        point_number_.assign(weld.kept.size(), unknown);
        write(octree.root());
        bits_.finish();
    }

  private:
    static constexpr std::uint32_t unknown = ~std::uint32_t{0};

    void write(NodeRef node) {
        if (node.is_uniform()) return bits_.put(node.is_black() ? bso::black : bso::white, 2);
        if (node.is_gray()) {
            bits_.put(bso::split, 2);
            for (const NodeRef octant : store_.octants(node)) write(octant);
            return;
        }
        bits_.put(bso::bsp_leaf, 2);
        write(store_.tree(node));
    }

    void write(const bsp::Tree& tree) {
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
            write_plane(at.plane);
            pending_.push_back(at.back);
            pending_.push_back(at.front);
        }
    }

    void write_plane(bsp::PlaneId plane) {
        if (!planes_.put(bits_, number(plane_number_[plane], planes_))) return;
        for (std::size_t i = 0; i < 3; ++i) {
            if (!points_.put(bits_, number(point_number_[point_[3 * plane + i]], points_))) continue;
            for (int axis = 0; axis < 3; ++axis)
                bits_.put(static_cast<std::uint32_t>(store_.planes.points(plane)[i][axis]),
                          exact::coordinate_bits);
        }
    }

    /// The entry's number in the order of first use.
    static std::uint32_t number(std::uint32_t& known, const bso::References& references) {
        if (known == unknown) known = references.used();
        return known;
    }

    const Store& store_;
    BlockWriter bits_;
    bso::References planes_, points_;
    std::vector<std::uint32_t> plane_number_;  ///< by plane of the store
    std::vector<mesh::VertexIndex> point_;     ///< of the three corners of each plane
    std::vector<std::uint32_t> point_number_;  ///< by point
    std::vector<bsp::Child> pending_;
};

}  // namespace

void encode(const BspOctree& octree, const ByteSink& sink) { Encoder(octree, sink); }

std::vector<std::uint8_t> encode(const BspOctree& octree) {
    std::vector<std::uint8_t> bytes;
    encode(octree,
           [&](std::span<const std::uint8_t> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
    return bytes;
}

}  // namespace octavo::bsp_octree
