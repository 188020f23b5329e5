// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include <octavo/boolean/facet_filter.hpp>
#include <octavo/boolean/facet_tree.hpp>
#include <octavo/boolean/stars.hpp>

#include "effort.hpp"
#include "solids.hpp"

// A filter may pass what it likes but must never drop a pair that meets. The oracle tries all vertices and edges in
// 128-bit integers.

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
    int sides = 0;
    for (const Point corner : second.at) sides += volume_sign(first.at[0], first.at[1], first.at[2], corner);
    if (std::abs(sides) == 3) return false;
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

/// Fans of slivers, six side by side along a skew line and one along another, and small facets about these.
Soup bundled_fans(std::mt19937& random) {
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Soup soup;
    const auto add_point = [&](Vec3 at) {
        const auto inside = [](double c) {
            return static_cast<std::int32_t>(std::clamp(c, 1.0, exact::universe_side - 1.0));
        };
        soup.points.push_back({inside(at.x), inside(at.y), inside(at.z)});
        return static_cast<std::uint32_t>(soup.points.size() - 1);
    };
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const auto n = cross(minus(soup.points[b], soup.points[a]), minus(soup.points[c], soup.points[a]));
        if (n[0] != 0 || n[1] != 0 || n[2] != 0) soup.facets.push_back({a, b, c});
    };
    constexpr double side = exact::universe_side;
    const double thickness = std::ldexp(1.0, std::uniform_int_distribution<int>(4, 16)(random));
    const auto aside = [&] {
        return Vec3{number(-thickness, thickness), number(-thickness, thickness),
                    number(-thickness, thickness)};
    };
    for (int fan = 0; fan < 7; ++fan) {
        const Vec3 along = fan == 6 ? Vec3{.2, .3, -.5} : Vec3{-.3, .5, .1};
        const Vec3 middle = (side / 2) * Vec3{1, 1, 1} + 2.0 * aside();
        const double turned = fan % 2 ? -.6 : .6;
        const std::uint32_t hub = add_point(middle + (turned * side) * along + aside());
        constexpr int slivers = 100;
        const Vec3 from = aside(), to = aside();
        std::uint32_t last = no_index;
        for (int k = 0; k <= slivers; ++k) {
            const double t = k / double(slivers);
            const std::uint32_t next =
                add_point(middle - (turned * t * side) * along + (1 - t) * from + t * to);
            if (last != no_index) add(hub, last, next);
            last = next;
        }
        for (int k = 0; k < 20; ++k) {
            const Vec3 at = middle + (number(-.6, .6) * side) * along + aside();
            add(add_point(at), add_point(at + aside()), add_point(at + aside()));
        }
    }
    soup.transition.assign(soup.facets.size(), 0);
    return soup;
}

Facet facet_of(const Soup& soup, std::uint32_t number) {
    const mesh::Triangle& t = soup.facets[number];
    return {{t[0], t[1], t[2]}, {soup.points[t[0]], soup.points[t[1]], soup.points[t[2]]}};
}

