// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <octavo/hexmesh/to_polyhedra.hpp>
#include <octavo/mesh/hex_sides.hpp>
#include <octavo/mesh/material_names.hpp>

namespace octavo::hexmesh {
namespace {

using mesh::CellIndex;
using mesh::NodeIndex;

constexpr std::uint32_t no_cell = ~std::uint32_t{0};

/// Nodes in the middle of edges, by the ends of the edge.
class Middles {
  public:
    explicit Middles(std::size_t nodes) : may_have_(nodes) {}

    void add(NodeIndex a, NodeIndex b, NodeIndex middle) {
        entries_.push_back({key(a, b), middle});
        may_have_[std::min(a, b)] = true;
    }
    void sort() { std::sort(entries_.begin(), entries_.end()); }
    /// no_cell when there is none.
    NodeIndex find(NodeIndex a, NodeIndex b) const {
        const NodeIndex lower = std::min(a, b);
        if (lower >= may_have_.size() || !may_have_[lower]) return no_cell;
        const auto at =
            std::lower_bound(entries_.begin(), entries_.end(), std::pair(key(a, b), NodeIndex{0}));
        return at != entries_.end() && at->first == key(a, b) ? at->second : no_cell;
    }

  private:
    static std::uint64_t key(NodeIndex a, NodeIndex b) {
        return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b);
    }
    std::vector<std::pair<std::uint64_t, NodeIndex>> entries_;
    std::vector<bool> may_have_;
};

struct Face {
    std::uint32_t owner, neighbour;    ///< no_cell outside
    std::array<NodeIndex, 4> corners;  ///< seen from outside the owner
};

class Polyhedra {
  public:
    Polyhedra(const mesh::HexMesh& mesh, std::span<const std::string> names)
        : mesh_(mesh),
          materials_(mesh::materials_of(mesh)),
          names_(mesh::name_materials(materials_, names, mesh::word_rules())),
          edges_(mesh.node_count()) {}

    mesh::PolyhedralMesh run() {
        for (NodeIndex node = 0; node < mesh_.node_count(); ++node)
            result_.points.push_back(mesh_.position(node));
        for (const mesh::EdgeHangingNode& node : mesh_.edge_hanging)
            edges_.add(node.masters[0], node.masters[1], node.node);
        edges_.sort();
        find_faces();
        edges_.sort();  // with the middles that half-covered sides needed
        write_faces();
        fill_zones();
        for (const octree::CellKey cell : mesh_.cells) result_.cell_level.push_back(cell.level());
        result_.cells = static_cast<std::uint32_t>(mesh_.cell_count());
        return std::move(result_);
    }

  private:
    void find_faces() {
        const mesh::AllSides sides = mesh::all_sides(mesh_);
        for (const mesh::InnerSide& inner : sides.inner) {
            const CellIndex cell = inner.side.cell, other = inner.other;
            Face face{std::min(cell, other), std::max(cell, other), inner.side.corners};
            // The corners run counter-clockwise seen from outside `cell`.
            if (face.owner != cell) std::swap(face.corners[1], face.corners[3]);
            inner_.push_back(face);
        }
        for (const mesh::HexSide& side : sides.boundary) outer_.push_back({side.cell, no_cell, side.corners});
        for (const mesh::CoveredInPart& part : sides.covered_in_part) add_rest(part);
        std::stable_sort(outer_.begin(), outer_.end(),
                         [](const Face& a, const Face& b) { return a.owner < b.owner; });
    }

    /// The quarters of a larger side that smaller cells do not cover.
    void add_rest(const mesh::CoveredInPart& part) {
        const std::array<NodeIndex, 4>& corners = part.side.corners;
        std::array<NodeIndex, 4> middles{};
        for (std::size_t i = 0; i < 4; ++i) middles[i] = middle_of_edge(corners[i], corners[(i + 1) % 4]);
        for (std::size_t i = 0; i < 4; ++i)
            if (!part.covered[i])
                outer_.push_back(
                    {part.side.cell, no_cell, {corners[i], middles[i], part.centre, middles[(i + 3) % 4]}});
    }

