// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <octavo/base/parallel.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/octree/morton.hpp>
#include <octavo/query/closest.hpp>
#include <octavo/query/closest_search.hpp>

namespace octavo::query {

Result<ClosestQuery> ClosestQuery::build(const mesh::LatticeMesh& mesh, const ClosestOptions& options,
                                         const Context& context) {
    if (mesh.triangles.empty()) return Error{ErrorCode::bad_input, "the mesh has no facets", {}};
    if (const Status placed = classic::check_places(mesh); !placed) return placed.error();
    ClosestQuery query;
    if (options.sign == ClosestOptions::Sign::inside_negative) {
        auto inside = InsideQuery::build(mesh, options.inside, context);
        if (!inside) return inside.error();
        query.inside_ = std::make_shared<const InsideQuery>(std::move(*inside));
    }
    query.lattice_ = mesh.lattice;
    query.tree_ = ClosestTree::build(mesh, context);
    if (context.cancelled()) return Context::cancelled_error();
    return query;
}

Result<ClosestQuery> ClosestQuery::build(const mesh::Mesh& mesh, const ClosestOptions& options,
                                         const Context& context) {
    auto snapped = mesh::snap(mesh);
    if (!snapped) return snapped.error();
    return build(snapped->mesh, options, context);
}

Closest ClosestQuery::answer(Vec3 world, const FixedPoint& q, const NearestTriangle& nearest,
                             Side side) const {
    const Vec3 place = nearest_point(q, nearest.feature);
    Closest closest;
    closest.triangle = nearest.face;
    closest.feature = nearest.feature.feature;
    for (int axis = 0; axis < 3; ++axis)
        closest.point[axis] =
            (static_cast<double>(lattice_.origin()[static_cast<std::size_t>(axis)]) + place[axis]) *
            lattice_.unit();
    const auto corner = [&](std::size_t i) {
        const exact::Point p = nearest.corners[i];
        return Vec3{static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
    };
    // Differences and minors of lattice points are exact doubles.
    const Vec3 n = octavo::cross(corner(1) - corner(0), corner(2) - corner(0));
    if (!(n == Vec3{})) closest.normal = (1 / length(n)) * n;
    // A point on the surface may have been rounded off it; one on what closes an open surface may be far from all
    // facets.
    double units = std::sqrt(nearest.feature.squared_distance);
    if (side == Side::on && units <= FixedPoint::resolution) units = 0;
    double distance = units * lattice_.unit();
    if (q.scaled_down) {
        const Vec3 away = world - closest.point;
        distance = std::hypot(away.x, away.y, away.z);
    }
    closest.distance = side == Side::inside && distance > 0 ? -distance : distance;
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
    const FixedPoint q = FixedPoint::of(point, lattice_);
    if (!inside_) return answer(point, q, search(tree_, q), Side::outside);
    const InsideQuery::Begun side = inside_->begin(point);
    const NearestTriangle nearest = search(tree_, q);
    return answer(point, q, nearest, inside_->finish(side));
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
            const Vec3 q = FixedPoint::of(points[i], lattice_).approximation();
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
        // The distance from here is at most that from the point before and the way from there.
        Vec3 before;
        double distance = std::numeric_limits<double>::infinity();
        for (const Keyed& keyed : order) {
            if (context.cancelled()) return;
            const std::size_t i = begin + keyed.index;
            const FixedPoint q = FixedPoint::of(points[i], lattice_);
            const Vec3 place = q.approximation();
            const double at_most = (distance + length(place - before)) * (1 + 0x1p-20);
            const NearestTriangle nearest = search(tree_, q, static_cast<float>(at_most));
            before = place;
            distance = std::sqrt(nearest.feature.squared_distance);
            answers[i] = answer(points[i], q, nearest, sides[keyed.index]);
        }
    });
    return answers;
}

std::size_t ClosestQuery::memory_bytes() const {
    return tree_.memory_bytes() + (inside_ ? inside_->memory_bytes() : 0);
}

}  // namespace octavo::query
