// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/bsp/classify.hpp>
#include <octavo/bsp_octree/subdivide.hpp>
#include <octavo/exact/intersect.hpp>

namespace octavo::bsp_octree {
namespace {

using bsp::Bound;
using bsp::Fragment;
using bsp::FragmentPool;

/// Octants take the faces that they inherit `futile_growth` times over when subdividing does not pay: walls cut a
/// patch of compact faces into little more pieces than there were faces, but a bundle of slivers goes whole through
/// four octants. A cell may then be a leaf although it has `futile_size` times the planes, or however many where
/// three fifths of them are in one octant again: a fan of a thousand slivers would be cut to pieces as short as it is
/// wide, 10^5 times over. Swept over models of all kinds (docs/methods/bsp_octree.md): with a half, trees are as good;
/// with nine tenths, those of fans are six times as large.
constexpr std::size_t futile_growth = 2, futile_size = 8;

/// Under `common_point`, faces at one edge and faces in one plane have no single point and need none.
constexpr std::size_t most_without_point = 3;

/// Sends fragments to the sides of the pool's current cut.
void cut(FragmentPool& pool, std::span<const Fragment> fragments, Fragments& back, Fragments& front) {
    for (const Fragment& fragment : fragments) {
        switch (pool.place(fragment)) {
            case FragmentPool::Place::front:
                front.push_back(fragment);
                break;
            case FragmentPool::Place::back:
                back.push_back(fragment);
                break;
            case FragmentPool::Place::both: {
                Fragment front_part, back_part;
                pool.split(fragment, front_part, back_part);
                front.push_back(front_part);
                back.push_back(back_part);
                break;
            }
            case FragmentPool::Place::within:
                OCTAVO_CHECK(false, "a face lies in a wall between cells");
        }
    }
}

}  // namespace

std::array<Fragments, 8>& Workspace::distribute(const octree::Cell& cell,
                                                std::span<const Fragment> fragments) {
    const exact::Point middle = cell.centre();
    const auto wall = [&](int axis) { return Bound::wall(axis, 2 * middle[axis] - 1); };
    std::array<Fragments, 8>& octants = octants_[static_cast<std::size_t>(cell.level)];
    for (Fragments& list : by_x_) list.clear();
    for (Fragments& list : by_xy_) list.clear();
    for (Fragments& list : octants) list.clear();
    pool_.begin_cut(wall(0));
    cut(pool_, fragments, by_x_[0], by_x_[1]);
    pool_.begin_cut(wall(1));
    for (std::size_t x = 0; x < 2; ++x) cut(pool_, by_x_[x], by_xy_[x], by_xy_[x | 2]);
    pool_.begin_cut(wall(2));
    for (std::size_t xy = 0; xy < 4; ++xy) cut(pool_, by_xy_[xy], octants[xy], octants[xy | 4]);
    return octants;
}

std::size_t Workspace::count_planes(std::span<const Fragment> fragments, std::size_t most) {
    planes_.clear();
    for (const Fragment& fragment : fragments) {
        const bsp::PlaneId plane = fragment.facing.plane();
        if (std::find(planes_.begin(), planes_.end(), plane) != planes_.end()) continue;
        planes_.push_back(plane);
        if (planes_.size() > most) break;
    }
    return planes_.size();
}

bool Workspace::is_simple(const octree::Cell& cell, std::span<const Fragment> fragments) {
    if (cell.level >= options_.depth || cell.side() == 1) return true;
    const bool few_planes = options_.stop == StopRule::few_planes;
    const std::size_t most = few_planes ? options_.planes : most_without_point;
    if (count_planes(fragments, most) <= most) {
        if (few_planes) return true;
    } else {
        for (const Fragment& fragment : fragments) planes_.push_back(fragment.facing.plane());
    }
    return shares_a_point(cell);
}

bool Workspace::shares_a_point(const octree::Cell& cell) const {
    const bsp::PlaneTable& table = store_.planes;
    // The point of the first three planes that have one; with fewer, faces are parallel to one line.
    std::optional<exact::TriplePoint> point;
    const std::size_t tried = std::min<std::size_t>(planes_.size(), 6);
    for (std::size_t third = 2; third < tried && !point; ++third)
        for (std::size_t second = 1; second < third && !point; ++second)
            point = exact::intersect(table[planes_[0]], table[planes_[second]], table[planes_[third]]);
    if (!point) return options_.stop == StopRule::common_point && planes_.size() <= most_without_point;
    // Far from the point, subdividing separates the faces. Next to it, octants see as many as their parent, over and
    // over, until a wall comes between: a vertex close to a wall would go down to the last level.
    if (options_.stop == StopRule::few_planes)
        for (int axis = 0; axis < 3; ++axis) {
            const double at = point->approximation(axis), low = cell.low[axis], side = cell.side();
            if (at < low - side || at > low + 2 * side) return false;
        }
    return std::all_of(planes_.begin() + 1, planes_.end(), [&](bsp::PlaneId plane) {
        return exact::side_of(table[plane], *point) == exact::Sign::zero;
    });
}

bool Workspace::is_futile(std::span<const Fragment> fragments,
                          const std::array<Fragments, 8>& octants) const {
    if (options_.stop != StopRule::few_planes) return false;
    std::size_t total = 0, largest = 0;
    for (const Fragments& octant : octants) {
        total += octant.size();
        largest = std::max(largest, octant.size());
    }
    const bool is_small = fragments.size() <= futile_size * options_.planes;
    const bool is_bundle = 5 * largest >= 3 * fragments.size();
    return total >= futile_growth * fragments.size() && (is_small || is_bundle);
}

NodeRef Workspace::make_leaf(std::span<const Fragment> fragments) {
    const std::size_t begin = store_.nodes.size();
    builder_.build(pool_, store_.planes, fragments, store_.nodes);
    return store_.add_leaf(begin);
}

NodeRef Workspace::make_resolved_leaf(const octree::Cell& cell, std::span<const Fragment> fragments,
                                      std::int32_t winding) {
    const std::size_t begin = store_.nodes.size();
    builder_.build(pool_, store_.planes, fragments, store_.nodes);
    const std::span<bsp::Node> nodes = std::span(store_.nodes).subspan(begin);
    if (winding_labels_.label(pool_, cell, fragments, nodes, winding)) return store_.add_leaf(begin);

    ++resolved_leaves_;
    const FragmentPool::Mark mark = pool_.mark();
    Fragments faces;
    extractor_.extract(pool_, cell, {nodes}, faces);
    const bsp::Label label = bsp::label_of_uniform_cell({nodes}, cell, store_.planes);
    store_.nodes.resize(begin);
    const NodeRef node = faces.empty() ? NodeRef::uniform(label) : make_leaf(faces);
    pool_.release(mark);
    return node;
}

NodeRef Workspace::make_gray(const octree::Cell& cell, const Octants& octants) {
    const bool uniform = std::all_of(octants.begin(), octants.end(), [&](NodeRef octant) {
        return octant.is_uniform() && octant == octants[0];
    });
    if (uniform) return octants[0];

    // Leaves of few planes all together become one leaf; so a solid that edits made simple again is small again.
    if (options_.stop == StopRule::few_planes) {
        planes_.clear();
        bool few = true;
        for (const NodeRef octant : octants) {
            if (octant.is_uniform()) continue;
            few = few && octant.is_bsp() && store_.leaves[octant.index()].count <= 2 * options_.planes;
            if (!few) break;
            for (const bsp::Node& node : store_.tree(octant).nodes)
                if (std::find(planes_.begin(), planes_.end(), node.plane) == planes_.end())
                    planes_.push_back(node.plane);
            few = planes_.size() <= options_.planes;
            if (!few) break;
        }
        if (few) {
            const FragmentPool::Mark mark = pool_.mark();
            Fragments faces;
            for (int i = 0; i < 8; ++i)
                if (octants[static_cast<std::size_t>(i)].is_bsp())
                    extract(cell.child(i), octants[static_cast<std::size_t>(i)], faces);
            // Of leaves from a file whose planes pass by their cells there are none.
            const NodeRef node = faces.empty() ? store_.add_gray(octants) : make_leaf(faces);
            pool_.release(mark);
            return node;
        }
    }
    return store_.add_gray(octants);
}

}  // namespace octavo::bsp_octree
