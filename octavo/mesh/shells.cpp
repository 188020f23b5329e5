// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include <octavo/exact/orient.hpp>
#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/repeats.hpp>
#include <octavo/mesh/shells.hpp>
#include <octavo/mesh/windings_beside.hpp>

namespace octavo::mesh {
namespace {

using exact::int128;
using exact::Point;

/// Twenty-six bits an axis.
struct Box {
    std::array<std::int32_t, 3> low{exact::universe_side, exact::universe_side, exact::universe_side};
    std::array<std::int32_t, 3> high{};
    void add(Point p) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            low[i] = std::min(low[i], p[axis]);
            high[i] = std::max(high[i], p[axis]);
        }
    }
    int128 volume() const {
        int128 product = 1;
        for (std::size_t i = 0; i < 3; ++i) product *= std::max(high[i] - low[i], 0);
        return product;
    }
};

class ShellSearch {
  public:
    ShellSearch(std::span<const Point> points, std::span<const Triangle> triangles, const EdgeTable& edges)
        : points_(points), triangles_(triangles), edges_(edges) {}

    Shells run() {
        gather();
        wind_by_volume();
        if (std::any_of(found_.shells.begin(), found_.shells.end(), is_patched)) wind_by_patches();
        order_by_size();
        if (found_.by_size.size() > 1) find_enclosures();
        return std::move(found_);
    }

  private:
    void gather();
    static bool is_patched(const Shell& shell) { return shell.closed && shell.crowded; }
    void wind_by_volume();
    void wind_by_patches();
    std::vector<bool> tell_repeated_facets_apart();
    void order_by_size();
    std::vector<FaceIndex> first_facets() const;
    void find_enclosures();

    std::array<Point, 3> corners(FaceIndex face) const {
        const Triangle& t = triangles_[face];
        return {points_[t[0]], points_[t[1]], points_[t[2]]};
    }
    bool is_flat(FaceIndex face) const {
        const auto [a, b, c] = corners(face);
        return exact::collinear(a, b, c);
    }
    /// Of the two facets, the one that comes first by the positions of its corners; no_index is none.
    FaceIndex first_of(FaceIndex a, FaceIndex b) const {
        if (a == no_index || b == no_index) return std::min(a, b);
        std::array<Point, 3> p = corners(a), q = corners(b);
        const Point first = std::min({p[0], p[1], p[2]}), second = std::min({q[0], q[1], q[2]});
        if (first != second) return first < second ? a : b;
        std::sort(p.begin(), p.end());
        std::sort(q.begin(), q.end());
        return q < p ? b : a;
    }
    bool is_closed(FaceIndex face) const {
        return found_.of_face[face] != no_index && found_.shells[found_.of_face[face]].closed;
    }

    std::span<const Point> points_;
    std::span<const Triangle> triangles_;
    const EdgeTable& edges_;
    Shells found_;
    std::vector<Box> boxes_;  ///< of shells
};

void ShellSearch::gather() {
    const Components components = components_by_edge(edges_, triangles_.size());
    std::vector<bool> balanced(edges_.size()), crowded(edges_.size());
    for (EdgeIndex edge = 0; edge < edges_.size(); ++edge) {
        int balance = 0;
        for (const SideIndex side : edges_.sides_of(edge)) balance += runs_upward(triangles_, side) ? 1 : -1;
        balanced[edge] = balance == 0;
        crowded[edge] = edges_.sides_of(edge).size() > 2;
    }
    std::vector<std::uint32_t> number(components.count, no_index);
    found_.of_face.assign(triangles_.size(), no_index);
    for (FaceIndex face = 0; face < triangles_.size(); ++face) {
        if (edges_.edge_of_side[std::size_t{3} * face] == no_index) continue;
        std::uint32_t& shell = number[components.of_face[face]];
        if (shell == no_index) {
            shell = static_cast<std::uint32_t>(found_.shells.size());
            found_.shells.emplace_back().closed = true;
            boxes_.emplace_back();
        }
        found_.of_face[face] = shell;
        Shell& s = found_.shells[shell];
        ++s.faces;
        s.volume6 += exact_volume6(points_, triangles_.subspan(face, 1));
        for (const Point corner : corners(face)) boxes_[shell].add(corner);
        for (std::size_t k = 0; k < 3; ++k) {
            const EdgeIndex edge = edges_.edge_of_side[std::size_t{3} * face + k];
            s.closed = s.closed && balanced[edge];
            s.crowded = s.crowded || crowded[edge];
        }
    }
}

void ShellSearch::wind_by_volume() {
    for (Shell& shell : found_.shells) {
        if (!shell.closed) continue;
        shell.lowest = shell.volume6 < 0 ? -1 : 0;
        shell.highest = shell.volume6 > 0 ? 1 : 0;
    }
    found_.in_front.assign(triangles_.size(), 0);
    for (FaceIndex face = 0; face < triangles_.size(); ++face)
        if (is_closed(face)) found_.in_front[face] = found_.shells[found_.of_face[face]].lowest;
}

