// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <octavo/hexmesh/buffer_layer.hpp>
#include <octavo/hexmesh/quality.hpp>
#include <octavo/mesh/hex_sides.hpp>

namespace octavo::hexmesh {
namespace {

using mesh::CellIndex;
using mesh::HexMesh;
using mesh::HexSide;
using mesh::NodeIndex;

/// How thick the layer is, in sides of the smallest cell at a node: cells between two layers keep 0.4. Where that folds
/// a cell the layer is made half as thick round it, again and again; in the limit all cells are positive, since a
/// twin lies behind all sides at its node, unless a hanging twin does not.
constexpr double usual_thickness = 0.3;
constexpr int halvings = 6;
constexpr NodeIndex no_node = ~NodeIndex{0};

using Edge = std::pair<NodeIndex, NodeIndex>;
Edge edge_of(NodeIndex a, NodeIndex b) { return {std::min(a, b), std::max(a, b)}; }

/// The edges of the boundary's sides, and how many sides have each.
class BoundaryEdges {
  public:
    explicit BoundaryEdges(const std::vector<HexSide>& sides) {
        for (const HexSide& side : sides)
            for (std::size_t i = 0; i < 4; ++i)
                edges_.push_back(edge_of(side.corners[i], side.corners[(i + 1) % 4]));
        std::sort(edges_.begin(), edges_.end());
    }
    std::size_t count(NodeIndex a, NodeIndex b) const {
        const auto [first, last] = std::equal_range(edges_.begin(), edges_.end(), edge_of(a, b));
        return static_cast<std::size_t>(last - first);
    }
    const std::vector<Edge>& all() const { return edges_; }

  private:
    std::vector<Edge> edges_;
};

/// Whether each edge has two sides; where a large side meets two smaller ones, one large and one small side.
bool is_surface(const BoundaryEdges& edges, const HexMesh& mesh) {
    std::vector<Edge> single;
    for (std::size_t i = 0, end = 0; i < edges.all().size(); i = end) {
        while (end < edges.all().size() && edges.all()[end] == edges.all()[i]) ++end;
        if (end - i > 2) return false;
        if (end - i == 1) single.push_back(edges.all()[i]);
    }
    std::size_t explained = 0;
    for (const mesh::EdgeHangingNode& hanging : mesh.edge_hanging) {
        const auto [a, b] = hanging.masters;
        if (edges.count(a, b) != 1) continue;
        if (edges.count(a, hanging.node) != 1 || edges.count(hanging.node, b) != 1) return false;
        explained += 3;
    }
    return explained == single.size();
}

class LayerBuilder {
  public:
    LayerBuilder(const HexMesh& mesh, const std::vector<HexSide>& sides)
        : mesh_(mesh), sides_(sides), edges_(sides), twin_(mesh.node_count(), no_node) {}

    /// The mesh with the layer, or none when some cell stays folded or there are more nodes than numbers.
    std::optional<HexMesh> run() {
        HexMesh layered;
        layered.lattice = mesh_.lattice;
        layered.sets = mesh_.sets;
        layered.set_of_cell = mesh_.set_of_cell;
        layered.constraints_are_direct = mesh_.constraints_are_direct;
        for (NodeIndex node = 0; node < mesh_.node_count(); ++node)
            layered.positions.push_back(mesh_.position(node));
        if (!add_twins(layered.positions)) return std::nullopt;
        layered.corners = mesh_.corners;
        for (auto& corners : layered.corners)
            for (NodeIndex& corner : corners) corner = inner(corner);
        for (const HexSide& side : sides_) {
            layered.corners.push_back(cell_on(side));
            layered.set_of_cell.push_back(mesh_.set_of_cell[side.cell]);
        }
        add_hanging(layered);
        for (int halving = 0; halving <= halvings; ++halving) {
            place_twins(layered);
            if (!thin_out_at_folded_cells(layered)) return layered;
        }
        return std::nullopt;
    }
    bool is_surface() const { return hexmesh::is_surface(edges_, mesh_); }

  private:
    NodeIndex inner(NodeIndex node) const { return twin_[node] == no_node ? node : twin_[node]; }

    std::array<NodeIndex, 8> cell_on(const HexSide& side) const {
        const auto& c = side.corners;
        return {twin_[c[0]], twin_[c[1]], twin_[c[3]], twin_[c[2]], c[0], c[1], c[3], c[2]};
    }

