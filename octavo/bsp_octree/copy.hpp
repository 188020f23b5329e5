// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/bsp_octree/store.hpp>

// Nodes from one store to another, with the planes that they refer to and no others. Equal planes become one.

namespace octavo::bsp_octree {

/// Copies the nodes below one root after the other.
class Copier {
  public:
    Copier(const Store& from, Store& to) : from_(from), to_(to), planes_(from.planes.size(), unknown) {}

    NodeRef operator()(NodeRef node);

  private:
    bsp::PlaneId plane(bsp::PlaneId id);

    static constexpr bsp::PlaneId unknown = ~bsp::PlaneId{0};
    const Store& from_;
    Store& to_;
    std::vector<bsp::PlaneId> planes_;
};

}  // namespace octavo::bsp_octree
