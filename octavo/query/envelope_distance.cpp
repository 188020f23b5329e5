// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <queue>

#include <octavo/base/parallel.hpp>
#include <octavo/query/envelope_distance.hpp>

namespace octavo::query {
namespace {

using bp_octree::BpOctree;
using bp_octree::CellBox;
using bp_octree::NodeIndex;
using octree::Cell;
using octree::Node;

/// World to half lattice units from the lattice's origin.
Vec3 doubled_place(const BpOctree& tree, Vec3 point) {
    const exact::Lattice& lattice = tree.mesh.lattice;
    for (int axis = 0; axis < 3; ++axis)
        point[axis] = 2 * (point[axis] / lattice.unit() -
                           static_cast<double>(lattice.origin()[static_cast<std::size_t>(axis)]));
    return point;
}

double distance_to_box(const CellBox& box, Vec3 place) {
    Vec3 beyond;
    for (int axis = 0; axis < 3; ++axis)
        beyond[axis] = std::max({box.low[axis] - place[axis], place[axis] - box.high[axis], 0.0});
    return std::hypot(beyond.x, beyond.y, beyond.z);
}

/// For points so far out that products overflow: seen from there the universe is a point, but for a few roundings.
double distance_from_afar(const BpOctree& tree, Vec3 point) {
    const Vec3 away = 0.25 * point - 0.25 * tree.mesh.lattice.to_world({0, 0, 0});
    return std::min(4 * (1 - 0x1p-40) * std::hypot(away.x, away.y, away.z),
                    std::numeric_limits<double>::max());
}

/// How far the place lies beyond the plane of a node with this cell; negative within.
double distance_to_plane(const CellBox& box, const bp_octree::BoundingPlane& plane, Vec3 place) {
    const bp_octree::HalfSpace half = plane.half_space();
    double value = -half.offset, square = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double slope = half.normal[axis] * bp_octree::Polytope::cell_side / box.side(axis);
        value += slope * (place[axis] - box.low[axis]);
        square += slope * slope;
    }
    return value / std::sqrt(square);
}

}  // namespace

EnvelopeDistance::EnvelopeDistance(const BpOctree& tree, int level)
    : tree_(tree), level_(std::clamp(level, 0, tree.deepest())) {}

double EnvelopeDistance::bound_of(const Open& parent, NodeIndex node, const Cell& cell, Vec3 place) const {
    const CellBox box = tree_.frame.box(cell);
    double bound = std::max(parent.bound, distance_to_box(box, place));
    for (const bp_octree::BoundingPlane& plane : tree_.planes_of(node))
        bound = std::max(bound, distance_to_plane(box, plane, place));
    return bound;
}

double EnvelopeDistance::operator()(Vec3 point) const {
    if (std::isnan(point.x) || std::isnan(point.y) || std::isnan(point.z)) return std::nan("");
    if (!is_finite(point)) return std::numeric_limits<double>::infinity();
    const Vec3 place = doubled_place(tree_, point);
    const double size = std::fabs(place.x) + std::fabs(place.y) + std::fabs(place.z) + 0x1p28;
    if (size > 0x1p900) return distance_from_afar(tree_, point);
    const auto farther = [](const Open& a, const Open& b) {
        return a.bound != b.bound ? a.bound > b.bound : a.node > b.node;
    };
    std::priority_queue<Open, std::vector<Open>, decltype(farther)> open(farther);
    const Open above{0, 0, Cell::root()};
    open.push({bound_of(above, 0, Cell::root(), place), 0, Cell::root()});
    while (!open.empty()) {
        const Open nearest = open.top();
        open.pop();
        if (tree_.nodes[nearest.node] != Node::split || nearest.cell.level >= level_) {
            // Roundings of places up to 2^53 half units, and of the few operations, must not lift the bound.
            return std::max(0.0, nearest.bound - 0x1p-45 * size) * 0.5 * tree_.mesh.lattice.unit();
        }
        for (int i = 0; i < 8; ++i) {
            const NodeIndex child = tree_.link[nearest.node] + static_cast<NodeIndex>(i);
            if (tree_.nodes[child] == Node::white) continue;
            const Cell cell = nearest.cell.child(i);
            open.push({bound_of(nearest, child, cell, place), child, cell});
        }
    }
    return std::numeric_limits<double>::infinity();  // an octree of nothing but white cells
}

std::vector<double> EnvelopeDistance::operator()(std::span<const Vec3> points, const Context& context) const {
    std::vector<double> bounds(points.size(), std::nan(""));
    parallel_chunks(context, points.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end && !context.cancelled(); ++i) bounds[i] = (*this)(points[i]);
    });
    return bounds;
}

std::optional<LeafDistance> distance_in_leaf(const BpOctree& tree, Vec3 point) {
    OCTAVO_CHECK(!tree.mesh.triangles.empty(), "only a tree with its triangles tells distances in leaves");
    if (!is_finite(point)) return std::nullopt;
    const Vec3 place = doubled_place(tree, point);
    CellBox box = tree.frame.box(Cell::root());
    if (distance_to_box(box, place) > 0) return std::nullopt;
    NodeIndex node = 0;
    for (Cell cell = Cell::root(); tree.nodes[node] == Node::split; box = tree.frame.box(cell)) {
        int octant = 0;
        for (int axis = 0; axis < 3; ++axis)
            if (place[axis] >= box.low[axis] + box.side(axis) / 2) octant |= 1 << axis;
        node = tree.link[node] + static_cast<NodeIndex>(octant);
        cell = cell.child(octant);
    }
    if (tree.nodes[node] != Node::gray) return std::nullopt;
    const FixedPoint fixed = FixedPoint::of(point, tree.mesh.lattice);
    std::optional<NearestFeature> nearest;
    LeafDistance answer;
    for (const mesh::FaceIndex face : tree.triangles_of(node)) {
        const mesh::Triangle& t = tree.mesh.triangles[face];
        const auto& points = tree.mesh.points;
        const NearestFeature feature = nearest_feature(fixed, {points[t[0]], points[t[1]], points[t[2]]});
        if (nearest && compare_distance(fixed, feature, *nearest) >= 0) continue;
        nearest = feature;
        answer.triangle = face;
    }
    const double units = std::sqrt(nearest->squared_distance);
    answer.distance = units * tree.mesh.lattice.unit();
    double to_wall = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis)
        to_wall = std::min({to_wall, place[axis] - box.low[axis], box.high[axis] - place[axis]});
    // A little is given up, so that rounding never claims too much: of the place, by 2^-26, and of the distance.
    answer.is_exact = 2 * units <= to_wall * (1 - 0x1p-40) - 0x1p-25;
    return answer;
}

}  // namespace octavo::query
