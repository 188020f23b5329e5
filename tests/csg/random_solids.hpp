// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <variant>
#include <vector>

#include <octavo/csg/convex_hull.hpp>
#include <octavo/csg/expression.hpp>

// Random expressions and an oracle that knows nothing of lattices, pruning or octants: a point's membership by the
// textbook definitions, in long double, with a margin within which it does not answer.

namespace octavo::csg::tests {

enum class Side { inside, outside, unsure };

inline Side flip(Side side) {
    return side == Side::inside ? Side::outside : side == Side::outside ? Side::inside : side;
}

/// Side of a value that is negative inside; `margin` is where it is not certain.
inline Side side_of(long double value, long double margin) {
    return value < -margin ? Side::inside : value > margin ? Side::outside : Side::unsure;
}
inline Side both(Side a, Side b) {
    if (a == Side::outside || b == Side::outside) return Side::outside;
    return a == Side::inside && b == Side::inside ? Side::inside : Side::unsure;
}

struct LocalSide {
    long double x, y, z, margin;

    Side operator()(const Cuboid& c) const {
        Side side = Side::inside;
        const long double p[3] = {x, y, z};
        for (int a = 0; a < 3; ++a)
            side = both(side, both(side_of(c.low[a] - p[a], margin), side_of(p[a] - c.high[a], margin)));
        return side;
    }
    Side operator()(const Ball& b) const {
        return side_of(std::sqrt(x * x + y * y + z * z) - b.radius, margin);
    }
    Side operator()(const Frustum& f) const {
        const long double t = (z - f.low) / (static_cast<long double>(f.high) - f.low);
        const long double radius = f.bottom + t * (static_cast<long double>(f.top) - f.bottom);
        const long double slope =
            1 + std::fabs(static_cast<long double>(f.top) - f.bottom) / (f.high - f.low);
        return both(both(side_of(f.low - z, margin), side_of(z - f.high, margin)),
                    side_of(std::sqrt(x * x + y * y) - radius, margin * slope));
    }
    Side operator()(const Torus& t) const {
        const long double rho = std::sqrt(x * x + y * y) - t.major;
        return side_of(std::sqrt(rho * rho + z * z) - t.minor, margin);
    }
    Side operator()(const HalfSpace& h) const {
        const long double norm = std::sqrt(static_cast<long double>(dot(h.normal, h.normal)));
        return side_of((h.normal.x * x + h.normal.y * y + h.normal.z * z - h.offset) / norm, margin);
    }
    Side operator()(const Everything&) const { return Side::inside; }
    Side operator()(const Polyhedron& p) const {
        // The sum of solid angles; near the surface it jumps, so distance to the facets' planes guards it.
        long double sum = 0;
        bool near = false;
        for (const mesh::Triangle& triangle : p.mesh->triangles) {
            const auto at = [&](std::size_t i) {
                const Vec3 v = p.mesh->vertices[triangle[i]];
                return Vec3{static_cast<double>(v.x - x), static_cast<double>(v.y - y),
                            static_cast<double>(v.z - z)};
            };
            const Vec3 a = at(0), b = at(1), c = at(2);
            const Vec3 normal = cross(b - a, c - a);
            const double volume = dot(a, cross(b, c));
            near |= std::fabs(volume) <= static_cast<double>(margin) * length(normal);
            const double la = length(a), lb = length(b), lc = length(c);
            sum += std::atan2(volume, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
        }
        if (near) return Side::unsure;
        return sum > std::acos(-1.0L) ? Side::inside : Side::outside;
    }
};

/// Membership of a world point; `margin` is in world units, and matrices are assumed not to stretch by more than
/// `stretch` either way.
inline Side side(const Expr& expression, Vec3 p, double margin, double stretch = 64) {
    switch (expression.operation()) {
        case Operation::primitive:
            return std::visit(LocalSide{p.x, p.y, p.z, static_cast<long double>(margin) * stretch},
                              expression.primitive());
        case Operation::transform: {
            const auto& m = expression.map().m;
            const long double det = expression.map().determinant();
            if (std::fabs(det) < 1e-12) return Side::outside;
            const long double d[3] = {p.x - m[0][3], p.y - m[1][3], p.z - m[2][3]};
            Vec3 local;
            for (std::size_t r = 0; r < 3; ++r) {
                long double sum = 0;
                for (std::size_t c = 0; c < 3; ++c) {
                    const std::size_t r1 = (c + 1) % 3, r2 = (c + 2) % 3, c1 = (r + 1) % 3, c2 = (r + 2) % 3;
                    sum += (static_cast<long double>(m[r1][c1]) * m[r2][c2] -
                            static_cast<long double>(m[r1][c2]) * m[r2][c1]) *
                           d[c];
                }
                local[static_cast<int>(r)] = static_cast<double>(sum / det);
            }
            return side(expression.operands()[0], local, margin, stretch);
        }
        case Operation::complement:
            return flip(side(expression.operands()[0], p, margin, stretch));
        case Operation::union_of: {
            Side result = Side::outside;
            for (const Expr& operand : expression.operands())
                result = flip(both(flip(result), flip(side(operand, p, margin, stretch))));
            return result;
        }
        case Operation::symmetric_difference: {
            Side result = Side::outside;
            for (const Expr& operand : expression.operands()) {
                const Side s = side(operand, p, margin, stretch);
                if (s == Side::unsure || result == Side::unsure)
                    result = Side::unsure;
                else
                    result = s == result ? Side::outside : Side::inside;
            }
            return result;
        }
        default: {
            Side result = expression.operands().empty() && expression.operation() == Operation::difference
                              ? Side::outside
                              : Side::inside;
            bool first = true;
            for (const Expr& operand : expression.operands()) {
                const Side s = side(operand, p, margin, stretch);
                const bool negate = expression.operation() == Operation::difference && !first;
                result = both(result, negate ? flip(s) : s);
                first = false;
            }
            return result;
        }
    }
}

class RandomSolids {
  public:
    explicit RandomSolids(std::uint64_t seed) : engine_(seed) {}

