// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <bit>

#include <octavo/bsp/boundary.hpp>
#include <octavo/bsp_octree/cell_progress.hpp>
#include <octavo/render/patch_maker.hpp>
#include <octavo/render/tree_order.hpp>

namespace octavo::render {
namespace {

using bsp_octree::NodeRef;

/// Visits a BSP-octree from the front to the back. White nodes are outside and black ones inside: neither shows.
class BspOctreeOrder {
  public:
    BspOctreeOrder(const bsp_octree::BspOctree& solid, const BspOctreePaint& paint, PatchMaker& maker,
                   const Context& context)
        : store_(solid.store()),
          paint_(paint),
          pool_(store_.planes),
          maker_(maker),
          context_(context),
          progress_(context, "order") {}

    void visit(const octree::Cell& cell, NodeRef node) {
        if (context_.cancelled()) return;
        if (node.is_gray()) {
            const bsp_octree::Octants octants = store_.octants(node);
            const int nearest = maker_.eye().nearest_octant(cell);
            for (int k = 0; k < 8; ++k)
                visit(cell.child(nearest ^ k), octants[static_cast<std::size_t>(nearest ^ k)]);
            return;
        }
        if (node.is_bsp()) add_leaf(cell, node);
        progress_.finish(cell);
    }

  private:
    void add_leaf(const octree::Cell& cell, NodeRef leaf) {
        const bsp::FragmentPool::Mark mark = pool_.mark();
        const bsp::Tree tree = store_.tree(leaf);
        faces_.clear(), sorted_.clear();
        extractor_.extract(pool_, cell, tree, faces_);
        order_.sort(pool_, tree, maker_.eye(), faces_, sorted_);
        const Paint paint = paint_of(tree);
        constexpr Paint cap{palette::inner, palette::inner, true};
        for (const bsp::Fragment& face : sorted_) {
            const bool is_cap =
                std::find(paint_.cut.begin(), paint_.cut.end(), face.facing) != paint_.cut.end();
            maker_.add(pool_, face, is_cap ? cap : paint);
        }
        pool_.release(mark);
    }

    Paint paint_of(const bsp::Tree& tree) {
        if (paint_.colors == BspOctreeColors::solid) return {palette::solid, palette::inner};
        planes_.clear();
        for (const bsp::Node& node : tree.nodes) planes_.push_back(node.plane);
        std::sort(planes_.begin(), planes_.end());
        const auto planes =
            static_cast<std::size_t>(std::unique(planes_.begin(), planes_.end()) - planes_.begin());
        // 1, 2, 4 and 8 planes at most.
        const auto most = static_cast<std::size_t>(std::bit_width(planes - 1));
        const Color color = palette::planes_of_leaf[std::min(most, palette::planes_of_leaf.size() - 1)];
        return {color, color};
    }

    const bsp_octree::Store& store_;
    const BspOctreePaint& paint_;
    bsp::FragmentPool pool_;
    bsp::BoundaryExtractor extractor_;
    PatchMaker& maker_;
    const Context& context_;
    bsp_octree::CellProgress progress_;
    TreeOrder order_;
    std::vector<bsp::Fragment> faces_, sorted_;
    std::vector<bsp::PlaneId> planes_;
};

}  // namespace

Result<Patches> patches_of(const bsp_octree::BspOctree& solid, const Camera& camera,
                           const BspOctreePaint& paint, const Context& context) {
    PatchMaker maker(camera, solid.lattice());
    BspOctreeOrder(solid, paint, maker, context).visit(octree::Cell::root(), solid.root());
    if (context.cancelled()) return Context::cancelled_error();
    return std::move(maker).take();
}

}  // namespace octavo::render
