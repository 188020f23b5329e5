// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include <octavo/base/parallel.hpp>
#include <octavo/boolean/chunk_offsets.hpp>
#include <octavo/boolean/contacts.hpp>
#include <octavo/exact/intersect.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/exact/plane.hpp>

namespace octavo::boolean {
namespace {

using exact::int128;
using exact::Plane;
using exact::Point;
using exact::Sign;

/// A vertex, or the point that the next of the edge points stands for.
inline constexpr std::uint32_t edge_point = no_index;

struct Crossing {
    std::uint32_t first, second;
    std::uint32_t count;
    std::array<std::uint32_t, 4> ends;  ///< vertex or `edge_point`
};

/// A vertex of one face on the border of a coplanar one.
struct Touch {
    std::uint32_t face, other, vertex;
};

/// What one task finds; ids of constructed points are given later, in the order of the tasks.
struct Found {
    std::vector<Crossing> crossings;
    std::vector<exact::EdgePoint> edge_points;
    std::vector<Overlap> overlaps;
    std::vector<Touch> touches;
};

struct Face {
    std::uint32_t id;
    int count;
    std::array<std::uint32_t, 4> corner;
    std::array<Point, 4> point;

    int next(int k) const { return k + 1 == count ? 0 : k + 1; }
    Plane plane() const { return Plane::through(point[0], point[1], point[2]); }
    bool has_corner(std::uint32_t vertex) const {
        return std::find(corner.begin(), corner.begin() + count, vertex) != corner.begin() + count;
    }
    /// Whether two of its corners are opposite to each other.
    bool is_diagonal(std::uint32_t a, std::uint32_t b) const {
        return count == 4 && ((corner[0] == a && corner[2] == b) || (corner[2] == a && corner[0] == b) ||
                              (corner[1] == a && corner[3] == b) || (corner[3] == a && corner[1] == b));
    }
};

Face load(const Soup& soup, const Faces& faces, std::uint32_t id) {
    const Faces::Corners corners = faces.corners(soup, id);
    Face face{id, static_cast<int>(corners.count), corners.vertex, {}};
    for (int k = 0; k < face.count; ++k) face.point[k] = soup.points[face.corner[k]];
    return face;
}

/// Whether a point of the face's plane lies in the closed face.
bool holds(const Face& face, const Plane& plane, Point point) {
    const int axis = plane.dominant_axis();
    const Sign up = exact::sign_of(plane.normal(axis));
    for (int k = 0; k < face.count; ++k)
        if (exact::orient2d(axis, face.point[k], face.point[face.next(k)], point) == -up) return false;
    return true;
}

/// Whether the line from p to q, which crosses the plane of the face, meets the closed face.
bool pierced(const Face& face, Point p, Point q) {
    bool positive = false, negative = false;
    for (int k = 0; k < face.count; ++k) {
        const Sign side = exact::orient3d(p, q, face.point[k], face.point[face.next(k)]);
        positive = positive || side == Sign::positive;
        negative = negative || side == Sign::negative;
        if (positive && negative) return false;
    }
    return true;
}

/// Of the corners of a face on a plane.
using Values = std::array<int128, 4>;

/// Adds the corners and edges of `face` that meet `other`, given the corners' values on the plane of `other`.
void add_ends(const Face& face, const Values& value, const Face& other, const Plane& plane,
              Crossing& crossing, Found& found) {
    for (int k = 0; k < face.count; ++k) {
        const int next = face.next(k);
        if (value[k] == 0) {
            const std::uint32_t vertex = face.corner[k];
            bool known = false;
            for (std::uint32_t i = 0; i < crossing.count; ++i) known = known || crossing.ends[i] == vertex;
            if (!known && (other.has_corner(vertex) || holds(other, plane, face.point[k])))
                crossing.ends[crossing.count++] = vertex;
        } else if ((value[k] > 0 && value[next] < 0) || (value[k] < 0 && value[next] > 0)) {
            // Named from the lower vertex, so that both faces of the edge construct the same numbers.
            const bool up = face.corner[k] < face.corner[next];
            const int low = up ? k : next, high = up ? next : k;
            if (!pierced(other, face.point[low], face.point[high])) continue;
            crossing.ends[crossing.count++] = edge_point;
            found.edge_points.push_back(
                exact::intersect_edge(face.point[low], face.point[high], value[low], value[high]));
        }
    }
}

/// Whether an edge of `face` has all of the coplanar `other` on its outer side; `up` is the sign of turn of `face`.
bool edge_separates(const Face& face, Sign up, const Face& other, int axis) {
    for (int k = 0; k < face.count; ++k) {
        bool outside = true;
        for (int corner = 0; corner < other.count && outside; ++corner)
            outside =
                exact::orient2d(axis, face.point[k], face.point[face.next(k)], other.point[corner]) != up;
        if (outside) return true;
    }
    return false;
}

void add_touches(const Face& face, const Face& other, const Plane& plane, Found& found) {
    for (int k = 0; k < face.count; ++k)
        if (!other.has_corner(face.corner[k]) && holds(other, plane, face.point[k]))
            found.touches.push_back({other.id, face.id, face.corner[k]});
}

void meet_coplanar(const Face& first, const Plane& first_plane, const Face& second, const Plane& second_plane,
                   Found& found) {
    const int axis = first_plane.dominant_axis();
    const bool apart = edge_separates(first, exact::sign_of(first_plane.normal(axis)), second, axis) ||
                       edge_separates(second, exact::sign_of(second_plane.normal(axis)), first, axis);
    if (!apart) {
        found.overlaps.push_back({first.id, second.id});
        return;
    }
    add_touches(first, second, second_plane, found);
    add_touches(second, first, first_plane, found);
}

/// Which sides of a plane the corners of a face are on, those that it shares with another face aside.
struct Sides {
    bool front = false, on = false, back = false;
    bool any_one() const { return !on && front != back; }
};

Sides sides_of(const Face& face, const Values& value, unsigned shared) {
    Sides sides;
    for (int k = 0; k < face.count; ++k) {
        if (shared >> k & 1) continue;
        sides.front = sides.front || value[k] > 0;
        sides.on = sides.on || value[k] == 0;
        sides.back = sides.back || value[k] < 0;
    }
    return sides;
}

Values values_on(const Plane& plane, const Face& face) {
    Values values{};
    for (int k = 0; k < face.count; ++k) values[k] = plane.value_at(face.point[k]);
    return values;
}

/// The corners that two faces share, as bits.
struct Shared {
    unsigned first = 0, second = 0;
    int count = 0;
    std::uint32_t vertex[4];
};

Shared shared_corners(const Face& first, const Face& second) {
    Shared shared;
    for (int i = 0; i < first.count; ++i)
        for (int j = 0; j < second.count; ++j)
            if (first.corner[i] == second.corner[j]) {
                shared.first |= 1u << i, shared.second |= 1u << j;
                shared.vertex[shared.count++] = first.corner[i];
            }
    return shared;
}

void meet(const Face& first, const Face& second, Found& found) {
    const Shared shared = shared_corners(first, second);
    const Plane first_plane = first.plane();
    const Values second_value = values_on(first_plane, second);
    // A shared corner is all that they have in common where all others are on one side.
    if (shared.count < 2 && sides_of(second, second_value, shared.second).any_one()) return;
    const Sides all = sides_of(second, second_value, 0);
    const bool coplanar = !all.front && !all.back;
    // With a common edge and different planes, the edge is all that they have in common; a common diagonal of one is
    // where the other cuts it.
    if (shared.count == 2 && !coplanar && !first.is_diagonal(shared.vertex[0], shared.vertex[1]) &&
        !second.is_diagonal(shared.vertex[0], shared.vertex[1]))
        return;
    const Plane second_plane = second.plane();
    if (coplanar) {
        meet_coplanar(first, first_plane, second, second_plane, found);
        return;
    }
    const Values first_value = values_on(second_plane, first);
    if (shared.count < 2 && sides_of(first, first_value, shared.first).any_one()) return;

    Crossing crossing{first.id, second.id, 0, {}};
    add_ends(first, first_value, second, second_plane, crossing, found);
    add_ends(second, second_value, first, first_plane, crossing, found);
    if (crossing.count > 0) found.crossings.push_back(crossing);
}

/// Gives ids to the points of a task and writes its cuts.
void name_points(const Found& found, std::span<const PointTable::Place> places, const Soup& soup,
                 PointTable& points, Contacts& contacts) {
    std::size_t next = 0;
    // A corner, or an edge, of a face is no cut in it.
    const auto add = [&](std::uint32_t id, std::uint32_t other, PointId from, PointId to) {
        if (points.is_vertex(from) && points.is_vertex(to)) {
            const Face face = load(soup, contacts.faces, id);
            if (face.has_corner(from) && face.has_corner(to) && !face.is_diagonal(from, to)) return;
        }
        contacts.cuts.push_back({id, other, from, to});
    };
    for (const Crossing& crossing : found.crossings) {
        PointId ends[2] = {no_index, no_index};
        for (std::uint32_t i = 0; i < crossing.count; ++i) {
            PointId id = crossing.ends[i];
            if (id == edge_point) id = points.add(found.edge_points[next], places[next]), ++next;
            if (ends[0] == no_index || ends[0] == id)
                ends[0] = id;
            else if (ends[1] == no_index || ends[1] == id)
                ends[1] = id;
            else
                OCTAVO_CHECK(false, "two faces that are not coplanar meet in more than a segment");
        }
        if (ends[1] == no_index) ends[1] = ends[0];
        add(crossing.first, crossing.second, ends[0], ends[1]);
        add(crossing.second, crossing.first, ends[0], ends[1]);
    }
    for (const Touch& touch : found.touches) add(touch.face, touch.other, touch.vertex, touch.vertex);
    contacts.overlaps.insert(contacts.overlaps.end(), found.overlaps.begin(), found.overlaps.end());
}

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Pairs find_near(const Soup& soup, const FacetTree& tree, const Context& context) {
    // Few tasks for small jobs; for large ones enough that two uneven halves do not matter.
    const std::vector<FacetTree::Task> tasks = tree.pair_tasks(soup.facets.size() < 2000 ? 1 : 256);
    std::vector<Pairs> found(tasks.size());
    parallel_chunks(context, tasks.size(), 1, [&](std::size_t task, std::size_t) {
        tree.for_each_pair(tasks[task], [&](std::uint32_t a, std::uint32_t b) {
            found[task].push_back({a, b});
        });
    });
    Pairs near;
    for (Pairs& part : found) {
        near.insert(near.end(), part.begin(), part.end());
        part = {};
    }
    return near;
}

/// The pairs of faces that pairs of facets belong to, each once.
Pairs pairs_of_faces(std::size_t facets, const Faces& faces, const Pairs& near, const Context& context) {
    const auto for_each = [&](const auto& visit) {
        for (const auto& [first, second] : near) {
            const std::uint32_t a = faces.of(first), b = faces.of(second);
            if (a != b) visit(std::min(a, b), std::max(a, b));
        }
    };
    std::vector<std::uint32_t> begin(facets, 0);
    for_each([&](std::uint32_t low, std::uint32_t) { ++begin[low]; });
    make_offsets(begin);
    Pairs pairs(begin.back());
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
    for_each([&](std::uint32_t low, std::uint32_t high) { pairs[next[low]++] = {low, high}; });
    parallel_chunks(context, facets, 1 << 10, [&](std::size_t first, std::size_t last) {
        for (std::size_t face = first; face < last; ++face)
            std::sort(pairs.begin() + begin[face], pairs.begin() + begin[face + 1]);
    });
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

}  // namespace

Contacts find_contacts(const Soup& soup, const FacetTree& tree, PointTable& points, const Context& context) {
    Contacts contacts;
    contacts.near = find_near(soup, tree, context);
    if (context.cancelled()) return contacts;
    contacts.faces = Faces(soup, contacts.near, context);
    const bool joined = contacts.faces.any_joined();
    const Pairs pairs =
        joined ? pairs_of_faces(soup.facets.size(), contacts.faces, contacts.near, context) : Pairs();
    const Pairs& all = joined ? pairs : contacts.near;

    constexpr std::size_t grain = 1 << 10;
    std::vector<Found> found(all.size() / grain + 1);
    parallel_chunks(context, all.size(), grain, [&](std::size_t begin, std::size_t end) {
        Face first{no_index, 0, {}, {}};
        for (std::size_t i = begin; i < end; ++i) {
            if (first.id != all[i].first) first = load(soup, contacts.faces, all[i].first);
            meet(first, load(soup, contacts.faces, all[i].second), found[begin / grain]);
        }
    });
    std::size_t edge_points = 0, cuts = 0;
    for (const Found& part : found)
        edge_points += part.edge_points.size(), cuts += 2 * part.crossings.size() + part.touches.size();
    points.reserve(edge_points / 2);  // an edge is that of two faces
    contacts.cuts.reserve(cuts);
    std::vector<std::span<const exact::EdgePoint>> lists;
    for (const Found& part : found) lists.push_back(part.edge_points);
    std::vector<std::vector<PointTable::Place>> places = points.places<exact::EdgePoint>(lists, context);
    if (context.cancelled()) return contacts;
    for (std::size_t i = 0; i < found.size(); ++i) {
        name_points(found[i], places[i], soup, points, contacts);
        found[i] = {};
        places[i] = {};
    }
    return contacts;
}

}  // namespace octavo::boolean
