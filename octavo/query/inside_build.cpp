// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include <octavo/classic/facet_lists.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/query/inside.hpp>

// Building the inside query: the descent of the classic octree with lists kept in the leaves, then one pass that writes
// the leaves, which come in Morton order, into the table and the bricks.

namespace octavo::query {
namespace {

using classic::Facet;
using classic::FacetLists;
using classic::FacetRange;
using classic::OctantFacets;
using classic::Touch;
using octree::Cell;
using octree::CellKey;
using octree::Node;

/// The leaves in Morton order; those of gray ones with their facets.
class LeafList {
  public:
    struct Item {
        CellKey key;
        Node node;
        std::uint32_t leaf = 0;  ///< of a gray one, in `leaves`
    };

    struct Workspace {
        FacetLists lists;
    };

    void split(const Cell&, const FacetRange&, const Workspace&) {}

    void leaf(const Cell& cell, const octree::Restricted<FacetRange>& leaf, const Workspace& workspace) {
        Item item{cell.key(), leaf.node, 0};
        if (leaf.node == Node::gray) {
            item.leaf = static_cast<std::uint32_t>(leaves.size());
            const auto begin = static_cast<std::uint32_t>(references.size());
            const std::span<const std::uint32_t> list = workspace.lists.list(cell.level, leaf.description);
            references.insert(references.end(), list.begin(), list.end());
            leaves.push_back({.winding = leaf.description.winding,
                              .low = {cell.low.x, cell.low.y, cell.low.z},
                              .begin = begin,
                              .end = static_cast<std::uint32_t>(references.size()),
                              .extent = static_cast<double>(cell.side())});
        }
        items.push_back(item);
    }

    void merge(const Cell& cell, octree::Color color) {
        items.resize(items.size() - 8);
        items.push_back({cell.key(), octree::leaf_of(color), 0});
    }

    void append(LeafList&& next) {
        const auto leaf_offset = static_cast<std::uint32_t>(leaves.size());
        const auto reference_offset = static_cast<std::uint32_t>(references.size());
        for (Item& item : next.items) item.leaf += leaf_offset;
        for (InsideQuery::Leaf& leaf : next.leaves)
            leaf.begin += reference_offset, leaf.end += reference_offset;
        items.insert(items.end(), next.items.begin(), next.items.end());
        leaves.insert(leaves.end(), next.leaves.begin(), next.leaves.end());
        references.insert(references.end(), next.references.begin(), next.references.end());
    }

    std::vector<Item> items;
    std::vector<InsideQuery::Leaf> leaves;
    std::vector<std::uint32_t> references;
};

class InsideProblem {
  public:
    using Description = FacetRange;
    using Workspace = LeafList::Workspace;
    using Output = LeafList;

    InsideProblem(std::span<const Facet> facets, const InsideOptions& options)
        : facets_(facets), options_(options) {}

    int depth() const { return options_.depth; }
    Workspace make_workspace() const { return {}; }
    Output make_output() const { return {}; }
    std::size_t weight(const FacetRange& range) const { return range.size(); }

    octree::Restricted<FacetRange> root(Workspace& workspace) const {
        const FacetRange range = classic::universe_facets(facets_, Touch::half_open, workspace.lists);
        return {node_of(range, workspace.lists.list(0, range)), range};
    }

    void restrict_to_children(const Cell& cell, const FacetRange& range, Workspace& workspace,
                              octree::Children<FacetRange>& children) const {
        const OctantFacets found =
            classic::find_octants<Touch::half_open>(facets_, cell, range, workspace.lists);
        const std::array<FacetRange, 8> ranges = distribute(cell, range, found, workspace.lists);
        for (std::size_t octant = 0; octant < 8; ++octant)
            children[octant] = {node_of(ranges[octant], workspace.lists.list(cell.level + 1, ranges[octant])),
                                ranges[octant]};
    }

    FacetRange transfer(const Cell& cell, const FacetRange& range, const Workspace& from,
                        Workspace& to) const {
        return classic::transfer(cell, range, from.lists, to.lists);
    }

  private:
    Node node_of(const FacetRange& range, std::span<const std::uint32_t> list) const {
        if (list.empty()) return range.winding > 0 ? Node::black : Node::white;
        const auto few = static_cast<std::size_t>(options_.leaf_facets);
        // Splitting never separates facets that share a corner, and corners have six facets on average.
        return list.size() <= few || (list.size() <= 4 * few && share_a_corner(list)) ? Node::gray
                                                                                      : Node::split;
    }

    bool share_a_corner(std::span<const std::uint32_t> list) const {
        for (const auto& candidate : facets_[list[0]].corner) {
            bool shared = true;
            for (std::size_t i = 1; shared && i < list.size(); ++i) {
                const auto& corner = facets_[list[i]].corner;
                shared = corner[0] == candidate || corner[1] == candidate || corner[2] == candidate;
            }
            if (shared) return true;
        }
        return false;
    }

    std::span<const Facet> facets_;
    const InsideOptions& options_;
};

/// The dense table has about as many cells as there are leaves, and at most 2^18 (level 6, 1 MiB): larger ones fall
/// out of the cache, smaller ones put a brick between more points and their leaf.
int top_level_for(std::size_t leaves) {
    int level = 0;
    while (level < 6 && (std::size_t{1} << (3 * (level + 1))) <= leaves) ++level;
    return level;
}

}  // namespace

/// Writes leaves into the table and the bricks.
class InsideAssembly {
  public:
    explicit InsideAssembly(InsideQuery& query) : query_(query) {}

