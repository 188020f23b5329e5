// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include <octavo/hexmesh/buffer_layer.hpp>
#include <octavo/hexmesh/fit.hpp>
#include <octavo/hexmesh/separating_surface.hpp>
#include <octavo/mesh/used_vertices.hpp>

namespace octavo::hexmesh {
namespace {

using mesh::CellIndex;
using mesh::NodeIndex;

/// Lists of indices, one for each node, one after the other.
class Lists {
  public:
    Lists() = default;
    /// `pairs` are (node, entry); duplicates are dropped.
    Lists(std::vector<std::pair<NodeIndex, std::uint32_t>> pairs, std::size_t nodes) : begin_(nodes + 1, 0) {
        std::sort(pairs.begin(), pairs.end());
        pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
        for (const auto& [node, entry] : pairs) {
            ++begin_[node + 1];
            entries_.push_back(entry);
        }
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    }
    std::span<const std::uint32_t> operator[](NodeIndex node) const {
        return {entries_.data() + begin_[node], begin_[node + 1] - begin_[node]};
    }

  private:
    std::vector<std::size_t> begin_;
    std::vector<std::uint32_t> entries_;
};

using Pairs = std::vector<std::pair<NodeIndex, std::uint32_t>>;

/// A hanging node and its masters, two or four.
struct Hanging {
    NodeIndex node = 0;
    std::array<NodeIndex, 4> masters{};
    std::size_t count = 0;
};

std::vector<Hanging> hanging_of(const mesh::HexMesh& mesh) {
    std::vector<Hanging> all;
    for (const mesh::EdgeHangingNode& h : mesh.edge_hanging)
        all.push_back({h.node, {h.masters[0], h.masters[1]}, 2});
    for (const mesh::FaceHangingNode& h : mesh.face_hanging) all.push_back({h.node, h.masters, 4});
    return all;
}

/// Facets near each other whose normals differ by less belong to one smooth surface; chords of round things do at any
/// sensible fineness.
constexpr double smooth_cosine = 0.866;  // 30 degrees

enum class Role : std::uint8_t { fixed, inner, surface, hanging };

class Fitter {
  public:
    Fitter(mesh::HexMesh& mesh, const FitOptions& options)
        : mesh_(mesh),
          options_(options),
          hanging_(hanging_of(mesh)),
          role_(mesh.node_count(), Role::fixed),
          surface_(separating_nodes(mesh)) {
        if (mesh.positions.empty()) {
            mesh.positions.reserve(mesh.nodes.size());
            for (NodeIndex node = 0; node < mesh.nodes.size(); ++node)
                mesh.positions.push_back(mesh.lattice.to_world(mesh.nodes[node]));
        }
        connect();
        find_surface();
        find_layers();
        quality_ = scaled_jacobians(mesh);
    }

    const SeparatingNodes& surface() const { return surface_; }
    std::vector<Vec3> surface_positions() const {
        std::vector<Vec3> points;
        for (const NodeIndex node : surface_.nodes) points.push_back(mesh_.positions[node]);
        return points;
    }

    /// Where each surface node would like to be before it is drawn to the surface: half way to the mean of its
    /// neighbours there; where it is when the surface turns between them, for smoothing would round edges off.
    std::vector<Vec3> smoothed(const std::vector<query::Closest>& nearest) const {
        std::vector<Vec3> points;
        for (std::size_t i = 0; i < surface_.nodes.size(); ++i) {
            Vec3 sum;
            double count = 0, least_cosine = 1;
            for (const std::uint32_t next : neighbours_[surface_.nodes[i]]) {
                if (role_[next] != Role::surface) continue;
                sum = sum + mesh_.positions[next], ++count;
                least_cosine = std::min(least_cosine, dot(nearest[i].normal, nearest[place_[next]].normal));
            }
            const Vec3 at = mesh_.positions[surface_.nodes[i]];
            const bool is_smooth = count > 0 && least_cosine > smooth_cosine;
            points.push_back(is_smooth ? 0.5 * at + (0.5 / count) * sum : at);
        }
        return points;
    }

