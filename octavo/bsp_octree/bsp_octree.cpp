// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bsp_octree/bsp_octree.hpp>
#include <octavo/bsp_octree/copy.hpp>
#include <octavo/bsp_octree/meet.hpp>
#include <octavo/exact/linear_form.hpp>

namespace octavo::bsp_octree {
namespace {

/// `first` ∩ `second`, either of them complemented, and the result too.
Result<BspOctree> meet(const BspOctree& first, bool complement_first, const BspOctree& second,
                       bool complement_second, bool complement_result, Edit* edit, const Context& context) {
    if (first.lattice() != second.lattice())
        return Error{ErrorCode::bad_input, "the solids are not on one lattice", {}};
    const std::shared_ptr<Store>& store = first.shared_store();
    NodeRef other = second.root();
    if (second.shared_store() != store) other = Copier(second.store(), *store)(other);
    if (edit) *edit = {};
    bsp::FragmentPool pool(store->planes);
    Workspace workspace(*store, pool, first.options(), context, "set operation");
    const NodeRef root = Meet(workspace, edit)(first.root().complement_if(complement_first),
                                               other.complement_if(complement_second));
    if (context.cancelled()) return Context::cancelled_error();
    return BspOctree(first.lattice(), first.options(), store, root.complement_if(complement_result));
}

/// The sides of one point of the world of all that cuts the tree.
class PointSides {
  public:
    PointSides(const BspOctree& octree, Vec3 point) : octree_(octree), point_(point) {}

    exact::Sign of_wall(int axis, std::int32_t twice) const {
        return exact::LinearForm::of(octree_.lattice(), bsp::wall_plane(axis, twice)).at(point_);
    }
    exact::Sign operator()(bsp::PlaneId plane) const {
        return exact::LinearForm::of(octree_.lattice(), octree_.store().planes[plane]).at(point_);
    }

  private:
    const BspOctree& octree_;
    Vec3 point_;
};

/// The positions of a point in all cells whose closure holds it, as one.
class PointSearch {
  public:
    PointSearch(const Store& store, const PointSides& sides) : store_(store), sides_(sides) {}

    bsp::Position operator()(const octree::Cell& cell, NodeRef node) {
        if (node.is_uniform()) return bsp::position_of(node.is_black() ? bsp::Label::in : bsp::Label::out);
        if (node.is_bsp()) return bsp::classify(store_.tree(node), sides_);
        const exact::Point middle = cell.centre();
        std::array<exact::Sign, 3> side;
        for (int axis = 0; axis < 3; ++axis)
            side[static_cast<std::size_t>(axis)] = sides_.of_wall(axis, 2 * middle[axis] - 1);
        const Octants octants = store_.octants(node);
        std::optional<bsp::Position> found;
        for (int i = 0; i < 8; ++i) {
            bool holds = true;
            for (std::size_t axis = 0; axis < 3; ++axis)
                holds =
                    holds && side[axis] != (i >> axis & 1 ? exact::Sign::negative : exact::Sign::positive);
            if (!holds) continue;
            const bsp::Position here = (*this)(cell.child(i), octants[static_cast<std::size_t>(i)]);
            if (here == bsp::Position::on || (found && *found != here)) return bsp::Position::on;
            found = here;
        }
        return *found;
    }

  private:
    const Store& store_;
    const PointSides& sides_;
};

}  // namespace

BspOctree::BspOctree(const exact::Lattice& lattice, const Options& options)
    : BspOctree(lattice, options, std::make_shared<Store>(), NodeRef::white()) {}

Result<BspOctree> BspOctree::intersect(const BspOctree& other, Edit* edit, const Context& context) const {
    return meet(*this, false, other, false, false, edit, context);
}
Result<BspOctree> BspOctree::unite(const BspOctree& other, Edit* edit, const Context& context) const {
    return meet(*this, true, other, true, true, edit, context);
}
Result<BspOctree> BspOctree::subtract(const BspOctree& other, Edit* edit, const Context& context) const {
    return meet(*this, false, other, true, false, edit, context);
}

bsp::Position BspOctree::classify(Vec3 point) const {
    OCTAVO_CHECK(is_finite(point), "a point that is not finite has no position");
    const PointSides sides(*this, point);
    bool inside_universe = true;
    for (int axis = 0; axis < 3; ++axis)
        inside_universe = inside_universe && sides.of_wall(axis, -1) != exact::Sign::negative &&
                          sides.of_wall(axis, 2 * exact::universe_side - 1) != exact::Sign::positive;
    // Faces keep a unit off the universe's walls, so its first lattice point has the colour of all that is beyond.
    if (!inside_universe) return classify(lattice_.to_world({0, 0, 0}));
    return PointSearch(*store_, sides)(octree::Cell::root(), root_);
}

Stats BspOctree::stats() const {
    Stats stats;
    std::vector<bool> seen(store_->planes.size());
    for_each_leaf([&](const octree::Cell& cell, NodeRef leaf) {
        stats.deepest = std::max(stats.deepest, cell.level);
        if (leaf.is_uniform()) {
            ++(leaf.is_white() ? stats.white : stats.black);
            return;
        }
        ++stats.bsp_leaves;
        const bsp::Tree tree = store_->tree(leaf);
        stats.bsp_nodes += tree.nodes.size();
        stats.largest_tree = std::max<std::uint64_t>(stats.largest_tree, tree.nodes.size());
        for (const bsp::Node& node : tree.nodes) {
            stats.planes += !seen[node.plane];
            seen[node.plane] = true;
        }
    });
    stats.gray = (stats.white + stats.black + stats.bsp_leaves - 1) / 7;
    stats.bytes = stats.gray * sizeof(Octants) + stats.bsp_leaves * sizeof(Store::Leaf) +
                  stats.bsp_nodes * sizeof(bsp::Node) +
                  stats.planes * (sizeof(exact::Plane) + sizeof(bsp::PlaneTable::Points));
    return stats;
}

BspOctree BspOctree::compacted() const {
    auto store = std::make_shared<Store>();
    const NodeRef root = Copier(*store_, *store)(root_);
    return {lattice_, options_, std::move(store), root};
}

}  // namespace octavo::bsp_octree