    double uniform(double low, double high) {
        return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
    }
    /// The same, or its negative. In two steps: the order of a product's factors differs between compilers.
    double either_way(double low, double high) {
        const bool negative = below(2) == 0;
        const double size = uniform(low, high);
        return negative ? -size : size;
    }
    int below(int n) { return static_cast<int>(engine_() % static_cast<std::uint64_t>(n)); }

    /// A map that turns, stretches, shears or mirrors; sometimes only along the axes, sometimes with whole numbers.
    Affine map() {
        Affine m;
        const int kind = below(4);
        for (std::size_t r = 0; r < 3; ++r) {
            for (std::size_t c = 0; c < 3; ++c)
                m.m[r][c] = kind == 0   ? (r == c ? either_way(0.3, 2) : 0)
                            : kind == 1 ? static_cast<double>(below(5) - 2)
                                        : uniform(-1, 1);
            m.m[r][3] = kind == 1 ? static_cast<double>(below(7) - 3) : uniform(-2, 2);
        }
        if (std::fabs(m.determinant()) < 0.05) return map();
        return m;
    }

    Primitive primitive(bool flat = false) {
        switch (below(flat ? 3 : 6)) {
            case 0:
                return Cuboid{{uniform(-1, 0), uniform(-1, 0), uniform(-1, 0)},
                              {uniform(0.1, 1), 1, uniform(0.1, 1)}};
            case 1: {
                std::vector<Vec3> points;
                for (int i = below(20) + 6; i > 0; --i)
                    points.push_back({uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)});
                return Polyhedron{std::make_shared<mesh::Mesh>(*convex_hull(points)),
                                  below(2) ? Convexity::convex : Convexity::any};
            }
            case 2:
                return Cuboid{{-1, -1, -1}, {static_cast<double>(below(2)) + 1, 1, 1}};
            case 3:
                return Ball{uniform(0.2, 1.2)};
            case 4: {
                const double r = uniform(0.2, 1);
                const int kind = below(3);
                return Frustum{-1, uniform(0, 1), r, kind == 0 ? r : kind == 1 ? 0 : uniform(0.1, 1)};
            }
            default:
                return Torus{uniform(0.4, 1), uniform(0.1, 0.5)};
        }
    }

    Expr placed(bool flat = false) {
        // One after the other: the order in which arguments are evaluated differs between compilers.
        const Affine place = map();
        return transform(place, Expr(primitive(flat)));
    }

    Expr tree(int leaves, bool flat = false) {
        if (leaves <= 1) return placed(flat);
        const int left = 1 + below(leaves - 1);
        std::vector<Expr> operands{tree(left, flat), tree(leaves - left, flat)};
        switch (below(8)) {
            case 0:
            case 1:
            case 2:
                return unite(std::move(operands));
            case 3:
            case 4:
                return subtract(std::move(operands));
            case 5:
                return intersect(std::move(operands));
            case 6:
                return symmetric_difference(std::move(operands));
            default:
                return transform(map(), subtract({operands[0], complement(complement(operands[1]))}));
        }
    }

  private:
    std::mt19937_64 engine_;
};

}  // namespace octavo::csg::tests
