// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#ifdef __AVX__
#include <immintrin.h>
#endif

#include <octavo/base/parallel.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/octree/morton.hpp>
#include <octavo/query/closest.hpp>

namespace octavo::query {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

Float8 all(float x) { return Float8{} + x; }
Float8 greater(Float8 a, Float8 b) { return a > b ? a : b; }
Float8 smaller(Float8 a, Float8 b) { return a < b ? a : b; }
Float8 clamped(Float8 t) { return smaller(greater(t, all(0)), all(1)); }
Float8 root(Float8 x) {
#ifdef __AVX__
    // GCC keeps eight scalar roots, because each might have to set errno.
    return _mm256_sqrt_ps(x);
#endif
    Float8 result;
    for (int i = 0; i < 8; ++i) result[i] = std::sqrt(x[i]);
    return result;
}

/// Bit i is set where flag i is.
unsigned bits_of(Int8 flags) {
#ifdef __AVX__
    return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(flags)));
#endif
    unsigned bits = 0;
    for (int i = 0; i < 8; ++i) bits |= flags[i] ? 1U << i : 0U;
    return bits;
}

float least(Float8 x) {
    const Float8 four = smaller(x, __builtin_shufflevector(x, x, 4, 5, 6, 7, 0, 1, 2, 3));
    const Float8 two = smaller(four, __builtin_shufflevector(four, four, 2, 3, 0, 1, 6, 7, 4, 5));
    return std::min(two[0], two[1]);
}

