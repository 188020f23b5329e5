// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <limits>

#include <octavo/classic/facet_lists.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/query/inside.hpp>

// Building the inside query: the descent of the classic octree, whose leaves, which come in Morton order, become records
// and items of the index.

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

/// The leaves in Morton order; those of gray ones with their records.
class LeafList {
  public:
    struct Workspace {
        FacetLists lists;
    };

    void split(const Cell&, const FacetRange&, const Workspace&) {}

    void leaf(const Cell& cell, const octree::Restricted<FacetRange>& leaf, const Workspace& workspace) {
        CellIndex::Item item{cell.key(), {kind_of(leaf.node), 0}};
        if (leaf.node == Node::gray)
            item.entry.value = static_cast<std::uint32_t>(
                LeafRecord::append(records, cell.level, leaf.description.winding,
                                   workspace.lists.list(cell.level, leaf.description)));
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
    }

    std::vector<CellIndex::Item> items;
    std::vector<std::uint32_t> records;

  private:
    static CellIndex::Kind kind_of(Node node) {
        return node == Node::gray    ? CellIndex::Kind::gray
               : node == Node::black ? CellIndex::Kind::black
                                     : CellIndex::Kind::white;
    }
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
        return {node_of(Cell::root(), range, workspace.lists.list(0, range)), range};
    }

    void restrict_to_children(const Cell& cell, const FacetRange& range, Workspace& workspace,
                              octree::Children<FacetRange>& children) const {
        const OctantFacets found =
            classic::find_octants<Touch::half_open>(facets_, cell, range, workspace.lists);
        const std::array<FacetRange, 8> ranges = distribute(cell, range, found, workspace.lists);
        for (std::size_t octant = 0; octant < 8; ++octant) {
            const std::span<const std::uint32_t> list = workspace.lists.list(cell.level + 1, ranges[octant]);
            children[octant] = {node_of(cell.child(static_cast<int>(octant)), ranges[octant], list),
                                ranges[octant]};
        }
    }

    FacetRange transfer(const Cell& cell, const FacetRange& range, const Workspace& from,
                        Workspace& to) const {
        return classic::transfer(cell, range, from.lists, to.lists);
    }

  private:
    Node node_of(const Cell& cell, const FacetRange& range, std::span<const std::uint32_t> list) const {
        if (list.empty()) return range.winding > 0 ? Node::black : Node::white;
        const auto few = static_cast<std::size_t>(options_.leaf_facets);
        if (list.size() <= few) return Node::gray;
        // Splitting never separates facets that share a corner, and corners have six facets on average.
        if (list.size() <= 4 * few && share_a_corner(list)) return Node::gray;
        // Slivers side by side: four octants get half of them each, so that splitting doubles what it lists. Of a cylinder of
        // 10 000 sides this leaves 1.1 kB a facet; to the last level it is more leaves than can be numbered.
        return list.size() <= 16 * few && long_ones(cell, list) + few >= list.size() ? Node::gray
                                                                                     : Node::split;
    }

    /// How many of the facets are far longer than the cell.
    std::size_t long_ones(const Cell& cell, std::span<const std::uint32_t> list) const {
        const std::int64_t far = 16 * std::int64_t{cell.side()};
        return static_cast<std::size_t>(std::count_if(list.begin(), list.end(), [&](std::uint32_t index) {
            const Facet& facet = facets_[index];
            std::int64_t extent = 0;
            for (std::size_t axis = 0; axis < 3; ++axis)
                extent = std::max(extent, std::int64_t{facet.high[axis]} - facet.low[axis]);
            return extent >= far;
        }));
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
    // Values of the index have 30 bits. A brick has six words and stands for a split cell of its own, of which there are a
    // seventh of the leaves; a leaf has one word and its record.
    if (leaves->records.size() + 2 * leaves->items.size() >= std::size_t{1} << 30)
        return Error{ErrorCode::limit, "the inside query has more leaves than it can number", {}};

    InsideQuery query;
    query.lattice_ = mesh.lattice;
    query.inverse_unit_ = 1 / mesh.lattice.unit();
    query.facets_ = take_facets<decltype(facets_)>(*leaves, *facets);
    query.cells_ = CellIndex(leaves->items, leaves->records);
    return query;
}

Result<InsideQuery> InsideQuery::build(const mesh::Mesh& mesh, const InsideOptions& options,
                                       const Context& context) {
    const Result<mesh::Snapped> snapped = mesh::snap(mesh);
    if (!snapped) return snapped.error();
    return build(snapped->mesh, options, context);
}

}  // namespace octavo::query
