// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <octavo/boolean/lanes.hpp>
#include <octavo/exact/bit_budget.hpp>

namespace octavo::boolean {
namespace {

// A product of 53 and 26 bits rounds once and up to three sums of them round, with an offset that has rounded alike:
// off by at most 8u 2^26 times the sum of the normal's magnitudes, u = 2^-53.
static_assert(exact::budget::normal <= 53 && exact::budget::edge <= 26);
constexpr double margin = 0x1p-23;

constexpr std::uint32_t no_corner = ~std::uint32_t{0};

struct Vector {
    double x, y, z;
};
struct Vectors {
    Reals x, y, z;
};

Reals magnitude(Reals a) { return a < 0.0 ? -a : a; }
Reals least(Reals a, Reals b) { return a < b ? a : b; }
Reals greatest(Reals a, Reals b) { return a < b ? b : a; }

template <class A, class B>
Vectors operator-(const A& a, const B& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class A, class B>
Reals dot(const A& a, const B& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class A, class B>
Vectors cross(const A& a, const B& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Projections on `axis` say nothing when they differ by less: the sum of magnitudes is not less than the length.
Reals bound_for(const Vectors& axis, double slack) {
    return slack * (magnitude(axis.x) + magnitude(axis.y) + magnitude(axis.z));
}
/// One facet and four others, from lane `first` on, relative to the first corner of the one.
class PairTest {
  public:
    PairTest(const FacetBlock& block, int lane, const FacetBlock& others, int first, double reach)
        : slack_(margin + reach) {
        for (int k = 0; k < 3; ++k) {
            own_corner_[k] = static_cast<std::int32_t>(block.corner[k][lane]);
            std::memcpy(&corner_[k], others.corner[k] + first, sizeof(Words));
            own_[k] = {double(block.point[k][0][lane] - block.point[0][0][lane]),
                       double(block.point[k][1][lane] - block.point[0][1][lane]),
                       double(block.point[k][2][lane] - block.point[0][2][lane])};
            Reals* const coordinate[3] = {&other_[k].x, &other_[k].y, &other_[k].z};
            for (int axis = 0; axis < 3; ++axis) {
                Words words;
                std::memcpy(&words, others.point[k][axis] + first, sizeof words);
                *coordinate[axis] = __builtin_convertvector(words - block.point[0][axis][lane], Reals);
            }
        }
        for (int k = 0; k < 3; ++k) {
            const Words equal[3] = {corner_[k] == own_corner_[0], corner_[k] == own_corner_[1],
                                    corner_[k] == own_corner_[2]};
            shared_[k] = __builtin_convertvector(equal[0] | equal[1] | equal[2], Flags);
        }
        own_normal_ = cross(own_[1], own_[2]);
    }

    /// All corners of the facet, shared ones aside, on one side of the other's plane.
    Flags apart_by_other_planes() const {
        const Vectors normal = cross(other_[1] - other_[0], other_[2] - other_[0]);
        const Reals bound = bound_for(normal, slack_);
        Flags front = {}, back = {};
        front = ~front, back = ~back;
        for (int k = 0; k < 3; ++k) {
            const Words is_shared = (corner_[0] == own_corner_[k]) | (corner_[1] == own_corner_[k]) |
                                    (corner_[2] == own_corner_[k]);
            const Flags shared = __builtin_convertvector(is_shared, Flags);
            const Reals value = dot(own_[k] - other_[0], normal);
            front &= (value > bound) | shared;
            back &= (value < -bound) | shared;
        }
        return front | back;
    }

    /// Beyond an edge of the facet or of the others, seen along the facet's dominant axis.
    Flags apart_in_projection() const {
        const double x = std::fabs(own_normal_.x), y = std::fabs(own_normal_.y), z = std::fabs(own_normal_.z);
        if (z >= x && z >= y) return apart_in_plane(&Vector::x, &Vector::y, &Vectors::x, &Vectors::y);
        if (y >= x) return apart_in_plane(&Vector::z, &Vector::x, &Vectors::z, &Vectors::x);
        return apart_in_plane(&Vector::y, &Vector::z, &Vectors::y, &Vectors::z);
    }

    /// Apart along the product of two edges. Facets with common corners are left to the other tests.
    Flags apart_by_edges(unsigned candidates) const {
        Flags apart = {};
        const Vectors other_edge[3] = {other_[1] - other_[0], other_[2] - other_[1], other_[0] - other_[2]};
        for (int i = 0; i < 3; ++i) {
            const Vector &p = own_[i], &q = own_[(i + 1) % 3], &r = own_[(i + 2) % 3];
            const Vector edge{q.x - p.x, q.y - p.y, q.z - p.z}, opposite{r.x - p.x, r.y - p.y, r.z - p.z};
            for (int j = 0; j < 3; ++j) {
                const Vectors axis = cross(edge, other_edge[j]);
                const Reals bound = 2 * bound_for(axis, slack_);
                const Reals end = dot(axis, opposite), from = dot(axis, other_[j] - p),
                            to = dot(axis, other_[(j + 2) % 3] - p);
                const Reals zero = {};
                apart |= (greatest(end, zero) + bound < least(from, to)) |
                         (least(end, zero) - bound > greatest(from, to));
            }
            if ((candidates & ~bits(apart)) == 0) break;
        }
        return apart & ~(shared_[0] | shared_[1] | shared_[2]);
    }

  private:
    /// The two coordinates that are left run counter-clockwise about the axis.
    Flags apart_in_plane(double Vector::*u, double Vector::*v, Reals Vectors::*us, Reals Vectors::*vs) const {
        Flags apart = {};
        const double own_turn = (own_[1].*u) * (own_[2].*v) - (own_[1].*v) * (own_[2].*u) > 0 ? 1 : -1;
        for (int edge = 0; edge < 3; ++edge) {
            const Vector &p = own_[edge], &q = own_[(edge + 1) % 3];
            const double a = own_turn * (q.*v - p.*v), b = own_turn * (p.*u - q.*u);
            const double bound = slack_ * (std::fabs(a) + std::fabs(b));
            const std::int32_t first = own_corner_[edge], second = own_corner_[(edge + 1) % 3];
            Flags beyond = {};
            beyond = ~beyond;
            for (int k = 0; k < 3; ++k) {
                const Reals value = a * (other_[k].*us - p.*u) + b * (other_[k].*vs - p.*v);
                const Words on_edge = (corner_[k] == first) | (corner_[k] == second);
                beyond &= (value > bound) | __builtin_convertvector(on_edge, Flags);
            }
            apart |= beyond;
        }
        const Reals turn = (other_[1].*us - other_[0].*us) * (other_[2].*vs - other_[0].*vs) -
                           (other_[1].*vs - other_[0].*vs) * (other_[2].*us - other_[0].*us);
        const Reals one = {1, 1, 1, 1};
        const Reals sign = turn > 0.0 ? one : -one;
        for (int edge = 0; edge < 3; ++edge) {
            const Vectors &p = other_[edge], &q = other_[(edge + 1) % 3];
            const Reals a = sign * (q.*vs - p.*vs), b = sign * (p.*us - q.*us);
            const Reals bound = slack_ * (magnitude(a) + magnitude(b));
            Flags beyond = turn != 0.0;  // edge-on, the sign says nothing
            for (int k = 0; k < 3; ++k) {
                const Reals value = a * (own_[k].*u - p.*us) + b * (own_[k].*v - p.*vs);
                const Words on_edge =
                    (corner_[edge] == own_corner_[k]) | (corner_[(edge + 1) % 3] == own_corner_[k]);
                beyond &= (value > bound) | __builtin_convertvector(on_edge, Flags);
            }
            apart |= beyond;
        }
        return apart;
    }

    double slack_;
    Vector own_[3];     ///< corners of the facet
    Vectors other_[3];  ///< corners of the others
    std::int32_t own_corner_[3];
    Words corner_[3];
    Flags shared_[3];  ///< corner k of the others is one of the facet's
    Vector own_normal_;
};

}  // namespace

unsigned sharing_spread(const FacetBlock& block, int lane, const FacetBlock& others) {
    const BlockWords first = load_block(others.corner[0]), second = load_block(others.corner[1]),
                     third = load_block(others.corner[2]);
    BlockWords shares = {};
    for (int k = 0; k < 3; ++k) {
        const std::uint32_t corner = block.corner[k][lane];
        const auto own = static_cast<std::int32_t>(corner & FacetBlock::spread ? corner : no_corner);
        shares |= (first == own) | (second == own) | (third == own);
    }
    return bits(shares);
}

unsigned across_plane(const FacetBlock& block, const FacetPlanes& planes, int lane, const FacetBlock& others,
                      unsigned candidates) {
    const double a = planes.normal[0][lane], b = planes.normal[1][lane], c = planes.normal[2][lane];
    const double offset = planes.offset[lane], bound = planes.bound[lane];
    unsigned front[3], back[3];
    for (int k = 0; k < 3; ++k) {
        const auto value = [&](int first) {
            return a * load_reals(others.point[k][0] + first) + b * load_reals(others.point[k][1] + first) +
                   (c * load_reals(others.point[k][2] + first) + offset);
        };
        const Reals low = value(0), high = value(half_block);
        front[k] = bits(low > bound) | bits(high > bound) << half_block;
        back[k] = bits(low < -bound) | bits(high < -bound) << half_block;
    }
    candidates &= ~((front[0] & front[1] & front[2]) | (back[0] & back[1] & back[2]));
    if (!candidates) return 0;
    unsigned shared[3];
    for (int k = 0; k < 3; ++k) {
        const BlockWords corner = load_block(others.corner[k]);
        shared[k] = bits((corner == std::int32_t(block.corner[0][lane])) |
                         (corner == std::int32_t(block.corner[1][lane])) |
                         (corner == std::int32_t(block.corner[2][lane])));
    }
    const unsigned all_front = (front[0] | shared[0]) & (front[1] | shared[1]) & (front[2] | shared[2]);
    const unsigned all_back = (back[0] | shared[0]) & (back[1] | shared[1]) & (back[2] | shared[2]);
    return candidates & ~(all_front | all_back);
}

FacetPlanes::FacetPlanes(const FacetBlock& block, double reach) {
    for (int lane = 0; lane < FacetBlock::width; ++lane) {
        const auto at = [&](int corner, int axis) { return double(block.point[corner][axis][lane]); };
        const auto edge = [&](int corner, int axis) { return at(corner, axis) - at(0, axis); };
        for (int axis = 0; axis < 3; ++axis) {
            const int i = (axis + 1) % 3, j = (axis + 2) % 3;
            normal[axis][lane] = edge(1, i) * edge(2, j) - edge(1, j) * edge(2, i);
        }
        offset[lane] =
            -(normal[0][lane] * at(0, 0) + normal[1][lane] * at(0, 1) + normal[2][lane] * at(0, 2));
        bound[lane] = (margin + reach) *
                      (std::fabs(normal[0][lane]) + std::fabs(normal[1][lane]) + std::fabs(normal[2][lane]));
    }
}

unsigned may_meet(const FacetBlock& block, const FacetPlanes& planes, int lane, const FacetBlock& others,
                  unsigned candidates, double reach) {
    candidates = across_plane(block, planes, lane, others, candidates);
    return candidates ? not_parted(block, lane, others, candidates, reach) : 0;
}

unsigned not_parted(const FacetBlock& block, int lane, const FacetBlock& others, unsigned candidates,
                    double reach) {
    unsigned left = 0;
    for (int first = 0; first < FacetBlock::width; first += half_block) {
        unsigned some = candidates >> first & 0xf;
        if (!some) continue;
        const PairTest test(block, lane, others, first, reach);
        some &= ~bits(test.apart_by_other_planes());
        if (some) some &= ~bits(test.apart_in_projection());
        if (some) some &= ~bits(test.apart_by_edges(some));
        left |= some << first;
    }
    return left;
}

}  // namespace octavo::boolean