    void write(const std::vector<LeafList::Item>& items) {
        query_.top_level_ = top_level_for(items.size());
        query_.top_.assign(std::size_t{1} << (3 * query_.top_level_), InsideQuery::white);
        for (const LeafList::Item& item : items) write(item);
    }

    /// Numbers the facets in the order in which the leaves name them, so that those of one place lie side by side.
    void renumber_facets() {
        constexpr std::uint32_t unnamed = std::numeric_limits<std::uint32_t>::max();
        std::vector<std::uint32_t> number(query_.facets_.size(), unnamed);
        std::vector<Facet> ordered;
        ordered.reserve(query_.facets_.size());
        for (std::uint32_t& reference : query_.references_) {
            if (number[reference] == unnamed) {
                number[reference] = static_cast<std::uint32_t>(ordered.size());
                ordered.push_back(query_.facets_[reference]);
            }
            reference = number[reference];
        }
        query_.facets_ = std::move(ordered);
    }

    void measure_extents() {
        for (InsideQuery::Leaf& leaf : query_.leaves_)
            for (std::uint32_t r = leaf.begin; r < leaf.end; ++r) {
                const Facet& facet = query_.facets_[query_.references_[r]];
                for (std::size_t axis = 0; axis < 3; ++axis)
                    leaf.extent =
                        std::max({leaf.extent, static_cast<double>(leaf.low[axis] - facet.low[axis]),
                                  static_cast<double>(facet.high[axis] - leaf.low[axis])});
            }
    }

  private:
    using Entry = InsideQuery::Entry;

    void write(const LeafList::Item& item) {
        const Entry entry = item.node == Node::gray    ? InsideQuery::gray | item.leaf
                            : item.node == Node::black ? InsideQuery::black
                                                       : InsideQuery::white;
        const int level = item.key.level();
        const std::uint64_t code = item.key.code();
        int table_level = query_.top_level_;
        std::vector<Entry>* table = &query_.top_;
        std::size_t at = static_cast<std::size_t>(code >> (3 * (octree::max_level - table_level)));
        while (level > table_level) {
            if (((*table)[at] & InsideQuery::kind_mask) != InsideQuery::brick) {
                const auto index = static_cast<Entry>(query_.bricks_.size() / InsideQuery::brick_cells);
                (*table)[at] = InsideQuery::brick | index;
                query_.bricks_.resize(query_.bricks_.size() + InsideQuery::brick_cells, InsideQuery::white);
            }
            const std::size_t brick = (*table)[at] & ~InsideQuery::kind_mask;
            table = &query_.bricks_;
            table_level += InsideQuery::brick_levels;
            // Bricks may reach below the last level of a key; then its code goes on with zeros.
            const int shift = 3 * (octree::max_level - table_level);
            const std::uint64_t within = shift >= 0 ? code >> shift : code << -shift;
            at = brick * InsideQuery::brick_cells + (within & (InsideQuery::brick_cells - 1));
        }
        std::fill_n(table->begin() + static_cast<std::ptrdiff_t>(at),
                    std::size_t{1} << (3 * (table_level - level)), entry);
    }

    InsideQuery& query_;
};

Result<InsideQuery> InsideQuery::build(const mesh::LatticeMesh& mesh, const InsideOptions& options,
                                       const Context& context) {
    if (options.depth < 0 || options.depth > octree::max_level || options.leaf_facets < 0)
        return Error{ErrorCode::bad_input,
                     "the depth of an inside query is 0 to 21 and its leaves hold 0 facets or more",
                     {}};
    Result<std::vector<Facet>> facets = classic::facets_of(mesh);
    if (!facets) return facets.error();
    if (const std::vector<classic::OpenEdge> open = classic::open_edges(mesh); !open.empty()) {
        if (options.open == classic::OpenPolicy::reject) return classic::open_surface_error(open);
        facets = classic::facets_of(classic::close_holes(mesh, open));
    }
    octree::DescentOptions descent;
    descent.phase = "inside";
    Result<LeafList> leaves = octree::descend(InsideProblem(*facets, options), context, descent);
    if (!leaves) return leaves.error();
    if (leaves->items.size() >= kind_mask >> 2)
        return Error{ErrorCode::limit, "the inside query has more leaves than it can number", {}};

    InsideQuery query;
    query.lattice_ = mesh.lattice;
    query.inverse_unit_ = 1 / mesh.lattice.unit();
    query.facets_ = std::move(*facets);
    query.leaves_ = std::move(leaves->leaves);
    query.references_ = std::move(leaves->references);
    InsideAssembly assembly(query);
    assembly.write(leaves->items);
    assembly.renumber_facets();
    assembly.measure_extents();
    query.bricks_.shrink_to_fit();
    query.leaves_.shrink_to_fit();
    query.references_.shrink_to_fit();
    return query;
}

Result<InsideQuery> InsideQuery::build(const mesh::Mesh& mesh, const InsideOptions& options,
                                       const Context& context) {
    const Result<mesh::Snapped> snapped = mesh::snap(mesh);
    if (!snapped) return snapped.error();
    return build(snapped->mesh, options, context);
}

}  // namespace octavo::query
