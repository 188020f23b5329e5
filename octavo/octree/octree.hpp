// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/exact/lattice.hpp>
#include <octavo/octree/df_code.hpp>

// A classic octree: the colours of cells that fill the universe of one lattice.
//
// It is immutable and small: the DF code and where it lies. What needs random access turns it into a
// LinearOctree first; what only walks (volumes, set operations, files, pictures) walks the code.
//
// Meaning: black leaves lie in the solid, white leaves outside, up to their sides; the solid's surface lies
// in gray leaves and in the walls between leaves. So black volume ≤ volume of the solid ≤ black + gray
// volume.

namespace octavo::octree {

/// Volumes in cubic lattice units; the universe has 2^78.
using LatticeVolume = unsigned __int128;
static_assert(3 * exact::coordinate_bits < 128);

constexpr LatticeVolume cell_volume(int level) {
    return LatticeVolume{1} << (3 * (exact::coordinate_bits - level));
}

/// Numbers about an octree.
struct OctreeStats {
    struct Level {
        std::uint64_t white = 0, black = 0, gray = 0, split = 0;
    };
    std::array<Level, max_level + 1> levels{};
    std::uint64_t white = 0, black = 0, gray = 0;  ///< leaves
    std::uint64_t splits = 0;                      ///< inner nodes
    int deepest = 0;                               ///< level of the deepest leaf
    LatticeVolume black_volume = 0, gray_volume = 0;

    std::uint64_t leaves() const { return white + black + gray; }
    std::uint64_t nodes() const { return leaves() + splits; }
};

class Octree {
  public:
    /// An all-white universe of depth 0.
    Octree() { code_.append(Node::white); }

    /// `code` must be a tree at most `depth` deep, as a descent makes it; use `from_untrusted` otherwise.
    Octree(const exact::Lattice& lattice, int depth, DfCode code)
        : lattice_(lattice), depth_(depth), code_(std::move(code)) {
        OCTAVO_CHECK(depth >= 0 && depth <= max_level, "the depth of an octree is 0 to 21");
        OCTAVO_DCHECK(validate(), "the DF code is no tree");
    }

    /// The same with every claim tested. Errors: bad_input.
    static Result<Octree> from_untrusted(const exact::Lattice& lattice, int depth, DfCode code);

    const exact::Lattice& lattice() const { return lattice_; }
    /// The deepest level that a leaf may have; a cell of it has side `cell_side(depth())` in lattice units.
    int depth() const { return depth_; }
    const DfCode& code() const { return code_; }

    Status validate() const { return check_tree(code_, depth_); }
    OctreeStats stats() const;

    /// Calls `visit(CellKey, Color)` for the leaves in Morton order.
    template <class Visit>
    void for_each_leaf(const Visit& visit) const {
        for (DfCursor cursor(code_); !cursor.done(); cursor.next())
            if (const Node node = cursor.node(); is_leaf(node)) visit(cursor.key(), color_of(node));
    }

    friend bool operator==(const Octree&, const Octree&) = default;

  private:
    exact::Lattice lattice_;
    int depth_ = 0;
    DfCode code_;
};

/// Lattice volume → world volume, rounded once.
double world_volume(const exact::Lattice& lattice, LatticeVolume volume);

}  // namespace octavo::octree
