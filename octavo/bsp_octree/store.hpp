// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/bsp/plane_table.hpp>
#include <octavo/bsp/tree.hpp>

// The nodes of BSP-octrees, many versions of a solid in one store.
//
// A node is never changed once it is there. An edit appends the nodes on the way from the root to what it touches and
// refers to all others, so that versions share whatever they have in common and undo is keeping the old root.
//
// A NodeRef is a word: what kind of node, which one, and whether it is meant complemented. White and black are the
// same node and its complement; the complement of a solid is its root with that bit turned. So algorithm 3.6 of the
// source, which walks the tree and turns all planes, costs nothing, and union and difference are intersections.

namespace octavo::bsp_octree {

class NodeRef {
  public:
    enum class Kind : std::uint8_t { uniform, gray, bsp };

    /// White.
    constexpr NodeRef() = default;
    static constexpr NodeRef uniform(bsp::Label label) { return NodeRef(static_cast<std::uint32_t>(label)); }
    static constexpr NodeRef white() { return uniform(bsp::Label::out); }
    static constexpr NodeRef black() { return uniform(bsp::Label::in); }
    static constexpr NodeRef gray(std::size_t index) { return of(Kind::gray, index); }
    static constexpr NodeRef bsp(std::size_t index) { return of(Kind::bsp, index); }

    constexpr Kind kind() const { return static_cast<Kind>(bits_ >> 1 & 3); }
    constexpr bool is_uniform() const { return kind() == Kind::uniform; }
    constexpr bool is_gray() const { return kind() == Kind::gray; }
    constexpr bool is_bsp() const { return kind() == Kind::bsp; }
    constexpr bool is_white() const { return bits_ == 0; }
    constexpr bool is_black() const { return bits_ == 1; }
    constexpr std::size_t index() const { return bits_ >> 3; }
    constexpr bool complemented() const { return bits_ & 1; }

    constexpr NodeRef complement() const { return NodeRef(bits_ ^ 1); }
    constexpr NodeRef complement_if(bool condition) const { return NodeRef(bits_ ^ (condition ? 1U : 0U)); }

    friend constexpr auto operator<=>(NodeRef, NodeRef) = default;

    static constexpr std::size_t most = std::size_t{1} << 29;  ///< nodes of a kind

  private:
    constexpr explicit NodeRef(std::uint32_t bits) : bits_(bits) {}
    static constexpr NodeRef of(Kind kind, std::size_t index) {
        return NodeRef(static_cast<std::uint32_t>(index << 3) | static_cast<std::uint32_t>(kind) << 1);
    }
    std::uint32_t bits_ = 0;
};

using Octants = std::array<NodeRef, 8>;

struct Store {
    struct Leaf {
        std::uint32_t begin, count;  ///< in `nodes`; children count from `begin`
    };

    bsp::PlaneTable planes;
    std::vector<Octants> grays;
    std::vector<Leaf> leaves;
    std::vector<bsp::Node> nodes;

    bsp::Tree tree(NodeRef leaf) const {
        const Leaf& at = leaves[leaf.index()];
        return {{nodes.data() + at.begin, at.count}, leaf.complemented()};
    }
    Octants octants(NodeRef gray) const {
        Octants children = grays[gray.index()];
        for (NodeRef& child : children) child = child.complement_if(gray.complemented());
        return children;
    }
    NodeRef add_gray(const Octants& children) {
        OCTAVO_CHECK(grays.size() < NodeRef::most, "too many nodes for one store");
        grays.push_back(children);
        return NodeRef::gray(grays.size() - 1);
    }
    /// The leaf of the nodes appended since `begin`.
    NodeRef add_leaf(std::size_t begin) {
        OCTAVO_CHECK(leaves.size() < NodeRef::most && nodes.size() < ~std::uint32_t{0},
                     "too many nodes for one store");
        leaves.push_back(
            {static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(nodes.size() - begin)});
        return NodeRef::bsp(leaves.size() - 1);
    }

    std::size_t bytes() const {
        return planes.bytes() + grays.capacity() * sizeof(Octants) + leaves.capacity() * sizeof(Leaf) +
               nodes.capacity() * sizeof(bsp::Node);
    }
};

}  // namespace octavo::bsp_octree
