// SPDX-License-Identifier: Apache-2.0
#include <octavo/bsp/node_polygons.hpp>

namespace octavo::bsp {

Fragment NodePolygons::polygon(FragmentPool& pool, const octree::Cell& cell, PlaneId plane) const {
    Fragment section = pool.section(plane, cell);
    for (const Side& side : path_) {
        if (section.count == 0) break;
        pool.begin_cut(Bound::plane(side.plane), pool.planes()[side.plane]);
        Fragment front, back;
        switch (pool.place(section)) {
            case FragmentPool::Place::both:
                pool.split(section, front, back);
                section = side.is_front ? front : back;
                break;
            case FragmentPool::Place::front:
                if (!side.is_front) section.count = 0;
                break;
            case FragmentPool::Place::back:
                if (side.is_front) section.count = 0;
                break;
            case FragmentPool::Place::within:
                OCTAVO_CHECK(false, "a plane comes twice on a path of a BSP tree");
        }
    }
    return section;
}

}  // namespace octavo::bsp
