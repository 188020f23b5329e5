// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include <octavo/bp_octree/cell_split.hpp>
#include <octavo/bp_octree/figures.hpp>
#include <octavo/bp_octree/k_medoids.hpp>
#include <octavo/bp_octree/node_content.hpp>

namespace octavo::bp_octree {
namespace {

using octree::Cell;
using octree::Node;

struct Angles {
    double theta, rho;
};

double distance(const Angles& a, const Angles& b) {
    return (a.theta - b.theta) * (a.theta - b.theta) + (a.rho - b.rho) * (a.rho - b.rho);
}

/// The indices of `count` medoids of the points.
std::vector<std::size_t> medoids_of(const std::vector<Angles>& points, std::size_t count) {
    std::vector<std::size_t> medoids(count), nearest(points.size());
    for (std::size_t i = 0; i < count; ++i) medoids[i] = i * points.size() / count;
    // Assignments settle within a few rounds; later ones move single points.
    for (int round = 0; round < 8; ++round) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            double least = 1e300;
            for (std::size_t k = 0; k < count; ++k)
                if (const double d = distance(points[i], points[medoids[k]]); d < least)
                    least = d, nearest[i] = k;
        }
        std::vector<Angles> sums(count, {0, 0});
        std::vector<double> sizes(count, 0), least(count, 1e300);
        for (std::size_t i = 0; i < points.size(); ++i) {
            sums[nearest[i]].theta += points[i].theta;
            sums[nearest[i]].rho += points[i].rho;
            sizes[nearest[i]] += 1;
        }
        bool moved = false;
        std::vector<std::size_t> next = medoids;
        // Under squared distances the medoid is the member nearest to the mean.
        for (std::size_t i = 0; i < points.size(); ++i) {
            const std::size_t k = nearest[i];
            const double d = distance(points[i], {sums[k].theta / sizes[k], sums[k].rho / sizes[k]});
            if (d < least[k]) least[k] = d, next[k] = i;
        }
        for (std::size_t k = 0; k < count; ++k) moved |= next[k] != medoids[k];
        medoids = std::move(next);
        if (!moved) break;
    }
    return medoids;
}

class KMedoids {
  public:
    KMedoids(BpOctree& tree, const KMedoidsOptions& options, const Context& context)
        : tree_(tree),
          options_(options),
          context_(context),
          planes_(tree.nodes.size()),
          buffers_(tree.levels.size()) {}

    Status run() {
        std::vector<mesh::FaceIndex> all(tree_.mesh.triangles.size());
        std::iota(all.begin(), all.end(), 0U);
        visit(0, Cell::root(), all, 0, 0);
        if (context_.cancelled()) return Context::cancelled_error();
        tree_.planes.clear();
        tree_.plane_begin.assign(1, 0);
        for (const auto& planes : planes_) {
            tree_.planes.insert(tree_.planes.end(), planes.begin(), planes.end());
            tree_.plane_begin.push_back(static_cast<std::uint32_t>(tree_.planes.size()));
        }
        tree_.levels = measure_levels(tree_, context_);
        return Done{};
    }

  private:
    void visit(NodeIndex node, const Cell& cell, const std::vector<mesh::FaceIndex>& triangles,
               std::uint8_t inside, std::int32_t at_low) {
        if (triangles.empty() || context_.cancelled()) return;
        const CellBox box = tree_.frame.box(cell);
        std::vector<DirectionCode> candidates;
        if (tree_.nodes[node] == Node::split) {
            WindingGrid winding{};
            if (tree_.is_solid) winding = wind(tree_.mesh, triangles, box, at_low);
            auto& octants = buffers_[static_cast<std::size_t>(cell.level)];
            for (auto& octant : octants) octant.clear();
            distribute(tree_.mesh, triangles, box, octants);
            for (int i = 0; i < 8; ++i) {
                const NodeIndex child = tree_.link[node] + static_cast<unsigned>(i);
                visit(child, cell.child(i), octants[static_cast<std::size_t>(i)], inside_corners(winding, i),
                      winding_at_corner(winding, i, 0));
                for (const BoundingPlane& plane : planes_[child]) candidates.push_back(plane.direction);
            }
        }
        content_.gather(tree_.mesh, box, triangles, inside);
        if (tree_.nodes[node] == Node::gray)
            for (const Vec3& n : content_.normals())
                if (!(n == Vec3{})) candidates.push_back(code_of(nearest_direction(n.x, n.y, n.z)));
        if (content_.points().empty()) return;
        std::sort(candidates.begin(), candidates.end());
        candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());
        for (const DirectionCode code : thinned(candidates, cell.level, box)) {
            const Direction u = direction_of(code);
            planes_[node].push_back(BoundingPlane::at(u, content_.points().support(u)));
        }
    }

    std::vector<DirectionCode> thinned(const std::vector<DirectionCode>& candidates, int level,
                                       const CellBox& box) const {
        if (candidates.size() <= 1) return candidates;
        double most = std::min(options_.part, 1.0) * static_cast<double>(tree_.mesh.triangles.size()) /
                      std::ldexp(1.0, level);
        while (most >= static_cast<double>(candidates.size())) most /= 2;
        std::vector<Angles> angles;
        for (const DirectionCode code : candidates) {
            // Directions are in cell coordinates; angles are those of the world.
            const Direction u = direction_of(code);
            const Vec3 n{u.a / static_cast<double>(box.side(0)), u.b / static_cast<double>(box.side(1)),
                         u.c / static_cast<double>(box.side(2))};
            angles.push_back({std::acos(std::clamp(n.z / length(n), -1.0, 1.0)), std::atan2(n.y, n.x)});
        }
        std::vector<DirectionCode> kept;
        for (const std::size_t i :
             medoids_of(angles, std::max<std::size_t>(1, static_cast<std::size_t>(most))))
            kept.push_back(candidates[i]);
        std::sort(kept.begin(), kept.end());
        kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
        return kept;
    }

    BpOctree& tree_;
    const KMedoidsOptions& options_;
    const Context& context_;
    NodeContent content_;
    std::vector<std::vector<BoundingPlane>> planes_;  ///< per node
    std::vector<std::array<std::vector<mesh::FaceIndex>, 8>> buffers_;
};

}  // namespace

Status choose_by_k_medoids(BpOctree& tree, const KMedoidsOptions& options, const Context& context) {
    return KMedoids(tree, options, context).run();
}

}  // namespace octavo::bp_octree
