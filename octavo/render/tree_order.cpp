// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/render/tree_order.hpp>

namespace octavo::render {

using bsp::Fragment;
using bsp::FragmentPool;

void TreeOrder::sort(FragmentPool& pool, const bsp::Tree& tree, const Eye& eye,
                     std::span<const Fragment> fragments, std::vector<Fragment>& sorted) {
    list_.assign(fragments.begin(), fragments.end());
    tasks_.clear();
    tasks_.push_back({bsp::Tree::root, 0, false});
    while (!tasks_.empty()) {
        const Task task = tasks_.back();
        tasks_.pop_back();
        if (task.is_settled || task.child.is_leaf()) {
            sorted.insert(sorted.end(), list_.begin() + task.begin, list_.end());
            list_.resize(task.begin);
        } else if (task.begin < list_.size()) {
            descend(pool, tree.nodes[task.child.index()], eye, task.begin);
        }
    }
}

void TreeOrder::descend(FragmentPool& pool, const bsp::Node& node, const Eye& eye, std::uint32_t begin) {
    const exact::Sign side = eye.side(pool.planes()[node.plane]);
    const bool front_is_near = side == exact::Sign::positive;
    std::vector<Fragment>& front = front_is_near ? near_ : far_;
    std::vector<Fragment>& back = front_is_near ? far_ : near_;
    near_.clear(), within_.clear(), far_.clear();
    pool.begin_cut(bsp::Bound::plane(node.plane));
    for (std::size_t i = begin; i < list_.size(); ++i) {
        const Fragment fragment = list_[i];
        if (fragment.facing.plane() == node.plane) {
            within_.push_back(fragment);
            continue;
        }
        const FragmentPool::Place place = pool.place(fragment);
        Fragment in_front = fragment, behind = fragment;
        if (place == FragmentPool::Place::both) pool.split(fragment, in_front, behind);
        if (place != FragmentPool::Place::back) front.push_back(in_front);
        if (place == FragmentPool::Place::back || place == FragmentPool::Place::both) back.push_back(behind);
    }
    std::stable_partition(within_.begin(), within_.end(),
                          [&](const Fragment& f) { return f.facing.reversed() != front_is_near; });

    list_.resize(begin);
    const auto push = [&](bsp::Child child, const std::vector<Fragment>& fragments, bool is_settled) {
        if (fragments.empty()) return;
        tasks_.push_back({child, static_cast<std::uint32_t>(list_.size()), is_settled});
        list_.insert(list_.end(), fragments.begin(), fragments.end());
    };
    push(front_is_near ? node.back : node.front, far_, false);
    push({}, within_, true);
    push(front_is_near ? node.front : node.back, near_, false);
}

}  // namespace octavo::render
