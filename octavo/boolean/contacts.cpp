// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <octavo/base/parallel.hpp>
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

/// A vertex of one facet on the border of a coplanar one.
struct Touch {
    std::uint32_t facet, other, vertex;
};

/// What one task finds; ids of constructed points are given later, in the order of the tasks.
struct Found {
    std::vector<Crossing> crossings;
    std::vector<exact::EdgePoint> edge_points;
    std::vector<Overlap> overlaps;
    std::vector<Touch> touches;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> near;
};

struct Facet {
    std::uint32_t id;
    mesh::Triangle corner;
    std::array<Point, 3> point;
};

Facet load(const Soup& soup, std::uint32_t id) {
    const mesh::Triangle& corner = soup.facets[id];
    return {id, corner, {soup.points[corner[0]], soup.points[corner[1]], soup.points[corner[2]]}};
}

bool has_corner(const Facet& facet, std::uint32_t vertex) {
    return facet.corner[0] == vertex || facet.corner[1] == vertex || facet.corner[2] == vertex;
}

/// Whether a point of the facet's plane lies in the closed facet.
bool holds(const Facet& facet, const Plane& plane, Point point) {
    const int axis = plane.dominant_axis();
    const Sign up = exact::sign_of(plane.normal(axis));
    for (int k = 0; k < 3; ++k)
        if (exact::orient2d(axis, facet.point[k], facet.point[(k + 1) % 3], point) == -up) return false;
    return true;
}

/// Whether the line from p to q, which crosses the plane of the facet, meets the closed facet.
bool pierced(const Facet& facet, Point p, Point q) {
    bool positive = false, negative = false;
    for (int k = 0; k < 3; ++k) {
        const Sign side = exact::orient3d(p, q, facet.point[k], facet.point[(k + 1) % 3]);
        positive = positive || side == Sign::positive;
        negative = negative || side == Sign::negative;
    }
    return !(positive && negative);
}

/// Adds the corners and edges of `facet` that meet `other`, given the corners' values on the plane of `other`.
void add_ends(const Facet& facet, const std::array<int128, 3>& value, const Facet& other, const Plane& plane,
              Crossing& crossing, Found& found) {
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        if (value[k] == 0) {
            const std::uint32_t vertex = facet.corner[k];
            bool known = false;
            for (std::uint32_t i = 0; i < crossing.count; ++i) known = known || crossing.ends[i] == vertex;
            if (!known && (has_corner(other, vertex) || holds(other, plane, facet.point[k])))
                crossing.ends[crossing.count++] = vertex;
        } else if ((value[k] > 0 && value[next] < 0) || (value[k] < 0 && value[next] > 0)) {
            // Named from the lower vertex, so that both facets of the edge construct the same numbers.
            const bool up = facet.corner[k] < facet.corner[next];
            const int low = up ? k : next, high = up ? next : k;
            if (!pierced(other, facet.point[low], facet.point[high])) continue;
            crossing.ends[crossing.count++] = edge_point;
            found.edge_points.push_back(
                exact::intersect_edge(facet.point[low], facet.point[high], value[low], value[high]));
        }
    }
}

/// Whether an edge of `facet` has all of the coplanar `other` on its outer side; `up` is the sign of turn of both.
bool edge_separates(const Facet& facet, Sign up, const Facet& other, int axis) {
    for (int k = 0; k < 3; ++k) {
        bool outside = true;
        for (int corner = 0; corner < 3 && outside; ++corner)
            outside =
                exact::orient2d(axis, facet.point[k], facet.point[(k + 1) % 3], other.point[corner]) != up;
        if (outside) return true;
    }
    return false;
}

void add_touches(const Facet& facet, const Facet& other, const Plane& plane, Found& found) {
    for (int k = 0; k < 3; ++k)
        if (!has_corner(other, facet.corner[k]) && holds(other, plane, facet.point[k]))
            found.touches.push_back({other.id, facet.id, facet.corner[k]});
}

