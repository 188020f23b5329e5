// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include <octavo/hexmesh/cell_tree.hpp>
#include <octavo/hexmesh/to_polyhedra.hpp>

namespace octavo::hexmesh {
namespace {

using mesh::CellIndex;
using mesh::NodeIndex;

constexpr std::uint32_t no_cell = ~std::uint32_t{0};

/// Corners of the side `high` of `axis` of a cube, counter-clockwise seen from outside.
std::array<unsigned, 4> corners_of_side(int axis, bool high) {
    const unsigned a = 1U << axis, b = 1U << (axis + 1) % 3, c = 1U << (axis + 2) % 3;
    if (high) return {a, a | b, a | b | c, a | c};
    return {0, c, b | c, b};
}

/// Nodes in the middle of edges and faces, by the ends of the edge or of a diagonal of the face.
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
          names_(names),
          tree_(mesh.cells),
          edges_(mesh.nodes.size()),
          faces_(mesh.nodes.size()) {}

    mesh::PolyhedralMesh run() {
        for (NodeIndex node = 0; node < mesh_.node_count(); ++node)
            result_.points.push_back(mesh_.position(node));
        for (const mesh::EdgeHangingNode& node : mesh_.edge_hanging)
            edges_.add(node.masters[0], node.masters[1], node.node);
        for (const mesh::FaceHangingNode& node : mesh_.face_hanging) {
            faces_.add(node.masters[0], node.masters[3], node.node);
            faces_.add(node.masters[1], node.masters[2], node.node);
        }
        edges_.sort();
        faces_.sort();
        find_faces();
        edges_.sort();  // with the middles that half-covered sides needed
        write_faces();
        name_zones();
        for (const octree::CellKey cell : mesh_.cells) result_.cell_level.push_back(cell.level());
        result_.cells = static_cast<std::uint32_t>(mesh_.cells.size());
        return std::move(result_);
    }

  private:
    /// Which quarters of each side of each cell have a neighbour: four bits a side.
    using Covered = std::array<std::uint8_t, 6>;

    static std::size_t side_index(int axis, bool high) { return static_cast<std::size_t>(2 * axis + high); }

    void find_faces() {
        std::vector<Covered> covered(mesh_.cells.size(), Covered{});
        tree_.for_each_leaf([&](CellIndex cell, int, const CellTree::Block& block) {
            for (int axis = 0; axis < 3; ++axis) {
                const unsigned a = 1U << axis, b = 1U << (axis + 1) % 3, c = 1U << (axis + 2) % 3;
                const CellTree::Ref next = block[a];
                if (next == CellTree::none) continue;
                if (CellTree::is_leaf(next)) {
                    add_between(cell, next, axis, mesh_.corners[cell], true);
                    covered[cell][side_index(axis, true)] = 15;
                    covered[next][side_index(axis, false)] |= quarter_of(cell, axis, block.larger >> a & 1);
                    continue;
                }
                for (unsigned quarter = 0; quarter < 4; ++quarter) {
                    const unsigned octant = (quarter & 1 ? b : 0) | (quarter & 2 ? c : 0);
                    const CellTree::Ref small = tree_.octant(next, static_cast<int>(octant));
                    if (small == CellTree::none) continue;
                    OCTAVO_CHECK(CellTree::is_leaf(small), "the mesh is not balanced");
                    add_between(cell, small, axis, mesh_.corners[small], false);
                    covered[cell][side_index(axis, true)] |= static_cast<std::uint8_t>(1U << quarter);
                    covered[small][side_index(axis, false)] = 15;
                }
            }
        });
        for (CellIndex cell = 0; cell < mesh_.cells.size(); ++cell)
            for (int axis = 0; axis < 3; ++axis)
                for (const bool high : {false, true})
                    add_boundary(cell, axis, high, covered[cell][side_index(axis, high)]);
    }

    /// The quarters of the low side of the next cell along `axis`, perhaps a larger one, that `cell` covers.
    std::uint8_t quarter_of(CellIndex cell, int axis, bool is_larger) const {
        if (!is_larger) return 15;
        const int octant = mesh_.cells[cell].child_index();
        const unsigned b = octant >> (axis + 1) % 3 & 1, c = octant >> (axis + 2) % 3 & 1;
        return static_cast<std::uint8_t>(1U << (b + 2 * c));
    }

    /// The face between `below` and `above` along `axis`: the high side of the smaller cell when that is below, else
    /// its low side.
    void add_between(CellIndex below, CellIndex above, int axis, const std::array<NodeIndex, 8>& smaller,
                     bool smaller_is_below) {
        Face face{std::min(below, above), std::max(below, above), {}};
        const std::array<unsigned, 4> corners = corners_of_side(axis, smaller_is_below);
        for (std::size_t i = 0; i < 4; ++i) face.corners[i] = smaller[corners[i]];
        // The corners run counter-clockwise seen from outside the smaller cell.
        if ((face.owner == below) != smaller_is_below) std::swap(face.corners[1], face.corners[3]);
        inner_.push_back(face);
    }

    void add_boundary(CellIndex cell, int axis, bool high, unsigned covered) {
        if (covered == 15) return;
        const std::array<unsigned, 4> side = corners_of_side(axis, high);
        Face face{cell, no_cell, {}};
        for (std::size_t i = 0; i < 4; ++i) face.corners[i] = mesh_.corners[cell][side[i]];
        if (covered == 0) {
            outer_.push_back(face);
            return;
        }
        // Smaller cells cover part of the side: the rest is its other quarters.
        const NodeIndex centre = faces_.find(face.corners[0], face.corners[2]);
        OCTAVO_CHECK(centre != no_cell, "a side that smaller cells touch has a node in its middle");
        std::array<NodeIndex, 4> middles{};
        for (std::size_t i = 0; i < 4; ++i)
            middles[i] = middle_of_edge(face.corners[i], face.corners[(i + 1) % 4]);
        for (std::size_t i = 0; i < 4; ++i) {
            const unsigned b = side[i] >> (axis + 1) % 3 & 1, c = side[i] >> (axis + 2) % 3 & 1;
            if (covered >> (b + 2 * c) & 1) continue;
            outer_.push_back({cell, no_cell, {face.corners[i], middles[i], centre, middles[(i + 3) % 4]}});
        }
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

    std::string name_of(std::uint32_t solid) const {
        if (solid == no_cell) return "outside";
        return solid < names_.size() ? names_[solid] : "solid_" + std::to_string(solid);
    }

    void name_zones() {
        std::map<std::vector<std::uint32_t>, std::vector<std::uint32_t>> zones;
        for (CellIndex cell = 0; cell < mesh_.cells.size(); ++cell) {
            const mesh::SolidSet& set = mesh_.set_of(cell);
            std::vector<std::uint32_t> solids = set.inside;
            solids.insert(solids.end(), set.boundary.begin(), set.boundary.end());
            std::sort(solids.begin(), solids.end());
            zones[solids].push_back(cell);
        }
        for (auto& [solids, cells] : zones) {
            std::string name = solids.empty() ? name_of(no_cell) : "";
            for (const std::uint32_t solid : solids) name += (name.empty() ? "" : "+") + name_of(solid);
            result_.zones.push_back({std::move(name), std::move(cells)});
        }
    }

    const mesh::HexMesh& mesh_;
    std::span<const std::string> names_;
    CellTree tree_;
    Middles edges_, faces_;
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
