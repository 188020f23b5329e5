// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/boolean/t_junctions.hpp>

namespace octavo::boolean {
namespace {

/// Edges on which vertices lie, and the sums of the winding changes of the facets at them.
class EdgeSums {
  public:
    explicit EdgeSums(const NearContacts& near) {
        for (const NearContacts::OnEdge& on : near.on_edge)  // sorted by edge
            if (on.exact && (edges_.empty() || edges_.back() != on.edge)) edges_.push_back(on.edge);
        sums_.resize(edges_.size());
    }
    bool empty() const { return edges_.empty(); }

    void add_facets(const Soup& soup) {
        std::vector<char> has_edge(soup.points.size(), 0);
        for (const Edge& edge : edges_) has_edge[edge.low] = 1;
        for (std::uint32_t facet = 0; facet < soup.facets.size(); ++facet)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t from = soup.facets[facet][k], to = soup.facets[facet][(k + 1) % 3];
                if (!has_edge[std::min(from, to)]) continue;
                if (TransitionSum* const sum = find({from, to}))
                    sum->add(soup.transitions.of(soup.transition[facet]), from < to ? 1 : -1);
            }
    }

    bool cancel_at(const Edge& edge) { return find(edge)->normalised().empty(); }

  private:
    TransitionSum* find(const Edge& edge) {
        const auto at = std::lower_bound(edges_.begin(), edges_.end(), edge);
        return at != edges_.end() && *at == edge ? &sums_[static_cast<std::size_t>(at - edges_.begin())]
                                                 : nullptr;
    }

    std::vector<Edge> edges_;  ///< sorted
    std::vector<TransitionSum> sums_;
};

}  // namespace

NearContacts find_t_junctions(const Soup& soup, const NearContacts& near) {
    NearContacts junctions;
    EdgeSums sums(near);
    if (sums.empty()) return junctions;
    sums.add_facets(soup);
    for (const NearContacts::OnEdge& on : near.on_edge)
        if (on.exact && !sums.cancel_at(on.edge)) junctions.on_edge.push_back({on.edge, on.vertex, false});
    return junctions;
}

}  // namespace octavo::boolean
