// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include <octavo/classic/facet_lists.hpp>
#include <octavo/exact/int128.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/query/bare_facets.hpp>
#include <octavo/query/inside.hpp>

// Building the inside query: the descent of the classic octree, whose leaves, which come in Morton order, become
// records and items of the index.

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

/// The facets of a cell, and how many references to facets the leaves in it may hold.
struct Share {
    FacetRange range;
    std::uint64_t references = 0;
};

/// The leaves in Morton order; those of gray ones with their records.
class LeafList {
  public:
    struct Workspace {
        FacetLists lists;
    };

    void split(const Cell&, const Share&, const Workspace&) {}

    void leaf(const Cell& cell, const octree::Restricted<Share>& leaf, const Workspace& workspace) {
        CellIndex::Item item{cell.key(), {kind_of(leaf.node), 0}};
        if (leaf.node == Node::gray) {
            const FacetRange& range = leaf.description.range;
            item.entry.value = static_cast<std::uint32_t>(LeafRecord::append(
                records, cell.level, range.winding, workspace.lists.list(cell.level, range)));
            references += range.size();
        }
        items.push_back(item);
    }

    void merge(const Cell& cell, octree::Color color) {
        items.resize(items.size() - 8);
        items.push_back({cell.key(), {kind_of(octree::leaf_of(color)), 0}});
    }

    void append(LeafList&& next) {
        for (CellIndex::Item& item : next.items)
            if (item.entry.kind == CellIndex::Kind::gray)
                item.entry.value += static_cast<std::uint32_t>(records.size());
        items.insert(items.end(), next.items.begin(), next.items.end());
        records.insert(records.end(), next.records.begin(), next.records.end());
        references += next.references;
    }

    std::vector<CellIndex::Item> items;
    std::vector<std::uint32_t> records;
    std::size_t references = 0;  ///< to facets, in all records

  private:
    static CellIndex::Kind kind_of(Node node) {
        return node == Node::gray    ? CellIndex::Kind::gray
               : node == Node::black ? CellIndex::Kind::black
                                     : CellIndex::Kind::white;
    }
};

/// Where surfaces lie beside each other like the pages of a book no splitting separates them: each of a thousand pages
/// runs through four octants, and down to cells that hold one alone leaves would hold a million references. So the
/// references are rationed. A cell is split when even the worst, all facets in all octants, is within its ration;
/// leaves take of it what they hold, and the rest goes to the other octants by their facets. Rations depend on the cell
/// alone, not on order or threads.
class InsideProblem {
  public:
    using Description = Share;
    using Workspace = LeafList::Workspace;
    using Output = LeafList;

    InsideProblem(std::span<const Facet> facets, const InsideOptions& options)
        : facets_(facets), options_(options) {}

    int depth() const { return options_.depth; }
    Workspace make_workspace() const { return {}; }
    Output make_output() const { return {}; }
    std::size_t weight(const Share& share) const { return share.range.size(); }

    octree::Restricted<Share> root(Workspace& workspace) const {
        const FacetRange range = classic::universe_facets(facets_, Touch::half_open, workspace.lists);
        const Share all{range, static_cast<std::uint64_t>(options_.references) * range.size()};
        return {rationed(node_of(range, workspace.lists.list(0, range)), all), all};
    }

    void restrict_to_children(const Cell& cell, const Share& share, Workspace& workspace,
                              octree::Children<Share>& children) const {
        const OctantFacets found =
            classic::find_octants<Touch::half_open>(facets_, cell, share.range, workspace.lists);
        const std::array<FacetRange, 8> ranges = distribute(cell, share.range, found, workspace.lists);
        std::uint64_t left = share.references, to_split = 0;
        for (std::size_t octant = 0; octant < 8; ++octant) {
            const FacetRange& range = ranges[octant];
            children[octant] = {node_of(range, workspace.lists.list(cell.level + 1, range)),
                                {range, range.size()}};
            if (children[octant].node == Node::split)
                to_split += range.size();
            else
                left -= range.size();
        }
        for (octree::Restricted<Share>& child : children) {
            if (child.node != Node::split) continue;
            const std::uint64_t facets = child.description.range.size();
            child.description.references =
                static_cast<std::uint64_t>(exact::uint128{left} * facets / to_split);
            child.node = rationed(child.node, child.description);
        }
    }

    Share transfer(const Cell& cell, const Share& share, const Workspace& from, Workspace& to) const {
        return {classic::transfer(cell, share.range, from.lists, to.lists), share.references};
    }

