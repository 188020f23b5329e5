// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include <octavo/classic/set_operations.hpp>

namespace octavo::classic {
namespace {

using octree::Color;
using octree::DfCode;
using octree::Node;

Color apply(SetOperation operation, Color a, Color b) {
    switch (operation) {
        case SetOperation::union_of:
            return octree::unite(a, b);
        case SetOperation::intersection:
            return octree::intersect(a, b);
        case SetOperation::difference:
            return octree::subtract(a, b);
        default:
            return octree::symmetric_difference(a, b);
    }
}

/// What each colour of a leaf becomes.
using Recolouring = std::array<Color, 3>;

class Walk {
  public:
    Walk(SetOperation operation, const DfCode& a, const DfCode& b) : operation_(operation), a_(a), b_(b) {
        result_.reserve(std::max(a.size(), b.size()));
    }

    DfCode run() {
        both();
        return std::move(result_);
    }

  private:
    /// The next sub-trees of both; returns the colour of the result when it is one leaf, else split.
    Node both() {
        const Node a = a_[at_a_], b = b_[at_b_];
        if (is_leaf(a) && is_leaf(b)) {
            ++at_a_, ++at_b_;
            return append(apply(operation_, color_of(a), color_of(b)));
        }
        if (is_leaf(a)) {
            ++at_a_;
            return with_leaf(b_, at_b_, [&](Color c) { return apply(operation_, color_of(a), c); });
        }
        if (is_leaf(b)) {
            ++at_b_;
            return with_leaf(a_, at_a_, [&](Color c) { return apply(operation_, c, color_of(b)); });
        }
        ++at_a_, ++at_b_;
        return octants([&] { return both(); });
    }

    template <class Recolour>
    Node with_leaf(const DfCode& code, std::size_t& at, const Recolour& recolour) {
        const Recolouring colors{recolour(Color::white), recolour(Color::black), recolour(Color::gray)};
        if (colors[0] == colors[1] && is_decided(colors[0])) {
            skip(code, at);
            return append(colors[0]);
        }
        if (colors[0] != colors[1] && is_decided(colors[0]) && is_decided(colors[1])) {
            copy(code, at, colors);
            return Node::split;
        }
        return recoloured(code, at, colors);
    }

    static void skip(const DfCode& code, std::size_t& at) {
        for (std::size_t pending = 1; pending > 0;)
            pending += code[at++] == Node::split ? 7 : std::size_t(-1);
    }

    /// White and black stay apart, so nothing can merge that was not merged before.
    void copy(const DfCode& code, std::size_t& at, const Recolouring& colors) {
        for (std::size_t pending = 1; pending > 0;) {
            const Node node = code[at++];
            result_.append(is_leaf(node) ? octree::leaf_of(colors[static_cast<std::size_t>(node)]) : node);
            pending += node == Node::split ? 7 : std::size_t(-1);
        }
    }

    Node recoloured(const DfCode& code, std::size_t& at, const Recolouring& colors) {
        const Node node = code[at++];
        if (is_leaf(node)) return append(colors[static_cast<std::size_t>(node)]);
        return octants([&] { return recoloured(code, at, colors); });
    }

    template <class Octant>
    Node octants(const Octant& octant) {
        const std::size_t begin = result_.size();
        result_.append(Node::split);
        Node common = octant();
        for (int i = 1; i < 8; ++i)
            if (octant() != common) common = Node::split;
        if (common == Node::split || common == Node::gray) return Node::split;
        result_.truncate(begin);
        return append(color_of(common));
    }

    Node append(Color color) {
        result_.append(octree::leaf_of(color));
        return octree::leaf_of(color);
    }

    SetOperation operation_;
    const DfCode& a_;
    const DfCode& b_;
    std::size_t at_a_ = 0, at_b_ = 0;
    DfCode result_;
};

}  // namespace

DfCode combine(SetOperation operation, const DfCode& a, const DfCode& b) {
    return Walk(operation, a, b).run();
}

DfCode complement(const DfCode& a) {
    DfCode black;
    black.append(Node::black);
    return combine(SetOperation::difference, black, a);
}

Result<octree::Octree> combine(SetOperation operation, const octree::Octree& a, const octree::Octree& b) {
    if (!(a.lattice() == b.lattice()))
        return Error{ErrorCode::bad_input, "the two octrees lie on different lattices", {}};
    return octree::Octree(a.lattice(), std::max(a.depth(), b.depth()),
                          combine(operation, a.code(), b.code()));
}

octree::Octree complement(const octree::Octree& a) {
    return octree::Octree(a.lattice(), a.depth(), complement(a.code()));
}

}  // namespace octavo::classic
