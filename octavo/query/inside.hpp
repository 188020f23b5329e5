// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/classic/closed_surface.hpp>
#include <octavo/classic/facet.hpp>
#include <octavo/exact/lattice.hpp>
#include <octavo/mesh/mesh.hpp>
#include <octavo/query/cell_index.hpp>
#include <octavo/query/leaf_record.hpp>
#include <octavo/query/leaf_test.hpp>

// Inside, on or outside: exact answers for arbitrary double points about a solid bounded by triangles.
//
// The solid is the snapped mesh, inside is winding number > 0, and query points are not rounded: a point one unit in
// the last place off a facet gets the right answer. Idea: an octree whose leaves are white, black, or gray with the
// few facets that touch them and the winding number of their low corner. White and black leaves answer at once. In a
// gray one the point is reached from the low corner by three axis-parallel steps, whose crossings with those facets
// change the winding number (simulation of simplicity, see classic/crossing.hpp); the signs are those of linear forms
// at double points, by a filter first and exactly where that fails.
//
// Locating is made of few dependent loads (cell_index.hpp), and a leaf is one record (leaf_record.hpp) beside its
// brick. A batch runs many points through these loads side by side, so that their cache misses overlap.
//
// Rules at the rim: a point with an infinite coordinate is outside; one with a NaN lies nowhere and is reported as
// outside too.
//
// Source: J. R. Rossignac and J. K. Wu 1987 and the classic point location in octrees; the leaf test is ours.

namespace octavo::query {

enum class Side : std::int8_t {
    inside = -1,
    /// On a facet of the surface: also on one without area, and on one inside the solid where shells overlap.
    on = 0,
    outside = 1,
};

struct InsideOptions {
    classic::OpenPolicy open = classic::OpenPolicy::reject;
    /// Cells with at most this many facets are not split further, nor those with up to four times as many that all
    /// share a corner. Measured: with 4 a query near the surface of a scan costs least; 2 doubles the memory for a few
    /// per cent, 8 costs a third more time.
    int leaf_facets = 4;
    /// The deepest level, at most 21. Around a vertex with more facets than `leaf_facets` splitting would not end.
    int depth = 12;
    /// For each facet of the solid so many references to facets, 4 bytes each, in all leaves together at most: the
    /// memory is linear whatever the shape. Scans need 10. Slivers side by side and surfaces like the pages of a book
    /// get 90: a cell is split only if even all of its facets in all octants were within the bound. Of cylinders with
    /// 10 000 sides twice as many make a query near the surface 1.7 times as fast, for twice the memory and time to
    /// build.
    int references = 512;
};

class InsideQuery {
  public:
    /// Errors: those of snapping; bad_input, not_a_solid (open, under OpenPolicy::reject), limit, cancelled.
    static Result<InsideQuery> build(const mesh::LatticeMesh& mesh, const InsideOptions& options = {},
                                     const Context& context = {});
    static Result<InsideQuery> build(const mesh::Mesh& mesh, const InsideOptions& options = {},
                                     const Context& context = {});

    /// Where a point of the world lies.
    Side operator()(Vec3 point) const;

    /// The same for many points, in their order; parallel, and faster a point. Cancelled: the rest says outside.
    std::vector<Side> operator()(std::span<const Vec3> points, const Context& context = {}) const;
    /// Floats are doubles exactly.
    std::vector<Side> operator()(std::span<const std::array<float, 3>> points,
                                 const Context& context = {}) const;

    /// The same in two steps, for callers with other work between them: what the second needs is by then in the cache.
    struct Begun;
    Begun begin(Vec3 point) const;
    Side finish(const Begun& begun) const;

    const exact::Lattice& lattice() const { return lattice_; }
    std::size_t memory_bytes() const;
    /// To facets, in all leaves together.
    std::size_t reference_count() const { return reference_count_; }

  private:
    InsideQuery() = default;

    /// A point in the universe: where it is (LatticePlace) and the Morton code of its cell of the last level. Blocks of
    /// them are not worth initialising.
    struct Located {
        std::array<std::int32_t, 3> whole;
        std::array<double, 3> part;
        std::uint64_t code;
    };

    /// So many points are under way at once: a core follows 10 to 20 misses, and a block's facets fit its cache.
    static constexpr std::size_t block_size = 32;

    bool place(Vec3 point, Located& located) const;
    Side test(const LeafRecord& leaf, Vec3 point, const Located& located) const;
    void answer_block(std::span<const Vec3> points, std::span<Side> sides) const;
    template <class Point>
    std::vector<Side> answer(std::span<const Point> points, const Context& context) const;

    exact::Lattice lattice_;
    double inverse_unit_ = 1;
    CellIndex cells_;
    std::size_t reference_count_ = 0;
    /// In the order in which the leaves name them, so that those of one place lie side by side; one more after the
    /// last, because they are read in words of 16 bytes.
    std::vector<classic::FacetCorners, HugePageAllocator<classic::FacetCorners>> facets_;
};

struct InsideQuery::Begun {
    Vec3 point;
    Located located{};
    CellIndex::Kind kind = CellIndex::Kind::white;
    CellIndex::Entry entry;  ///< of the table, where the kind alone does not tell
};

/// One-off: builds an InsideQuery and asks it. Worth it from some hundred points on. Errors: as build, while asking
/// too.
Result<std::vector<Side>> contains(const mesh::Mesh& mesh, std::span<const Vec3> points,
                                   const InsideOptions& options = {}, const Context& context = {});

}  // namespace octavo::query