    /// The node there, or a new point: where cells were carved away it may be needed by this face alone.
    NodeIndex middle_of_edge(NodeIndex a, NodeIndex b) {
        const NodeIndex found = edges_.find(a, b);
        if (found != no_cell) return found;
        const auto [at, fresh] = added_.try_emplace({std::min(a, b), std::max(a, b)},
                                                    static_cast<NodeIndex>(result_.points.size()));
        if (fresh) {
            result_.points.push_back(0.5 * (result_.points[a] + result_.points[b]));
            edges_to_add_.push_back({{a, b}, at->second});
        }
        return at->second;
    }

    void write_faces() {
        for (const auto& [ends, node] : edges_to_add_) edges_.add(ends[0], ends[1], node);
        edges_.sort();
        std::sort(inner_.begin(), inner_.end(), [](const Face& a, const Face& b) {
            return a.owner != b.owner ? a.owner < b.owner : a.neighbour < b.neighbour;
        });
        for (const Face& face : inner_) write(face);
        for (const Face& face : inner_) result_.neighbour.push_back(face.neighbour);
        inner_ = {};
        std::stable_sort(outer_.begin(), outer_.end(),
                         [&](const Face& a, const Face& b) { return patch_of(a.owner) < patch_of(b.owner); });
        for (std::size_t i = 0; i < outer_.size(); ++i) {
            const std::uint32_t patch = patch_of(outer_[i].owner);
            if (i == 0 || patch != patch_of(outer_[i - 1].owner))
                result_.patches.push_back(
                    {name_of(patch), static_cast<std::uint32_t>(result_.owner.size()), 0});
            ++result_.patches.back().faces;
            write(outer_[i]);
        }
    }

    void write(const Face& face) {
        for (std::size_t i = 0; i < 4; ++i) {
            result_.face_points.push_back(face.corners[i]);
            write_inside_edge(face.corners[i], face.corners[(i + 1) % 4]);
        }
        result_.face_begin.push_back(static_cast<std::uint32_t>(result_.face_points.size()));
        result_.owner.push_back(face.owner);
    }

    void write_inside_edge(NodeIndex a, NodeIndex b) {
        const NodeIndex middle = edges_.find(a, b);
        if (middle == no_cell) return;
        write_inside_edge(a, middle);
        result_.face_points.push_back(middle);
        write_inside_edge(middle, b);
    }

    /// The first solid of the cell, or no_cell outside.
    std::uint32_t patch_of(CellIndex cell) const {
        const mesh::SolidSet& set = mesh_.set_of(cell);
        std::uint32_t first = no_cell;
        if (!set.inside.empty()) first = set.inside[0];
        if (!set.boundary.empty()) first = std::min(first, set.boundary[0]);
        return first;
    }

    const std::string& name_of(std::uint32_t solid) const {
        return solid == no_cell ? names_.outside : names_.solids[solid];
    }

    void fill_zones() {
        for (const std::string& name : names_.materials) result_.zones.push_back({name, {}});
        for (CellIndex cell = 0; cell < mesh_.cell_count(); ++cell)
            result_.zones[materials_.of(mesh_, cell)].cells.push_back(cell);
    }

    const mesh::HexMesh& mesh_;
    mesh::Materials materials_;
    mesh::MaterialNames names_;
    Middles edges_;
    std::map<std::pair<NodeIndex, NodeIndex>, NodeIndex> added_;
    std::vector<std::pair<std::array<NodeIndex, 2>, NodeIndex>> edges_to_add_;
    std::vector<Face> inner_, outer_;
    mesh::PolyhedralMesh result_;
};

}  // namespace

mesh::PolyhedralMesh to_polyhedra(const mesh::HexMesh& mesh, std::span<const std::string> names) {
    return Polyhedra(mesh, names).run();
}

}  // namespace octavo::hexmesh