  private:
    /// What to make of a cell that holds these facets, if there are references for it.
    Node node_of(const FacetRange& range, std::span<const std::uint32_t> list) const {
        if (list.empty()) return range.winding > 0 ? Node::black : Node::white;
        const auto few = static_cast<std::size_t>(options_.leaf_facets);
        if (list.size() <= few) return Node::gray;
        // Splitting never separates facets that share a corner, and corners have six facets on average.
        return list.size() <= 4 * few && share_a_corner(list) ? Node::gray : Node::split;
    }

    static Node rationed(Node node, const Share& share) {
        return node == Node::split && share.references < 8 * std::uint64_t{share.range.size()} ? Node::gray
                                                                                               : node;
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

/// Numbers the facets in the order in which the records name them, and tells the records how far their facets reach.
template <class Array>
Array take_facets(LeafList& leaves, std::span<const Facet> facets) {
    constexpr std::uint32_t unnamed = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> number(facets.size(), unnamed);
    Array ordered;
    ordered.reserve(facets.size() + 1);
    for (const CellIndex::Item& item : leaves.items) {
        if (item.entry.kind != CellIndex::Kind::gray) continue;
        std::uint32_t* head = leaves.records.data() + item.entry.value;
        const std::size_t count = LeafRecord::at(head).facets.size();
        const Cell cell = Cell::of(item.key);
        std::int32_t extent = cell.side();
        for (std::uint32_t *reference = head + LeafRecord::head_words(*head), *end = reference + count;
             reference != end; ++reference) {
            const Facet& facet = facets[*reference];
            for (int axis = 0; axis < 3; ++axis) {
                const auto i = static_cast<std::size_t>(axis);
                extent = std::max({extent, cell.low[axis] - facet.low[i], facet.high[i] - cell.low[axis]});
            }
            if (number[*reference] == unnamed) {
                number[*reference] = static_cast<std::uint32_t>(ordered.size());
                ordered.push_back(facet.corner);
            }
            *reference = number[*reference];
        }
        LeafRecord::set_extent(*head, static_cast<std::uint32_t>(extent));
    }
    ordered.emplace_back();
    ordered.shrink_to_fit();
    return ordered;
}

}  // namespace

Result<InsideQuery> InsideQuery::build(const mesh::LatticeMesh& mesh, const InsideOptions& options,
                                       const Context& context) {
    if (options.depth < 0 || options.depth > octree::max_level || options.leaf_facets < 0 ||
        options.references < 1)
        return Error{
            ErrorCode::bad_input,
            "the depth of an inside query is 0 to 21, its leaves hold 0 facets or more, and there is a "
            "reference or more for each",
            {}};
    Result<std::vector<Facet>> facets = classic::facets_of(mesh);
    if (!facets) return facets.error();
    const std::vector<Facet> bare = bare_facets(mesh, *facets);
    if (const std::vector<classic::OpenEdge> open = classic::open_edges(mesh); !open.empty()) {
        if (options.open == classic::OpenPolicy::reject) return classic::open_surface_error(open);
        facets = classic::facets_of(classic::close_holes(mesh, open));
    }
    facets->insert(facets->end(), bare.begin(), bare.end());
    octree::DescentOptions descent;
    descent.phase = "inside";
    Result<LeafList> leaves = octree::descend(InsideProblem(*facets, options), context, descent);
    if (!leaves) return leaves.error();
    // Values of the index have 30 bits. A brick has six words and stands for a split cell of its own, of which there
    // are a seventh of the leaves; a leaf has one word and its record.
    if (leaves->records.size() + 2 * leaves->items.size() >= std::size_t{1} << 30)
        return Error{ErrorCode::limit, "the inside query has more leaves than it can number", {}};

    InsideQuery query;
    query.lattice_ = mesh.lattice;
    query.inverse_unit_ = 1 / mesh.lattice.unit();
    query.facets_ = take_facets<decltype(facets_)>(*leaves, *facets);
    query.cells_ = CellIndex(leaves->items, leaves->records);
    query.reference_count_ = leaves->references;
    return query;
}

Result<InsideQuery> InsideQuery::build(const mesh::Mesh& mesh, const InsideOptions& options,
                                       const Context& context) {
    const Result<mesh::Snapped> snapped = mesh::snap(mesh);
    if (!snapped) return snapped.error();
    return build(snapped->mesh, options, context);
}

}  // namespace octavo::query