struct Float8x3 {
    Float8 x, y, z;
};
Float8x3 operator-(const Float8x3& a, const Float8x3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Float8x3 operator*(Float8 s, const Float8x3& a) { return {s * a.x, s * a.y, s * a.z}; }
Float8 dot(const Float8x3& a, const Float8x3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Float8x3 cross(const Float8x3& a, const Float8x3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A query point in floats, for boxes: rounded both ways.
struct FloatPoint {
    std::array<float, 3> low, high;
};
FloatPoint float_point(Vec3 q) {
    FloatPoint point;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        // One more step out pays for the rounding of q itself.
        point.low[i] = std::nextafter(static_cast<float>(q[axis]), -infinity);
        point.high[i] = std::nextafter(static_cast<float>(q[axis]), infinity);
    }
    return point;
}

/// Lower bounds of the squared distances to the children's boxes.
Float8 squares_to_boxes(const TreeNode& node, const FloatPoint& q) {
    Float8 sum = all(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const Float8 d =
            greater(greater(node.low[axis] - q.high[axis], q.low[axis] - node.high[axis]), all(0));
        sum += d * d;
    }
    // Four roundings of 2^-24 each, and those of the squares' sums.
    return sum * (1 - 0x1p-20F);
}

struct Measured {
    Float8 distance, error;  ///< the true distances lie within distance ± error
};

/// Distances to the triangles of a leaf; `q` is exact to double precision.
Measured measure(const TreeLeaf& leaf, Vec3 q) {
    const float x = static_cast<float>(q.x - leaf.origin[0]), y = static_cast<float>(q.y - leaf.origin[1]),
                z = static_cast<float>(q.z - leaf.origin[2]);
    const Float8x3 u{leaf.u[0], leaf.u[1], leaf.u[2]}, v{leaf.v[0], leaf.v[1], leaf.v[2]};
    const Float8x3 w{x - leaf.a[0], y - leaf.a[1], z - leaf.a[2]};
    const Float8 tiny = all(1e-30F);
    const Float8 u_w = dot(u, w), v_w = dot(v, w);

    const Float8x3 to_ab = w - clamped(u_w / greater(dot(u, u), tiny)) * u;
    const Float8x3 to_ac = w - clamped(v_w / greater(dot(v, v), tiny)) * v;
    const Float8x3 e = v - u, w_b = w - u;
    const Float8x3 to_bc = w_b - clamped(dot(e, w_b) / greater(dot(e, e), tiny)) * e;
    Float8 square = smaller(smaller(dot(to_ab, to_ab), dot(to_ac, to_ac)), dot(to_bc, to_bc));

    // Of unit length, so that nothing overflows however far the point is; no number for a degenerate triangle, for
    // which all comparisons are then false.
    const Float8x3 n = cross(u, v);
    const Float8 length = root(dot(n, n));
    const Float8x3 normal = (1.0F / length) * n;
    const Float8 height = dot(normal, w);
    const Float8 beyond_ab = dot(normal, cross(u, w)), beyond_ac = dot(normal, cross(w, v));
    const Int8 foot_inside = (beyond_ab > all(0)) & (beyond_ac > all(0)) & (beyond_ab + beyond_ac < length);
    square = foot_inside ? smaller(square, height * height) : square;

    const float size = (std::fabs(x) + std::fabs(y) + std::fabs(z) + leaf.extent) * 1.00001F;
    return {root(square), leaf.error * size};
}

/// The triangles that floats cannot exclude. More than fit are measured on the way.
struct Candidate {
    mesh::FaceIndex face;
    float at_least;
};

struct Pending {
    float square;  ///< lower bound
    std::uint32_t child;
};

}  // namespace

Result<ClosestQuery> ClosestQuery::build(const mesh::LatticeMesh& mesh, const ClosestOptions& options,
                                         const Context& context) {
    if (mesh.triangles.empty()) return Error{ErrorCode::bad_input, "the mesh has no facets", {}};
    ClosestQuery query;
    if (options.sign == ClosestOptions::Sign::inside_negative) {
        auto inside = InsideQuery::build(mesh, options.inside, context);
        if (!inside) return inside.error();
        query.inside_ = std::make_shared<const InsideQuery>(std::move(*inside));
    }
    if (context.cancelled()) return Context::cancelled_error();
    query.mesh_ = mesh;
    query.tree_ = ClosestTree::build(mesh);
    return query;
}

Result<ClosestQuery> ClosestQuery::build(const mesh::Mesh& mesh, const ClosestOptions& options,
                                         const Context& context) {
    auto snapped = mesh::snap(mesh);
    if (!snapped) return snapped.error();
    return build(snapped->mesh, options, context);
}

ClosestQuery::Nearest ClosestQuery::search(const FixedPoint& fixed, mesh::FaceIndex guess) const {
    const Vec3 q = fixed.approximation();
    const FloatPoint float_q = float_point(q);
    Nearest best{guess, nearest_feature(fixed, mesh_, guess)};
    // Upper bound of the distance. A float root errs by half a unit in the last place; 2^-22 is four.
    float bound = static_cast<float>(std::sqrt(best.feature.squared_distance)) * (1 + 0x1p-22F);

    const auto consider = [&](mesh::FaceIndex face) {
        if (face == best.face) return;
        const NearestFeature feature = nearest_feature(fixed, mesh_, face);
        const auto order = compare_distance(fixed, mesh_, feature, best.feature);
        if (order < 0 || (order == 0 && face < best.face)) {
            best = {face, feature};
            const float distance = static_cast<float>(std::sqrt(feature.squared_distance)) * (1 + 0x1p-22F);
            bound = std::min(bound, distance);
        }
    };

    // A vertex has about six triangles; more than fit only cost time.
    std::array<Candidate, 32> candidates;
    std::size_t candidate_count = 0;
    const auto visit_leaf = [&](const TreeLeaf& leaf) {
        const Measured measured = measure(leaf, q);
        const Float8 at_least = measured.distance - measured.error,
                     at_most = measured.distance + measured.error;
        // A bound that is no number loses every comparison; unused places repeat the first triangle.
        bound = std::min(bound, least(at_most == at_most ? at_most : all(infinity)));
        // Written so that an error bound of infinity, whose difference may be no number, keeps the triangle.
        unsigned kept_triangles = ~bits_of(at_least > all(bound)) & ((1U << leaf.count) - 1);
        for (; kept_triangles != 0; kept_triangles &= kept_triangles - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(kept_triangles));
            if (candidate_count == candidates.size()) {
                std::size_t kept = 0;
                for (const Candidate& c : candidates)
                    if (!(c.at_least > bound)) candidates[kept++] = c;
                if (kept == candidates.size())
                    for (; kept > 0; --kept) consider(candidates[kept - 1].face);
                candidate_count = kept;
            }
            candidates[candidate_count++] = {leaf.face[i], at_least[i]};
        }
    };

    // Seven siblings wait on each of at most 48 + 32 levels (see area_depth).
    std::array<Pending, 7 * 80 + 8> stack;
    std::size_t waiting = 0;
    std::uint32_t child = 0;
    for (;;) {
        if (child & TreeNode::leaf_bit) {
            visit_leaf(tree_.leaves[child & ~TreeNode::leaf_bit]);
        } else {
            const TreeNode& node = tree_.nodes[child];
            const Float8 squares = squares_to_boxes(node, float_q);
            const float limit = bound * bound * (1 + 0x1p-22F);
            const std::size_t base = waiting;
            alignas(32) std::array<float, tree_width> square;
            std::memcpy(square.data(), &squares, sizeof squares);
            for (unsigned near = bits_of(squares <= all(limit)); near != 0; near &= near - 1) {
                const auto i = static_cast<std::size_t>(std::countr_zero(near));
                // Farthest first, so that the nearest is on top.
                std::size_t at = waiting++;
                for (; at > base && stack[at - 1].square < square[i]; --at) stack[at] = stack[at - 1];
                stack[at] = {square[i], node.child[i]};
            }
        }
        const float limit = bound * bound * (1 + 0x1p-22F);
        while (waiting > 0 && !(stack[waiting - 1].square <= limit)) --waiting;
        if (waiting == 0) break;
        child = stack[--waiting].child;
    }
    for (std::size_t i = 0; i < candidate_count; ++i)
        if (!(candidates[i].at_least > bound)) consider(candidates[i].face);
    return best;
}

