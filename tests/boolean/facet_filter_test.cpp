// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <octavo/boolean/facet_filter.hpp>
#include <octavo/boolean/facet_tree.hpp>

#include "effort.hpp"
#include "solids.hpp"

// A filter may pass what it likes but must never drop a pair that meets. The oracle tries all vertices and edges in 128-bit
// integers.

namespace octavo::boolean {
namespace {

using exact::Point;
using Wide = __int128;

struct Facet {
    std::array<std::uint32_t, 3> id;
    std::array<Point, 3> at;
};

std::array<Wide, 3> minus(Point p, Point q) { return {Wide{p.x} - q.x, Wide{p.y} - q.y, Wide{p.z} - q.z}; }
std::array<Wide, 3> cross(const std::array<Wide, 3>& u, const std::array<Wide, 3>& v) {
    return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
Wide dot(const std::array<Wide, 3>& u, const std::array<Wide, 3>& v) {
    return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}
int sign(Wide number) { return number > 0 ? 1 : number < 0 ? -1 : 0; }

int volume_sign(Point a, Point b, Point c, Point d) {
    return sign(dot(minus(d, a), cross(minus(b, a), minus(c, a))));
}

/// Which way p, q, r turn, seen along `axis`.
int turn(int axis, Point p, Point q, Point r) {
    return sign(cross(minus(q, p), minus(r, p))[static_cast<std::size_t>(axis)]);
}

int widest_axis(const Facet& f) {
    const auto n = cross(minus(f.at[1], f.at[0]), minus(f.at[2], f.at[0]));
    int axis = 0;
    for (int k = 1; k < 3; ++k) {
        const auto size = [&](int i) {
            const Wide part = n[static_cast<std::size_t>(i)];
            return part < 0 ? -part : part;
        };
        if (size(k) > size(axis)) axis = k;
    }
    return axis;
}

bool is_corner(const Facet& f, std::uint32_t id) {
    return std::find(f.id.begin(), f.id.end(), id) != f.id.end();
}

/// Whether a point of the facet's plane is in the closed facet.
bool holds(const Facet& f, Point p) {
    const int axis = widest_axis(f), up = turn(axis, f.at[0], f.at[1], f.at[2]);
    for (std::size_t k = 0; k < 3; ++k)
        if (turn(axis, f.at[k], f.at[(k + 1) % 3], p) == -up) return false;
    return true;
}

/// Whether something of `first` other than a shared corner or edge ends in `second`.
bool ends_in(const Facet& first, const Facet& second) {
    for (std::size_t k = 0; k < 3; ++k) {
        const Point p = first.at[k], q = first.at[(k + 1) % 3];
        const int at_p = volume_sign(second.at[0], second.at[1], second.at[2], p),
                  at_q = volume_sign(second.at[0], second.at[1], second.at[2], q);
        if (at_p == 0 && !is_corner(second, first.id[k]) && holds(second, p)) return true;
        if (at_p * at_q < 0) {
            std::set<int> sides;
            for (std::size_t i = 0; i < 3; ++i)
                sides.insert(volume_sign(p, q, second.at[i], second.at[(i + 1) % 3]));
            if (!(sides.count(1) && sides.count(-1))) return true;
        }
        if (at_p != 0 || at_q != 0) continue;
        const int axis = widest_axis(second);  // an edge in the plane: crossings with the edges
        for (std::size_t i = 0; i < 3; ++i) {
            const Point r = second.at[i], s = second.at[(i + 1) % 3];
            if (turn(axis, p, q, r) * turn(axis, p, q, s) < 0 &&
                turn(axis, r, s, p) * turn(axis, r, s, q) < 0)
                return true;
        }
    }
    return false;
}

bool meet(const Facet& first, const Facet& second) {
    return ends_in(first, second) || ends_in(second, first);
}

/// Facets over few points, so that they share corners; points are clustered, in few planes, or a little beside them.
class RandomFacets {
  public:
    RandomFacets(unsigned seed, std::size_t count) : random_(seed) {
        const std::int32_t steps = number(2, 6), step = exact::universe_side / (steps + 1);
        while (points_.size() < count) {
            Point p;
            std::int32_t* const coordinate[3] = {&p.x, &p.y, &p.z};
            for (std::int32_t* c : coordinate) {
                const int noise = number(0, 5) == 0 ? number(-3, 3) : 0;
                *c = 8 + step * number(0, steps) + noise;
            }
            if (std::find(points_.begin(), points_.end(), p) == points_.end()) points_.push_back(p);
        }
    }

    Facet next() {
        for (;;) {
            Facet f;
            for (std::size_t k = 0; k < 3; ++k) {
                f.id[k] = static_cast<std::uint32_t>(number(0, static_cast<int>(points_.size()) - 1));
                f.at[k] = points_[f.id[k]];
            }
            const auto n = cross(minus(f.at[1], f.at[0]), minus(f.at[2], f.at[0]));
            if (n[0] != 0 || n[1] != 0 || n[2] != 0) return f;
        }
    }
    const std::vector<Point>& points() const { return points_; }

  private:
    int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
    std::mt19937 random_;
    std::vector<Point> points_;
};

FacetBlock block_of(const std::array<Facet, 8>& facets) {
    FacetBlock block;
    for (std::size_t lane = 0; lane < 8; ++lane)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            block.corner[corner][lane] = facets[lane].id[corner];
            for (int axis = 0; axis < 3; ++axis)
                block.point[corner][axis][lane] = facets[lane].at[corner][axis];
        }
    return block;
}

TEST(FacetFilter, NeverDropsFacetsThatMeet) {
    std::size_t met = 0, dropped = 0;
    for (int run = 0; run < 1500 * tests::effort(); ++run) {
        RandomFacets source(static_cast<unsigned>(run), run % 2 ? 9 : 30);
        std::array<Facet, 8> own, others;
        for (Facet& f : own) f = source.next();
        for (Facet& f : others) f = source.next();
        const FacetBlock block = block_of(own), other_block = block_of(others);
        const FacetPlanes planes(block);
        for (std::size_t lane = 0; lane < 8; ++lane) {
            const unsigned left = may_meet(block, planes, static_cast<int>(lane), other_block, 0xff);
            for (std::size_t other = 0; other < 8; ++other) {
                // A soup has no two facets with the same corners.
                if (std::is_permutation(own[lane].id.begin(), own[lane].id.end(), others[other].id.begin()))
                    continue;
                const bool kept = (left >> other & 1) != 0, meets = meet(own[lane], others[other]);
                ASSERT_TRUE(kept || !meets) << "run " << run << ", lanes " << lane << " and " << other;
                met += meets;
                dropped += !kept;
            }
        }
    }
    EXPECT_GT(met, 1000U);
    EXPECT_GT(dropped, 1000U);
}

TEST(FacetTree, FindsAllPairsThatMeetAmongSliversAndSmallFacets) {
    for (int run = 0; run < 6 * tests::effort(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        const auto number = [&](int low, int high) {
            return std::uniform_int_distribution<int>(low, high)(random);
        };
        constexpr int side = exact::universe_side;
        Soup soup;
        std::vector<Facet> facets;
        const auto add = [&](const std::array<Point, 3>& corners) {
            Facet f;
            for (std::size_t k = 0; k < 3; ++k) {
                f.id[k] = static_cast<std::uint32_t>(soup.points.size());
                f.at[k] = corners[k];
                soup.points.push_back(corners[k]);
            }
            const auto n = cross(minus(f.at[1], f.at[0]), minus(f.at[2], f.at[0]));
            if (n[0] == 0 && n[1] == 0 && n[2] == 0) return;
            facets.push_back(f);
            soup.facets.push_back({f.id[0], f.id[1], f.id[2]});
        };
        for (int i = 0; i < 500; ++i) {
            const Point p{number(0, side - 1), number(0, side - 1), number(0, side - 1)};
            if (i % 2) {  // a sliver across the scene
                const Point q{number(0, side - 1), number(0, side - 1), number(0, side - 1)};
                add({p, q,
                     Point{std::min(q.x + number(0, 9), side - 1), q.y, std::max(q.z - number(0, 9), 0)}});
            } else {
                const auto near = [&](std::int32_t c) {
                    return std::clamp(c + number(-side / 20, side / 20), 0, side - 1);
                };
                add({p, Point{near(p.x), near(p.y), near(p.z)}, Point{near(p.x), near(p.y), near(p.z)}});
            }
        }
        soup.transition.assign(soup.facets.size(), 0);
        const FacetTree tree(soup);
        std::set<std::pair<std::uint32_t, std::uint32_t>> found;
        for (const FacetTree::Task& task : tree.pair_tasks(16))
            tree.for_each_pair(task, [&](std::uint32_t a, std::uint32_t b) {
                ASSERT_TRUE(found.insert(std::minmax(a, b)).second) << "a pair comes twice";
            });
        std::size_t met = 0;
        for (std::uint32_t a = 0; a < facets.size(); ++a)
            for (std::uint32_t b = a + 1; b < facets.size(); ++b)
                if (meet(facets[a], facets[b])) {
                    ++met;
                    ASSERT_TRUE(found.count({a, b})) << "run " << run << ", facets " << a << " and " << b;
                }
        EXPECT_GT(met, 10U);
        EXPECT_LT(found.size(), 2 * met + 100) << "the filters let too much through";
    }
}

}  // namespace
}  // namespace octavo::boolean