    void move_surface(const std::vector<Vec3>& targets) {
        for (std::size_t i = 0; i < surface_.nodes.size(); ++i) move_towards(surface_.nodes[i], targets[i]);
    }
    void smooth_inside() {
        for (const NodeIndex node : inner_) {
            Vec3 sum;
            const auto neighbours = neighbours_[node];
            for (const std::uint32_t next : neighbours) sum = sum + mesh_.positions[next];
            move_towards(node, (1.0 / static_cast<double>(neighbours.size())) * sum);
        }
    }

  private:
    void connect() {
        Pairs neighbours, cells, dependents;
        for (CellIndex cell = 0; cell < mesh_.cell_count(); ++cell)
            for (unsigned corner = 0; corner < 8; ++corner) {
                const auto& corners = mesh_.corners[cell];
                cells.push_back({corners[corner], cell});
                for (unsigned axis = 0; axis < 3; ++axis)
                    neighbours.push_back({corners[corner], corners[corner ^ 1U << axis]});
            }
        neighbours_ = Lists(std::move(neighbours), mesh_.node_count());
        const Lists own(cells, mesh_.node_count());
        for (std::uint32_t i = 0; i < hanging_.size(); ++i) {
            role_[hanging_[i].node] = Role::hanging;
            for (std::size_t m = 0; m < hanging_[i].count; ++m) {
                dependents.push_back({hanging_[i].masters[m], i});
                for (const std::uint32_t cell : own[hanging_[i].node])
                    cells.push_back({hanging_[i].masters[m], cell});
            }
        }
        cells_ = Lists(std::move(cells), mesh_.node_count());
        dependents_ = Lists(std::move(dependents), mesh_.node_count());
    }

    void find_surface() {
        place_.resize(mesh_.node_count());
        for (std::size_t i = 0; i < surface_.nodes.size(); ++i) {
            role_[surface_.nodes[i]] = Role::surface;
            place_[surface_.nodes[i]] = static_cast<std::uint32_t>(i);
        }
    }

    void find_layers() {
        std::vector<NodeIndex> front = surface_.nodes;
        for (int layer = 0; layer < options_.layers; ++layer) {
            std::vector<NodeIndex> next;
            for (const NodeIndex node : front)
                for (const std::uint32_t neighbour : neighbours_[node])
                    if (role_[neighbour] == Role::fixed) {
                        role_[neighbour] = Role::inner;
                        next.push_back(neighbour);
                    }
            inner_.insert(inner_.end(), next.begin(), next.end());
            front = std::move(next);
        }
        std::sort(inner_.begin(), inner_.end());
    }

    void move_towards(NodeIndex node, Vec3 target) {
        const Vec3 from = mesh_.positions[node];
        for (const double part : {1.0, 0.5, 0.25, 0.125}) {
            place(node, from + part * (target - from));
            if (is_acceptable(node)) return;
        }
        place(node, from);
    }

    void place(NodeIndex node, Vec3 position) {
        mesh_.positions[node] = position;
        for (const std::uint32_t i : dependents_[node]) {
            const Hanging& hanging = hanging_[i];
            Vec3 sum;
            for (std::size_t m = 0; m < hanging.count; ++m) sum = sum + mesh_.positions[hanging.masters[m]];
            mesh_.positions[hanging.node] = (1.0 / static_cast<double>(hanging.count)) * sum;
        }
    }

    /// Notes the new quality of the node's cells if all are good enough.
    bool is_acceptable(NodeIndex node) {
        const auto cells = cells_[node];
        changed_.clear();
        for (const std::uint32_t cell : cells) {
            const CellCorners corners = corners_of(mesh_, cell);
            const double value = scaled_jacobian(corners);
            if (value < std::min(options_.least_quality, quality_[cell])) return false;
            if (!is_positive_everywhere(corners)) return false;
            changed_.push_back(value);
        }
        for (std::size_t i = 0; i < cells.size(); ++i) quality_[cells[i]] = changed_[i];
        return true;
    }