void ShellSearch::wind_by_patches() {
    const Components patches = components_by_plain_edge(edges_, triangles_.size());
    std::vector<std::uint32_t> asking(triangles_.size(), no_index);  // the shell, if it is crowded
    std::vector<FaceIndex> sample(patches.count, no_index);
    for (FaceIndex face = 0; face < triangles_.size(); ++face) {
        const std::uint32_t shell = found_.of_face[face];
        if (shell == no_index || !is_patched(found_.shells[shell])) continue;
        asking[face] = shell;
        found_.in_front[face] = 0;
        FaceIndex& first = sample[patches.of_face[face]];
        if (!is_flat(face)) first = first_of(first, face);
    }
    std::vector<PlaceBeside> places;
    for (const FaceIndex face : sample)
        if (face != no_index) places.push_back({face, false});
    std::vector<std::int32_t> of_patch(patches.count, 0);
    for (const PlaceWinding& found : windings_beside(points_, triangles_, asking, places, Winders::own))
        of_patch[patches.of_face[places[found.place].face]] = found.winding;
    for (FaceIndex face = 0; face < triangles_.size(); ++face)
        if (asking[face] != no_index) found_.in_front[face] = of_patch[patches.of_face[face]];
    const std::vector<bool> cancels = tell_repeated_facets_apart();

    for (Shell& shell : found_.shells)
        if (is_patched(shell)) shell.lowest = shell.highest = 0;
    for (FaceIndex face = 0; face < triangles_.size(); ++face) {
        if (asking[face] == no_index || is_flat(face)) continue;
        Shell& shell = found_.shells[asking[face]];
        const std::int32_t front = found_.in_front[face], behind = cancels[face] ? front : front + 1;
        shell.lowest = std::min(shell.lowest, front);
        shell.highest = std::max(shell.highest, behind);
    }
}

/// All facets on the same corners have been told what is in front of all of them. Lays them one behind the other, those
/// that face each other last, which cancel and are marked.
std::vector<bool> ShellSearch::tell_repeated_facets_apart() {
    std::vector<bool> cancels(triangles_.size());
    for (const std::vector<FaceIndex>& group : groups_of_repeated_facets(triangles_, edges_)) {
        if (!is_patched(found_.shells[found_.of_face[group[0]]])) continue;
        std::vector<FaceIndex> more, fewer;
        for (const FaceIndex face : group) (is_ascending(triangles_[face]) ? more : fewer).push_back(face);
        if (more.size() < fewer.size()) std::swap(more, fewer);
        const std::size_t left = more.size() - fewer.size();
        const std::int32_t front = found_.in_front[more[0]], behind = front + static_cast<std::int32_t>(left);
        for (std::size_t i = 0; i < more.size(); ++i) {
            found_.in_front[more[i]] = i < left ? front + static_cast<std::int32_t>(i) : behind;
            cancels[more[i]] = i >= left;
        }
        for (const FaceIndex face : fewer) {
            found_.in_front[face] = behind;
            cancels[face] = true;
        }
    }
    return cancels;
}

void ShellSearch::order_by_size() {
    for (std::uint32_t shell = 0; shell < found_.shells.size(); ++shell)
        if (found_.shells[shell].closed) found_.by_size.push_back(shell);
    const auto magnitude = [&](std::uint32_t shell) {
        const int128 volume = found_.shells[shell].volume6;
        return volume < 0 ? -volume : volume;
    };
    std::stable_sort(found_.by_size.begin(), found_.by_size.end(), [&](std::uint32_t a, std::uint32_t b) {
        const int128 p = boxes_[a].volume(), q = boxes_[b].volume();
        return p != q ? p > q : magnitude(a) > magnitude(b);
    });
}

/// Of each closed shell the facet that is asked; no_index where none has area.
std::vector<FaceIndex> ShellSearch::first_facets() const {
    std::vector<FaceIndex> first(found_.shells.size(), no_index);
    for (FaceIndex face = 0; face < triangles_.size(); ++face) {
        if (!is_closed(face) || is_flat(face)) continue;
        FaceIndex& of_shell = first[found_.of_face[face]];
        of_shell = first_of(of_shell, face);
    }
    return first;
}

void ShellSearch::find_enclosures() {
    std::vector<std::uint32_t> closed(triangles_.size(), no_index);
    for (FaceIndex face = 0; face < triangles_.size(); ++face)
        if (is_closed(face)) closed[face] = found_.of_face[face];
    const std::vector<FaceIndex> asked = first_facets();
    std::vector<PlaceBeside> places;
    for (const std::uint32_t shell : found_.by_size) {
        const FaceIndex face = asked[shell];
        // Inside is where the shell winds more often, this way or that.
        if (face != no_index) places.push_back({face, found_.in_front[face] >= 0});
    }
    std::vector<std::uint32_t> rank(found_.shells.size());
    for (std::uint32_t i = 0; i < found_.by_size.size(); ++i) rank[found_.by_size[i]] = i;
    for (const PlaceWinding& found : windings_beside(points_, triangles_, closed, places, Winders::others)) {
        const std::uint32_t asking = closed[places[found.place].face];
        if (rank[found.shell] < rank[asking])
            found_.shells[asking].enclosures.push_back({found.shell, found.winding});
    }
}

}  // namespace

Shells find_shells(std::span<const Point> points, std::span<const Triangle> triangles,
                   const EdgeTable& edges) {
    return ShellSearch(points, triangles, edges).run();
}

}  // namespace octavo::mesh
