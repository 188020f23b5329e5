// SPDX-License-Identifier: Apache-2.0
// A needle is a facet without area: its middle vertex lies on its long side. The long side is flipped with the facet
// beyond it, which is cut from the middle to its apex, so that both have area. A needle beyond a needle has to wait for
// that one to be flipped, so flips run along chains: neighbours are kept up to date, and what borders on a flip is
// looked at again. Each flip leaves one needle less; linear but for a search and a set a flip.
#include <algorithm>
#include <array>
#include <set>

#include <octavo/mesh/collinear.hpp>
#include <octavo/mesh/repair_steps.hpp>
#include <octavo/mesh/topology.hpp>

namespace octavo::mesh {
namespace {

using Ends = std::array<VertexIndex, 2>;

Ends ends_of(VertexIndex a, VertexIndex b) { return {std::min(a, b), std::max(a, b)}; }

/// The side between the lexicographic ends of a facet without area: the one that holds the opposite vertex.
std::uint32_t long_side(const RepairSoup& soup, const Triangle& t) {
    const auto less = [&](std::size_t i, std::size_t j) {
        const Vec3 p = soup.vertices[t[i]], q = soup.vertices[t[j]];
        return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : p.z < q.z;
    };
    for (std::uint32_t middle = 0; middle < 3; ++middle) {
        const std::uint32_t i = (middle + 1) % 3, j = (middle + 2) % 3;
        if ((less(i, middle) && less(middle, j)) || (less(j, middle) && less(middle, i))) return i;
    }
    return 0;  // two corners at one place: welding has left none
}

class NeedleFlips {
  public:
    explicit NeedleFlips(RepairSoup& soup)
        : soup_(soup), edges_(build_edges(soup.triangles, soup.vertices.size())) {
        opposite_.assign(3 * soup.triangles.size(), no_index);
        for (EdgeIndex edge = 0; edge < edges_.size(); ++edge)
            if (const auto sides = edges_.sides_of(edge); sides.size() == 2) join(sides[0], sides[1]);
        for (const Triangle& t : soup.triangles)
            is_needle_.push_back(collinear(soup.vertices[t[0]], soup.vertices[t[1]], soup.vertices[t[2]]));
    }

    RepairDone run() {
        for (FaceIndex face = 0; face < soup_.triangles.size(); ++face) {
            waiting_.push_back(face);
            while (!waiting_.empty()) {
                const FaceIndex next = waiting_.back();
                waiting_.pop_back();
                if (is_needle_[next]) flip(next);
            }
        }
        return std::move(done_);
    }

  private:
    void join(SideIndex a, SideIndex b) {
        opposite_[a] = b;
        if (b != no_index) opposite_[b] = a;
    }

    /// The side of the facet between two of its vertices.
    SideIndex side_between(FaceIndex face, VertexIndex a, VertexIndex b) const {
        for (SideIndex side = 3 * face; side < 3 * face + 2; ++side)
            if (ends_of(start(side), start(next_side(side))) == ends_of(a, b)) return side;
        return 3 * face + 2;
    }
    VertexIndex start(SideIndex side) const { return soup_.triangles[side / 3][side % 3]; }

    /// Edges that flips took away still count: a later round sees that they have gone.
    bool may_be_edge(const Ends& ends) const {
        return added_.contains(ends) || std::binary_search(edges_.ends.begin(), edges_.ends.end(), ends);
    }

    /// Flips the needle if the facet beyond its long side has area and the new edge is new.
    void flip(FaceIndex needle) {
        const SideIndex side = 3 * needle + long_side(soup_, soup_.triangles[needle]);
        const SideIndex other = opposite_[side];
        if (other == no_index || is_needle_[other / 3]) return;
        const FaceIndex neighbour = other / 3;
        const VertexIndex middle = start(next_side(next_side(side))),
                          apex = start(next_side(next_side(other)));
        if (middle == apex || may_be_edge(ends_of(middle, apex))) return;
        // The neighbour runs from → to along the side and on to its apex; it is cut from there to the middle.
        const VertexIndex from = start(other), to = start(next_side(other));
        const SideIndex before_middle = opposite_[side_between(needle, from, middle)];
        const SideIndex after_middle = opposite_[side_between(needle, middle, to)];
        const SideIndex to_apex = opposite_[next_side(other)];
        const SideIndex from_apex = opposite_[next_side(next_side(other))];
        soup_.triangles[neighbour] = {from, middle, apex};
        soup_.triangles[needle] = {middle, to, apex};
        join(3 * neighbour, before_middle);
        join(3 * neighbour + 1, 3 * needle + 2);
        join(3 * neighbour + 2, from_apex);
        join(3 * needle, after_middle);
        join(3 * needle + 1, to_apex);
        added_.insert(ends_of(middle, apex));
        is_needle_[needle] = false;
        ++done_.count;
        done_.faces.push_back(soup_.origin[needle]);
        for (const SideIndex beyond : {to_apex, from_apex, after_middle, before_middle})
            if (beyond != no_index) waiting_.push_back(beyond / 3);
    }

    RepairSoup& soup_;
    const EdgeTable edges_;            ///< as they were before the first flip
    std::set<Ends> added_;             ///< edges by flips
    std::vector<SideIndex> opposite_;  ///< by side, the other one of its edge; no_index unless there are two
    std::vector<bool> is_needle_;      ///< by facet
    std::vector<FaceIndex> waiting_;   ///< to be looked at, the next one last
    RepairDone done_;
};

}  // namespace

RepairDone flip_needles(RepairSoup& soup) {
    RepairDone done;
    // Another round finds only needles whose new edge was there until a flip took it away.
    for (;;) {
        const RepairDone round = NeedleFlips(soup).run();
        if (round.count == 0) return done;
        done.count += round.count;
        done.faces.insert(done.faces.end(), round.faces.begin(), round.faces.end());
    }
}

}  // namespace octavo::mesh