Closest ClosestQuery::answer(Vec3 world, const FixedPoint& q, const Nearest& nearest, Side side) const {
    const exact::Lattice& lattice = mesh_.lattice;
    const Vec3 place = nearest_point(q, mesh_, nearest.feature);
    Closest closest;
    closest.triangle = nearest.face;
    closest.feature = nearest.feature.feature;
    for (int axis = 0; axis < 3; ++axis)
        closest.point[axis] =
            (static_cast<double>(lattice.origin()[static_cast<std::size_t>(axis)]) + place[axis]) *
            lattice.unit();
    const mesh::Triangle& t = mesh_.triangles[nearest.face];
    const auto corner = [&](mesh::VertexIndex i) {
        const exact::Point p = mesh_.points[i];
        return Vec3{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
    };
    // Differences and minors of lattice points are exact doubles.
    const Vec3 n = octavo::cross(corner(t[1]) - corner(t[0]), corner(t[2]) - corner(t[0]));
    if (!(n == Vec3{})) closest.normal = (1 / length(n)) * n;
    double distance = side == Side::on ? 0 : std::sqrt(nearest.feature.squared_distance) * lattice.unit();
    if (q.scaled_down) {
        const Vec3 away = world - closest.point;
        distance = std::hypot(away.x, away.y, away.z);
    }
    closest.distance = side == Side::inside ? -distance : distance;
    return closest;
}

namespace {

/// The answer for a point that is not finite, if it is none.
bool answer_not_finite(Vec3 point, Closest& closest) {
    if (is_finite(point)) return false;
    closest = {};
    if (!std::isnan(point.x) && !std::isnan(point.y) && !std::isnan(point.z))
        closest.distance = std::numeric_limits<double>::infinity();
    return true;
}

}  // namespace

Closest ClosestQuery::operator()(Vec3 point) const {
    Closest closest;
    if (answer_not_finite(point, closest)) return closest;
    const FixedPoint q = FixedPoint::of(point, mesh_.lattice);
    return answer(point, q, search(q, 0), inside_ ? (*inside_)(point) : Side::outside);
}

std::vector<Closest> ClosestQuery::operator()(std::span<const Vec3> points, const Context& context) const {
    std::vector<Closest> answers(points.size());
    // Points of a chunk are sorted, so larger chunks have nearer neighbours; 64 Ki of them take 2 MiB beside the
    // answers.
    constexpr std::size_t chunk = std::size_t{1} << 16;
    parallel_chunks(context, points.size(), chunk, [&](std::size_t begin, std::size_t end) {
        Context serial;
        serial.threads = 1;
        serial.cancel = context.cancel;
        std::vector<Side> sides(end - begin, Side::outside);
        if (inside_) sides = (*inside_)(points.subspan(begin, end - begin), serial);
        struct Keyed {
            std::uint64_t key;
            std::uint32_t index;
        };
        std::vector<Keyed> order;
        order.reserve(end - begin);
        for (std::size_t i = begin; i < end; ++i) {
            if (answer_not_finite(points[i], answers[i])) continue;
            const Vec3 q = FixedPoint::of(points[i], mesh_.lattice).approximation();
            const auto cell = [](double x) {
                return static_cast<std::int32_t>(std::clamp(x, 0.0, exact::universe_side - 1.0));
            };
            const exact::Point p{cell(q.x), cell(q.y), cell(q.z)};
            order.push_back(
                {octree::CellKey::at(p, octree::max_level).bits(), static_cast<std::uint32_t>(i - begin)});
        }
        std::sort(order.begin(), order.end(), [](const Keyed& a, const Keyed& b) {
            return a.key != b.key ? a.key < b.key : a.index < b.index;
        });
        mesh::FaceIndex guess = 0;
        for (const Keyed& keyed : order) {
            if (context.cancelled()) return;
            const std::size_t i = begin + keyed.index;
            const FixedPoint q = FixedPoint::of(points[i], mesh_.lattice);
            const Nearest nearest = search(q, guess);
            guess = nearest.face;
            answers[i] = answer(points[i], q, nearest, sides[keyed.index]);
        }
    });
    return answers;
}

std::size_t ClosestQuery::memory_bytes() const {
    return mesh_.points.capacity() * sizeof(exact::Point) +
           mesh_.triangles.capacity() * sizeof(mesh::Triangle) + tree_.memory_bytes() +
           (inside_ ? inside_->memory_bytes() : 0);
}

}  // namespace octavo::query