void meet_coplanar(const Facet& first, const Plane& first_plane, const Facet& second,
                   const Plane& second_plane, Found& found) {
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

/// All on one side, none on the plane.
bool clear_of_plane(const std::array<int128, 3>& value) {
    return (value[0] > 0 && value[1] > 0 && value[2] > 0) || (value[0] < 0 && value[1] < 0 && value[2] < 0);
}

/// One corner on the plane, and it is the shared one; the others on one side.
bool only_shared_corner_on_plane(const std::array<int128, 3>& value, int shared) {
    const int a = (shared + 1) % 3, b = (shared + 2) % 3;
    return (value[a] > 0 && value[b] > 0) || (value[a] < 0 && value[b] < 0);
}

std::array<int128, 3> values_on(const Plane& plane, const Facet& facet) {
    return {plane.value_at(facet.point[0]), plane.value_at(facet.point[1]), plane.value_at(facet.point[2])};
}

void meet(const Facet& first, const Facet& second, Found& found) {
    found.near.push_back({first.id, second.id});
    int shared = 0, shared_first = 0, shared_second = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            if (first.corner[i] == second.corner[j]) ++shared, shared_first = i, shared_second = j;

    const Plane first_plane = Plane::through(first.point[0], first.point[1], first.point[2]);
    const std::array<int128, 3> second_value = values_on(first_plane, second);
    if (shared == 0 ? clear_of_plane(second_value)
                    : shared == 1 && only_shared_corner_on_plane(second_value, shared_second))
        return;
    const bool coplanar = second_value[0] == 0 && second_value[1] == 0 && second_value[2] == 0;
    // With a common edge and different planes, the edge is all that they have in common.
    if (shared == 2 && !coplanar) return;
    const Plane second_plane = Plane::through(second.point[0], second.point[1], second.point[2]);
    if (coplanar) {
        meet_coplanar(first, first_plane, second, second_plane, found);
        return;
    }
    const std::array<int128, 3> first_value = values_on(second_plane, first);
    if (shared == 0 ? clear_of_plane(first_value)
                    : shared == 1 && only_shared_corner_on_plane(first_value, shared_first))
        return;

    Crossing crossing{first.id, second.id, 0, {}};
    add_ends(first, first_value, second, second_plane, crossing, found);
    add_ends(second, second_value, first, first_plane, crossing, found);
    if (crossing.count > 0) found.crossings.push_back(crossing);
}

/// Gives ids to the points of a task and writes its cuts.
void name_points(const Found& found, const Soup& soup, PointTable& points, Contacts& contacts) {
    std::size_t next = 0;
    const auto is_corner = [&soup](std::uint32_t facet, PointId point) {
        const mesh::Triangle& corner = soup.facets[facet];
        return corner[0] == point || corner[1] == point || corner[2] == point;
    };
    const auto add = [&](std::uint32_t facet, std::uint32_t other, PointId from, PointId to) {
        if (!is_corner(facet, from) || !is_corner(facet, to))
            contacts.cuts.push_back({facet, other, from, to});
    };
    for (const Crossing& crossing : found.crossings) {
        PointId ends[2] = {no_index, no_index};
        for (std::uint32_t i = 0; i < crossing.count; ++i) {
            const PointId id =
                crossing.ends[i] == edge_point ? points.add(found.edge_points[next++]) : crossing.ends[i];
            if (ends[0] == no_index || ends[0] == id)
                ends[0] = id;
            else if (ends[1] == no_index || ends[1] == id)
                ends[1] = id;
            else
                OCTAVO_CHECK(false, "two facets that are not coplanar meet in more than a segment");
        }
        if (ends[1] == no_index) ends[1] = ends[0];
        add(crossing.first, crossing.second, ends[0], ends[1]);
        add(crossing.second, crossing.first, ends[0], ends[1]);
    }
    for (const Touch& touch : found.touches) add(touch.facet, touch.other, touch.vertex, touch.vertex);
    contacts.overlaps.insert(contacts.overlaps.end(), found.overlaps.begin(), found.overlaps.end());
    contacts.near.insert(contacts.near.end(), found.near.begin(), found.near.end());
}

}  // namespace

Contacts find_contacts(const Soup& soup, const FacetTree& tree, PointTable& points, const Context& context) {
    // Few tasks for small jobs; for large ones enough that two uneven halves do not matter.
    const std::vector<FacetTree::Task> tasks = tree.pair_tasks(soup.facets.size() < 2000 ? 1 : 256);
    std::vector<Found> found(tasks.size());
    parallel_chunks(context, tasks.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t task = begin; task < end; ++task) {
            Facet first{no_index, {}, {}};
            tree.for_each_pair(tasks[task], [&](std::uint32_t a, std::uint32_t b) {
                if (first.id != a) first = load(soup, a);
                meet(first, load(soup, b), found[task]);
            });
        }
    });

    Contacts contacts;
    for (Found& part : found) {
        name_points(part, soup, points, contacts);
        part = {};
    }
    return contacts;
}

}  // namespace octavo::boolean
