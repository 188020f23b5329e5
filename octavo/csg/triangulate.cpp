// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include <octavo/csg/triangulate.hpp>

namespace octavo::csg {
namespace {

using Wide = __int128;

struct Corner {
    std::int64_t x, y;
    std::uint32_t index;
};
using Ring = std::vector<Corner>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

int turn(const Corner& a, const Corner& b, const Corner& c) {
    const Wide value = Wide{b.x - a.x} * (c.y - a.y) - Wide{b.y - a.y} * (c.x - a.x);
    return value > 0 ? 1 : value < 0 ? -1 : 0;
}

Wide doubled_area(const Ring& ring) {
    Wide sum = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Corner &p = ring[i], &q = ring[(i + 1) % ring.size()];
        sum += Wide{p.x} * q.y - Wide{p.y} * q.x;
    }
    return sum;
}

bool same_place(const Corner& a, const Corner& b) { return a.x == b.x && a.y == b.y; }

/// Odd number of crossings of a ray to the right, for points off the ring.
bool contains(const Ring& ring, const Corner& p) {
    bool inside = false;
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
        const Corner &a = ring[j], &b = ring[i];
        if ((a.y > p.y) != (b.y > p.y) && (turn(a, b, p) > 0) == (b.y > a.y)) inside = !inside;
    }
    return inside;
}

/// Whether the open segment a–b keeps off all edges of the ring, apart from those that end at its ends.
bool sees(const Ring& ring, const Corner& a, const Corner& b) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Corner &p = ring[i], &q = ring[(i + 1) % ring.size()];
        if (same_place(p, a) || same_place(p, b) || same_place(q, a) || same_place(q, b)) continue;
        if (turn(a, b, p) * turn(a, b, q) <= 0 && turn(p, q, a) * turn(p, q, b) <= 0) return false;
    }
    return true;
}

/// Inserts the hole into the outline by a cut from its rightmost corner to the nearest corner that sees it.
bool join(Ring& outline, const Ring& hole, const std::vector<Ring>& others) {
    const auto start = std::max_element(hole.begin(), hole.end(), [](const Corner& a, const Corner& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    std::vector<std::size_t> order(outline.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    const auto distance = [&](std::size_t i) {
        const double dx = static_cast<double>(outline[i].x - start->x),
                     dy = static_cast<double>(outline[i].y - start->y);
        return dx * dx + dy * dy;
    };
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); });
    for (const std::size_t at : order) {
        const Corner& corner = outline[at];
        const Corner& before = outline[(at + outline.size() - 1) % outline.size()];
        const Corner& after = outline[(at + 1) % outline.size()];
        // The cut must leave the corner into the outline's inside.
        const bool convex = turn(before, corner, after) > 0;
        const bool left = turn(before, corner, *start) > 0, right = turn(corner, after, *start) > 0;
        if (convex ? !(left && right) : !(left || right)) continue;
        if (!sees(outline, corner, *start) || !sees(hole, corner, *start)) continue;
        if (std::any_of(others.begin(), others.end(),
                        [&](const Ring& other) { return !sees(other, corner, *start); }))
            continue;
        Ring cut(start, hole.end());
        cut.insert(cut.end(), hole.begin(), start + 1);
        cut.push_back(corner);
        outline.insert(outline.begin() + static_cast<std::ptrdiff_t>(at) + 1, cut.begin(), cut.end());
        return true;
    }
    return false;
}

/// Cuts ears off a ring; what has none is fanned.
void cut_ears(const Ring& ring, Triangles& triangles) {
    const std::size_t n = ring.size();
    std::vector<std::size_t> next(n), previous(n);
    for (std::size_t i = 0; i < n; ++i) next[i] = (i + 1) % n, previous[i] = (i + n - 1) % n;
    const auto is_ear = [&](std::size_t at) {
        const Corner &a = ring[previous[at]], &b = ring[at], &c = ring[next[at]];
        if (turn(a, b, c) <= 0) return false;
        for (std::size_t i = next[next[at]]; i != previous[at]; i = next[i]) {
            const Corner& p = ring[i];
            if (turn(previous[i] == i ? p : ring[previous[i]], p, ring[next[i]]) > 0)
                continue;  // only reflex ones
            if (same_place(p, a) || same_place(p, b) || same_place(p, c)) continue;
            if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
        }
        return true;
    };
    std::size_t left = n, at = 0, tried = 0;
    while (left > 3 && tried < left) {
        const Corner &a = ring[previous[at]], &b = ring[at], &c = ring[next[at]];
        const bool flat = turn(a, b, c) == 0 && (same_place(a, b) || same_place(b, c) || same_place(a, c));
        if (!flat && !is_ear(at)) {
            at = next[at];
            ++tried;
            continue;
        }
        // A spike or a doubled corner covers nothing, but its triangle keeps the edges paired.
        triangles.push_back({a.index, b.index, c.index});
        next[previous[at]] = next[at];
        previous[next[at]] = previous[at];
        at = next[at];
        --left;
        tried = 0;
    }
    for (std::size_t i = next[at]; next[i] != at; i = next[i])
        triangles.push_back({ring[at].index, ring[i].index, ring[next[i]].index});
}

void fan(const Ring& ring, Triangles& triangles) {
    for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        triangles.push_back({ring[0].index, ring[i].index, ring[i + 1].index});
}

}  // namespace

Triangles triangulate(const std::vector<Contour>& contours) {
    double extent = 0;
    for (const Contour& contour : contours)
        for (const Vec2& p : contour) extent = std::max({extent, std::fabs(p.x), std::fabs(p.y)});
    const double scale = extent > 0 ? std::ldexp(1.0, 39 - std::ilogb(extent)) : 1;
    std::vector<Ring> outlines, holes;
    std::uint32_t index = 0;
    for (const Contour& contour : contours) {
        Ring ring;
        for (const Vec2& p : contour)
            ring.push_back({static_cast<std::int64_t>(std::nearbyint(p.x * scale)),
                            static_cast<std::int64_t>(std::nearbyint(p.y * scale)), index++});
        if (ring.size() < 3) continue;
        (doubled_area(ring) >= 0 ? outlines : holes).push_back(std::move(ring));
    }
    // Each hole goes to the smallest outline around it, holes from right to left so that cuts do not cross.
    std::sort(holes.begin(), holes.end(), [](const Ring& a, const Ring& b) {
        const auto right = [](const Ring& r) {
            std::int64_t x = std::numeric_limits<std::int64_t>::min();
            for (const Corner& c : r) x = std::max(x, c.x);
            return x;
        };
        return right(a) > right(b);
    });
    Triangles triangles;
    std::vector<std::vector<Ring>> holes_of(outlines.size());
    for (Ring& hole : holes) {
        std::size_t best = outlines.size();
        for (std::size_t i = 0; i < outlines.size(); ++i)
            if (contains(outlines[i], hole[0]) &&
                (best == outlines.size() || doubled_area(outlines[i]) < doubled_area(outlines[best])))
                best = i;
        if (best == outlines.size())
            fan(hole, triangles);  // touches its outline, or has none
        else
            holes_of[best].push_back(std::move(hole));
    }
    for (std::size_t i = 0; i < outlines.size(); ++i) {
        std::vector<Ring>& inside = holes_of[i];
        while (!inside.empty()) {
            const Ring hole = std::move(inside.front());
            inside.erase(inside.begin());
            if (!join(outlines[i], hole, inside)) fan(hole, triangles);
        }
        cut_ears(outlines[i], triangles);
    }
    return triangles;
}

}  // namespace octavo::csg