    /// A twin for each node of the boundary, and the way to it: inwards from all sides at the node at once, the sum of
    /// their directions, each counted once. False when the twins are more than there are numbers for.
    bool add_twins(std::vector<Vec3>& positions) {
        struct AtNode {
            std::array<Vec3, 6> directions{};
            std::size_t count = 0;
            double shortest = std::numeric_limits<double>::max();
        };
        std::vector<AtNode> at_nodes;
        for (const HexSide& side : sides_) {
            const auto at = [&](std::size_t i) { return positions[side.corners[i % 4]]; };
            const Vec3 outwards = cross(at(2) - at(0), at(3) - at(1));
            const Vec3 inwards = (-1 / length(outwards)) * outwards;
            for (std::size_t i = 0; i < 4; ++i) {
                NodeIndex& twin = twin_[side.corners[i]];
                if (twin == no_node) {
                    if (mesh_.node_count() + doubled_.size() >= no_node) return false;
                    twin = static_cast<NodeIndex>(mesh_.node_count() + doubled_.size());
                    doubled_.push_back(side.corners[i]);
                    at_nodes.emplace_back();
                }
                AtNode& node = at_nodes[twin - mesh_.node_count()];
                node.shortest =
                    std::min({node.shortest, length(at(i + 1) - at(i)), length(at(i + 3) - at(i))});
                constexpr double same = 0.99;
                const auto known = node.directions.begin() + static_cast<std::ptrdiff_t>(node.count);
                const bool is_known = std::any_of(node.directions.begin(), known,
                                                  [&](const Vec3& d) { return dot(d, inwards) > same; });
                if (!is_known && node.count < node.directions.size()) node.directions[node.count++] = inwards;
            }
        }
        for (const AtNode& node : at_nodes) {
            Vec3 sum;
            for (std::size_t i = 0; i < node.count; ++i) sum = sum + node.directions[i];
            way_.push_back(node.shortest * sum);
        }
        thickness_.assign(doubled_.size(), usual_thickness);
        positions.resize(positions.size() + doubled_.size());
        return true;
    }

    void place_twins(HexMesh& layered) const {
        std::vector<Vec3>& positions = layered.positions;
        for (std::size_t i = 0; i < doubled_.size(); ++i)
            positions[twin_[doubled_[i]]] = positions[doubled_[i]] + thickness_[i] * way_[i];
        for (const mesh::EdgeHangingNode& h : layered.edge_hanging)
            positions[h.node] = 0.5 * (positions[h.masters[0]] + positions[h.masters[1]]);
        for (const mesh::FaceHangingNode& h : layered.face_hanging) {
            Vec3 sum;
            for (const NodeIndex master : h.masters) sum = sum + positions[master];
            positions[h.node] = 0.25 * sum;
        }
    }

    /// True when there were any.
    bool thin_out_at_folded_cells(const HexMesh& layered) {
        std::vector<std::uint8_t> is_folded_at(layered.node_count(), 0);
        bool any = false;
        for (CellIndex cell = 0; cell < layered.cell_count(); ++cell) {
            if (is_positive_everywhere(corners_of(layered, cell))) continue;
            any = true;
            for (const NodeIndex corner : layered.corners[cell]) is_folded_at[corner] = 1;
        }
        if (!any) return false;
        for (const mesh::EdgeHangingNode& h : layered.edge_hanging)
            if (is_folded_at[h.node])
                for (const NodeIndex master : h.masters) is_folded_at[master] = 1;
        for (std::size_t i = 0; i < doubled_.size(); ++i)
            if (is_folded_at[twin_[doubled_[i]]]) thickness_[i] /= 2;
        return true;
    }

    /// A node of the boundary hangs on it where a larger side has the edge; its twin hangs as the node did.
    void add_hanging(HexMesh& layered) const {
        for (const mesh::EdgeHangingNode& hanging : mesh_.edge_hanging) {
            const auto [a, b] = hanging.masters;
            layered.edge_hanging.push_back({inner(hanging.node), {inner(a), inner(b)}});
            if (twin_[hanging.node] != no_node && edges_.count(a, b) > 0)
                layered.edge_hanging.push_back(hanging);
        }
        for (mesh::FaceHangingNode hanging : mesh_.face_hanging) {
            hanging.node = inner(hanging.node);
            for (NodeIndex& master : hanging.masters) master = inner(master);
            layered.face_hanging.push_back(hanging);
        }
    }

    const HexMesh& mesh_;
    const std::vector<HexSide>& sides_;
    BoundaryEdges edges_;
    std::vector<NodeIndex> twin_;     ///< of nodes on the boundary
    std::vector<NodeIndex> doubled_;  ///< these nodes
    std::vector<Vec3> way_;           ///< from each to its twin, for thickness 1
    std::vector<double> thickness_;   ///< per doubled node
};

}  // namespace

bool insert_buffer_layer(HexMesh& mesh) {
    const mesh::BoundarySides boundary = mesh::boundary_sides(mesh);
    if (boundary.partly_covered > 0 || boundary.sides.empty()) return false;
    LayerBuilder builder(mesh, boundary.sides);
    if (!builder.is_surface()) return false;
    std::optional<HexMesh> layered = builder.run();
    if (!layered) return false;
    mesh = std::move(*layered);
    return true;
}

}  // namespace octavo::hexmesh