    mesh::HexMesh& mesh_;
    const FitOptions& options_;
    std::vector<Hanging> hanging_;
    Lists neighbours_, cells_,
        dependents_;  ///< per node; cells include those of hanging nodes that depend on it
    std::vector<Role> role_;
    SeparatingNodes surface_;
    std::vector<NodeIndex> inner_;
    std::vector<std::uint32_t> place_;  ///< of surface nodes in `surface_`
    std::vector<double> quality_, changed_;
};

struct Distances {
    double mean = 0, largest = 0;
    std::size_t small = 0;
};

Distances distances_of(const std::vector<query::Closest>& answers, double small) {
    Distances distances;
    for (const query::Closest& answer : answers) {
        distances.mean += answer.distance;
        distances.largest = std::max(distances.largest, answer.distance);
        distances.small += answer.distance <= small;
    }
    if (!answers.empty()) distances.mean /= static_cast<double>(answers.size());
    return distances;
}

}  // namespace

Result<FitReport> fit(mesh::HexMesh& mesh, std::span<const mesh::Mesh> solids, const FitOptions& options,
                      const Context& context) {
    if (!mesh.constraints_are_direct)
        return Error{ErrorCode::bad_input,
                     "a mesh balanced at faces alone cannot be fitted: some nodes hang on nodes that hang "
                     "themselves; balance it at edges or corners",
                     {}};
    const Box3 bounds = mesh::bounds_of_facets(solids);
    if (Status fits = check_size(bounds); !fits) return std::move(fits).error();
    const Result<SeparatingSurfaces> surfaces = SeparatingSurfaces::build(solids, mesh, context);
    if (!surfaces) return surfaces.error();
    const Vec3 extents = bounds.extents();
    const double small = 1e-6 * std::max({extents.x, extents.y, extents.z});

    context.report("fit", 0);
    std::optional<Fitter> fitter(std::in_place, mesh, options);
    const auto nearest_to = [&](const std::vector<Vec3>& points) {
        return (*surfaces)(fitter->surface(), points, context);
    };
    FitReport report;
    std::vector<query::Closest> answers = nearest_to(fitter->surface_positions());
    const Distances before = distances_of(answers, small);
    report.boundary_nodes = fitter->surface().nodes.size();
    report.mean_distance_before = before.mean, report.largest_distance_before = before.largest;
    // Where the cubes fit as they are, a layer and moves would only make corners worse.
    const bool is_on_surface = before.small == report.boundary_nodes;
    const int rounds = is_on_surface ? 0 : options.rounds;
    if (options.buffer_layer == BufferLayer::where_possible && !is_on_surface && insert_buffer_layer(mesh)) {
        report.has_buffer_layer = true;
        fitter.emplace(mesh, options);
        answers = nearest_to(fitter->surface_positions());
    }
    for (int round = 0; round < rounds; ++round) {
        if (context.cancelled()) return Context::cancelled_error();
        std::vector<Vec3> targets;
        for (const query::Closest& answer : answers) targets.push_back(answer.point);
        fitter->move_surface(targets);
        fitter->smooth_inside();
        context.report("fit", static_cast<double>(round + 1) / (rounds + 1));
        // The last rounds only draw nearer.
        answers = nearest_to(round + 3 < rounds ? fitter->smoothed(answers) : fitter->surface_positions());
    }
    if (context.cancelled()) return Context::cancelled_error();
    const Distances after = distances_of(nearest_to(fitter->surface_positions()), small);
    report.mean_distance = after.mean, report.largest_distance = after.largest;
    report.nodes_on_surface = after.small;
    mesh.fractions.clear();
    context.report("fit", 1);
    return report;
}

}  // namespace octavo::hexmesh
