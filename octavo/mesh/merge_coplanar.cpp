// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/exact/int128.hpp>
#include <octavo/exact/orient.hpp>
#include <octavo/exact/plane.hpp>
#include <octavo/mesh/merge_coplanar.hpp>
#include <octavo/mesh/topology.hpp>

namespace octavo::mesh {
namespace {

class CoplanarMerger {
  public:
    explicit CoplanarMerger(const LatticeMesh& mesh)
        : mesh_(mesh),
          edges_(build_edges(mesh.triangles, mesh.points.size())),
          face_of_(mesh.triangles.size(), no_index),
          traced_(3 * mesh.triangles.size()) {}

    PolygonMesh merge() {
        for (const exact::Point p : mesh_.points) result_.vertices.push_back(mesh_.lattice.to_world(p));
        // Facets with area first: one without may be part of any face at its line.
        for (FaceIndex seed = 0; seed < face_of_.size(); ++seed) {
            if (face_of_[seed] != no_index || !has_edges(seed)) continue;
            const exact::Plane plane = plane_of(seed);
            if (plane.degenerate()) continue;
            grow(seed, plane);
            if (face_.size() == 1 || !add_face(plane))
                for (const FaceIndex facet : face_) add_triangle(facet);
        }
        for (FaceIndex facet = 0; facet < face_of_.size(); ++facet)
            if (face_of_[facet] == no_index && has_edges(facet)) add_triangle(facet);
        return std::move(result_);
    }

  private:
    bool has_edges(FaceIndex facet) const { return edges_.edge_of_side[std::size_t{3} * facet] != no_index; }
    exact::Point corner(FaceIndex facet, unsigned k) const { return mesh_.points[mesh_.triangles[facet][k]]; }
    exact::Plane plane_of(FaceIndex facet) const {
        return exact::Plane::through(corner(facet, 0), corner(facet, 1), corner(facet, 2));
    }

    /// The other side of a side's edge, where exactly two sides run along it, opposite ways; no_index elsewhere.
    SideIndex across(SideIndex side) const {
        const auto sides = edges_.sides_of(edges_.edge_of_side[side]);
        if (sides.size() != 2) return no_index;
        const SideIndex other = sides[0] == side ? sides[1] : sides[0];
        return runs_upward(mesh_.triangles, side) != runs_upward(mesh_.triangles, other) ? other : no_index;
    }

    /// Collects in face_ the facets that make one face with the seed.
    void grow(FaceIndex seed, const exact::Plane& plane) {
        const int axis = plane.dominant_axis();
        const exact::Sign facing = exact::sign_of(plane.normal(axis));
        face_.assign(1, seed);
        face_of_[seed] = seed;
        for (std::size_t i = 0; i < face_.size(); ++i)
            for (SideIndex side = 3 * face_[i]; side < 3 * face_[i] + 3; ++side) {
                const SideIndex other = across(side);
                if (other == no_index || face_of_[other / 3] != no_index) continue;
                const FaceIndex facet = other / 3;
                const exact::Point apex = mesh_.points[apex_of(other)];
                if (exact::sign_of(plane.value_at(apex)) != exact::Sign::zero) continue;
                const exact::Sign turn =
                    exact::orient2d(axis, corner(facet, 0), corner(facet, 1), corner(facet, 2));
                if (turn != facing && turn != exact::Sign::zero) continue;
                face_of_[facet] = seed;
                face_.push_back(facet);
            }
    }
    VertexIndex apex_of(SideIndex side) const {
        const SideIndex apex = next_side(next_side(side));
        return mesh_.triangles[apex / 3][apex % 3];
    }

    /// Whether the side leads to a facet of the same face.
    SideIndex inner_across(SideIndex side) const {
        const SideIndex other = across(side);
        return other != no_index && face_of_[other / 3] == face_of_[side / 3] ? other : no_index;
    }

    /// Strings together the contours of face_; false when they are not one outer contour and holes.
    bool add_face(const exact::Plane& plane) {
        contours_.clear();
        std::size_t outer = 0, outers = 0;
        for (const FaceIndex facet : face_)
            for (SideIndex start = 3 * facet; start < 3 * facet + 3; ++start) {
                if (traced_[start] || inner_across(start) != no_index) continue;
                const exact::Sign turn = trace(start, plane);
                if (turn == exact::Sign::zero) return false;
                if (turn == exact::Sign::positive) ++outers, outer = contours_.size() - 1;
            }
        if (outers != 1) return false;
        std::swap(contours_[0], contours_[outer]);
        for (const std::vector<VertexIndex>& contour : contours_) add_contour(contour);
        result_.face_begin.push_back(static_cast<std::uint32_t>(result_.contour_begin.size() - 1));
        return true;
    }

    /// Appends the contour that a side begins; which way it runs, seen from the plane's front.
    exact::Sign trace(SideIndex start, const exact::Plane& plane) {
        std::vector<VertexIndex>& contour = contours_.emplace_back();
        const int axis = plane.dominant_axis(), i = (axis + 1) % 3, j = (axis + 2) % 3;
        // Twice the area: coordinates relative to the first corner have 27 bits, their products 54, and there are
        // fewer than 2^33 of them.
        exact::int128 area = 0;
        static_assert(2 * (exact::coordinate_bits + 1) + 33 < 127);
        const exact::Point origin = mesh_.points[mesh_.triangles[start / 3][start % 3]];
        SideIndex side = start;
        do {
            traced_[side] = true;
            const VertexIndex from = mesh_.triangles[side / 3][side % 3];
            side = next_side(side);
            const VertexIndex to = mesh_.triangles[side / 3][side % 3];
            contour.push_back(from);
            const exact::Point p = mesh_.points[from], q = mesh_.points[to];
            area += exact::wide(p[i] - origin[i]) * (q[j] - origin[j]) -
                    exact::wide(p[j] - origin[j]) * (q[i] - origin[i]);
            for (SideIndex other = inner_across(side); other != no_index; other = inner_across(side))
                side = next_side(other);
        } while (side != start);
        return exact::sign_of(area) * exact::sign_of(plane.normal(axis));
    }

    void add_contour(std::span<const VertexIndex> contour) {
        result_.corners.insert(result_.corners.end(), contour.begin(), contour.end());
        result_.contour_begin.push_back(static_cast<std::uint32_t>(result_.corners.size()));
    }
    void add_triangle(FaceIndex facet) {
        add_contour(mesh_.triangles[facet]);
        result_.face_begin.push_back(static_cast<std::uint32_t>(result_.contour_begin.size() - 1));
    }

    const LatticeMesh& mesh_;
    EdgeTable edges_;
    std::vector<FaceIndex> face_of_;  ///< the seed of each facet's face
    std::vector<bool> traced_;        ///< sides that are in a contour
    std::vector<FaceIndex> face_;     ///< facets of the face at hand
    std::vector<std::vector<VertexIndex>> contours_;
    PolygonMesh result_;
};

}  // namespace

PolygonMesh merge_coplanar(const LatticeMesh& mesh) { return CoplanarMerger(mesh).merge(); }

}  // namespace octavo::mesh