TEST(FacetTree, FindsAllPairsThatMeetOrComeNearInBundlesOfSlivers) {
    std::size_t met = 0, near = 0, bundles = 0;
    for (int run = 0; run < 6 * tests::effort(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        const Soup soup = bundled_fans(random);
        const int reach = run % 3 == 0 ? 0 : run % 3 == 1 ? 2 : 100;
        std::vector<std::uint32_t> all(soup.facets.size());
        std::iota(all.begin(), all.end(), 0U);
        bundles += bundles_among(soup, all, reach).size();
        const FacetTree tree(soup, {}, reach);
        std::set<std::pair<std::uint32_t, std::uint32_t>> found;
        for (const FacetTree::Task& task : tree.pair_tasks(16))
            tree.for_each_pair(task, [&](std::uint32_t a, std::uint32_t b) {
                ASSERT_TRUE(found.insert(std::minmax(a, b)).second) << "a pair comes twice";
            });
        const auto number = [&] { return std::uniform_int_distribution<int>(-reach, reach)(random); };
        for (std::uint32_t a = 0; a < soup.facets.size(); ++a)
            for (std::uint32_t b = a + 1; b < soup.facets.size(); ++b) {
                const Facet first = facet_of(soup, a);
                Facet second = facet_of(soup, b);
                if (meet(first, second)) {
                    ++met;
                    ASSERT_TRUE(found.count({a, b})) << "run " << run << ", facets " << a << " and " << b;
                }
                const bool share = std::any_of(first.id.begin(), first.id.end(),
                                               [&](std::uint32_t id) { return is_corner(second, id); });
                if (reach == 0 || share) continue;
                const int x = number(), y = number(), z = number();
                for (Point& corner : second.at) corner = {corner.x + x, corner.y + y, corner.z + z};
                if (meet(first, second)) {
                    ++near;
                    ASSERT_TRUE(found.count({a, b})) << "run " << run << ", facets " << a << " and " << b;
                }
            }
    }
    EXPECT_GT(met, 1000U);
    EXPECT_GT(near, 1000U);
    EXPECT_GE(bundles, 4U);
}

TEST(FacetTree, FindsFacetsOfBundlesOnRays) {
    std::mt19937 random(7);
    const Soup soup = bundled_fans(random);
    const FacetTree tree(soup);
    for (int run = 0; run < 300; ++run) {
        const auto number = [&] {
            return std::uniform_int_distribution<int>(0, exact::universe_side)(random);
        };
        const mesh::Triangle& t = soup.facets[random() % soup.facets.size()];
        const Point start = run % 2 ? soup.points[t[0]] : Point{number(), number(), number()};
        const int axis = run % 3, sign = run % 2 ? 1 : -1, i = (axis + 1) % 3, j = (axis + 2) % 3;
        std::set<std::uint32_t> found, expected;
        tree.for_each_on_ray(start, start, axis, sign, [&](std::uint32_t facet) {
            ASSERT_TRUE(found.insert(facet).second) << "a facet comes twice";
        });
        for (std::uint32_t facet = 0; facet < soup.facets.size(); ++facet) {
            const Facet f = facet_of(soup, facet);
            const auto low = [&](int k) { return std::min({f.at[0][k], f.at[1][k], f.at[2][k]}); };
            const auto high = [&](int k) { return std::max({f.at[0][k], f.at[1][k], f.at[2][k]}); };
            if (low(i) <= start[i] && start[i] <= high(i) && low(j) <= start[j] && start[j] <= high(j) &&
                (sign > 0 ? high(axis) >= start[axis] : low(axis) <= start[axis]))
                expected.insert(facet);
        }
        EXPECT_EQ(found, expected);
    }
}

/// A fan about point 0. Its ring goes about an axis once, seen along it, or twice, or anyhow; up and down as it likes.
Soup random_star(std::mt19937& random) {
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    constexpr std::int32_t centre = exact::universe_side / 2;
    Soup soup;
    soup.points.push_back({centre, centre, centre});
    const auto kind = random() % 8;
    const std::size_t count = 3 + random() % 10, axis = random() % 3;
    const double size = std::exp2(number(5, 24)), height = number(0, 1.5);
    for (std::size_t i = 0; i < count; ++i) {
        const double turns = kind == 0 ? 2.0 : 1.0, noise = kind == 1 ? number(0, 1) : number(0, 0.8);
        const double angle =
            6.283185307179586 * turns * (static_cast<double>(i) + noise) / static_cast<double>(count);
        const double radius = size * (kind == 2 ? std::exp2(number(-4, 0)) : number(0.5, 1));
        const double along[3] = {radius * std::cos(angle), radius * std::sin(angle),
                                 size * number(-height, height)};
        const auto at = [&](std::size_t k) {
            return centre + static_cast<std::int32_t>(along[(k + axis) % 3] / 4);
        };
        soup.points.push_back({at(0), at(1), at(2)});
    }
    if (kind == 3) std::shuffle(soup.points.begin() + 1, soup.points.end(), random);
    const bool turned = random() % 2 == 0;
    for (std::uint32_t i = 1; i <= count; ++i) {
        const std::uint32_t next = i == count ? 1 : i + 1;
        soup.facets.push_back({0, turned ? next : i, turned ? i : next});
    }
    soup.transition.assign(soup.facets.size(), 0);
    return soup;
}

/// Neighbours by nothing but the star's vertex stay apart as long as no other corner moves farther than the reach.
TEST(Stars, AreNotSaidToBeSpreadWhereFacetsMeetWithinTheReach) {
    Context context;
    context.threads = 1;
    std::size_t spread = 0, folded = 0;
    for (int run = 0; run < 4000 * tests::effort() && !HasFailure(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        const Soup soup = random_star(random);
        const int reach = run % 3 == 0 ? 0 : static_cast<int>(random() % 200);
        const auto facets = static_cast<std::uint32_t>(soup.facets.size());
        if (!find_stars(soup, reach, context).is_spread[0]) {
            ++folded;
            continue;
        }
        ++spread;
        const auto moved = [&](Facet f) {
            for (Point& point : f.at)
                if (point != soup.points[0]) {
                    const auto step = [&] { return (static_cast<int>(random() % 3) - 1) * reach; };
                    point = {point.x + step(), point.y + step(), point.z + step()};
                }
            return f;
        };
        for (std::uint32_t a = 0; a < facets; ++a)
            for (std::uint32_t b = a + 1; b < facets; ++b) {
                const bool are_neighbours = b == a + 1 || (a == 0 && b + 1 == facets);
                const Facet f = facet_of(soup, a), g = facet_of(soup, b);
                ASSERT_FALSE(meet(f, g)) << "run " << run << ", facets " << a << " and " << b;
                for (int i = 0; i < 20 && !are_neighbours; ++i)
                    ASSERT_FALSE(meet(moved(f), moved(g)))
                        << "run " << run << ", facets " << a << " and " << b;
            }
    }
    EXPECT_GT(spread, 500U);
    EXPECT_GT(folded, 500U);
}

/// A sphere with eight times the square of `segments` facets, whose vertices are pushed about until it crosses itself.
Soup crumpled_sphere(std::mt19937& random, int segments) {
    const mesh::Mesh sphere = tests::octahedral_sphere(segments);
    std::uniform_real_distribution<double> push(0.55, 1.45);
    Soup soup;
    for (const Vec3& vertex : sphere.vertices) {
        const auto at = [&](double coordinate) {
            return static_cast<std::int32_t>((1.5 + coordinate * push(random)) * (exact::universe_side / 3));
        };
        soup.points.push_back({at(vertex.x), at(vertex.y), at(vertex.z)});
    }
    for (const mesh::Triangle& t : sphere.triangles) soup.facets.push_back(t);
    soup.transition.assign(soup.facets.size(), 0);
    return soup;
}

TEST(FacetTree, FindsAllPairsThatMeetOfSurfacesWhoseStarsAreSpread) {
    Context context;
    context.threads = 1;
    std::size_t met = 0, spread = 0;
    for (int run = 0; run < 6 * tests::effort(); ++run) {
        std::mt19937 random(static_cast<unsigned>(run));
        const Soup soup = crumpled_sphere(random, 8 + run % 3);
        const Stars stars = find_stars(soup, 0, context);
        spread += static_cast<std::size_t>(std::count(stars.is_spread.begin(), stars.is_spread.end(), 1));
        const FacetTree tree(soup, context, 0, stars.is_spread);
        std::set<std::pair<std::uint32_t, std::uint32_t>> found;
        for (const FacetTree::Task& task : tree.pair_tasks(16))
            tree.for_each_pair(task,
                               [&](std::uint32_t a, std::uint32_t b) { found.insert(std::minmax(a, b)); });
        for (std::uint32_t a = 0; a < soup.facets.size(); ++a)
            for (std::uint32_t b = a + 1; b < soup.facets.size(); ++b)
                if (meet(facet_of(soup, a), facet_of(soup, b))) {
                    ++met;
                    ASSERT_TRUE(found.count({a, b})) << "run " << run << ", facets " << a << " and " << b;
                }
    }
    EXPECT_GT(met, 100U);
    EXPECT_GT(spread, 100U);
}

}  // namespace
}  // namespace octavo::boolean
