// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include <octavo/exact/lattice.hpp>
#include <octavo/io/face_directions.hpp>
#include <octavo/mesh/repair_steps.hpp>
#include <octavo/mesh/shells.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/triangulate.hpp>
#include <octavo/mesh/used_vertices.hpp>
#include <octavo/mesh/weld.hpp>

namespace octavo::io {
namespace {

using mesh::FaceIndex;
using mesh::Triangle;

/// The corner offsets of a face's contours.
void contours_of(const FaceList& faces, std::size_t face, std::vector<std::uint32_t>& begin) {
    begin.clear();
    for (std::size_t c = 0; c <= faces.contours(face); ++c)
        begin.push_back(static_cast<std::uint32_t>(faces.corners_before(face, c)));
}

/// The faces as triangles on a lattice; none when there is no lattice for them.
std::optional<mesh::RepairSoup> soup_of(std::span<const Vec3> vertices, const FaceList& faces,
                                        std::span<const Vec3> hole_points) {
    mesh::Mesh mesh;
    mesh.vertices.assign(vertices.begin(), vertices.end());
    mesh::RepairSoup soup;
    mesh::Triangulator triangulator;
    std::vector<std::uint32_t> contour_begin;
    for (std::size_t face = 0; face < faces.size(); ++face) {
        contours_of(faces, face, contour_begin);
        for (const Triangle& t : triangulator(vertices, faces.corners(face), contour_begin).triangles) {
            mesh.triangles.push_back(t);
            soup.origin.push_back(static_cast<FaceIndex>(face));
        }
    }
    Box3 bounds = mesh::bounds_of_facets(mesh);
    for (const Vec3& point : hole_points) bounds.add(point);
    const Result<exact::Lattice> lattice = exact::Lattice::fit(bounds);
    if (!lattice) return {};
    mesh = mesh::weld(mesh);
    Result<mesh::Snapped> snapped = mesh::snap(mesh, *lattice);
    if (!snapped) return {};
    soup.points = std::move(snapped->mesh.points);
    for (const Vec3& point : hole_points) soup.points.push_back(lattice->snap(point));
    soup.vertices = std::move(mesh.vertices);
    soup.triangles = std::move(mesh.triangles);
    return soup;
}

/// Of a shell in space: what is directly around it, and whether there is a hole point between them.
struct Region {
    std::uint32_t around = mesh::no_index;
    bool empty = false, is_probe = false;
};

/// Turns shells until each looks to its empty side, and marks those that have none or two.
class Regions {
  public:
    /// `probes` are shells of the soup's last triangles: tiny ones around the hole points.
    Regions(const mesh::RepairSoup& soup, std::size_t surface_triangles)
        : found_(mesh::find_shells(soup.points, soup.triangles,
                                   mesh::build_edges(soup.triangles, soup.points.size()))),
          regions_(found_.shells.size()) {
        for (std::size_t probe = surface_triangles; probe < soup.triangles.size(); probe += 4)
            regions_[found_.of_face[probe]].is_probe = true;
        for (std::uint32_t shell = 0; shell < regions_.size(); ++shell)
            regions_[shell].around = innermost(shell);
        for (std::size_t probe = surface_triangles; probe < soup.triangles.size(); probe += 4) {
            const std::uint32_t around = regions_[found_.of_face[probe]].around;
            if (around == mesh::no_index)
                ++lost_holes_;
            else
                regions_[around].empty = true;
        }
    }

    bool all_closed() const {
        return std::all_of(found_.shells.begin(), found_.shells.end(),
                           [](const mesh::Shell& shell) { return shell.closed; });
    }
    std::size_t lost_holes() const { return lost_holes_; }

    bool is_inner(std::size_t triangle) const {
        const std::uint32_t shell = found_.of_face[triangle];
        return shell != mesh::no_index && empty(shell) == empty(regions_[shell].around);
    }
    bool looks_inwards(std::size_t triangle) const {
        const std::uint32_t shell = found_.of_face[triangle];
        return shell != mesh::no_index && (found_.shells[shell].volume6 > 0) == empty(shell);
    }

  private:
    bool empty(std::uint32_t shell) const { return shell == mesh::no_index || regions_[shell].empty; }

    /// The smallest shell around a shell: it lies itself in the most others. Probes enclose nothing.
    std::uint32_t innermost(std::uint32_t shell) const {
        std::uint32_t best = mesh::no_index;
        for (const mesh::Enclosure& enclosure : found_.shells[shell].enclosures)
            if (!regions_[enclosure.shell].is_probe &&
                (best == mesh::no_index ||
                 found_.shells[enclosure.shell].enclosures.size() > found_.shells[best].enclosures.size()))
                best = enclosure.shell;
        return best;
    }

    mesh::Shells found_;
    std::vector<Region> regions_;
    std::size_t lost_holes_ = 0;
};

/// Adds a tetrahedron of a unit at each point of the soup from `first` on.
void add_probes(mesh::RepairSoup& soup, std::size_t first) {
    const std::size_t last = soup.points.size();
    for (std::size_t at = first; at < last; ++at) {
        const exact::Point p = soup.points[at];
        const auto a = static_cast<mesh::VertexIndex>(at);
        const auto b = static_cast<mesh::VertexIndex>(soup.points.size());
        soup.points.push_back({p.x + 1, p.y, p.z});
        soup.points.push_back({p.x, p.y + 1, p.z});
        soup.points.push_back({p.x, p.y, p.z + 1});
        for (const Triangle& t : {Triangle{a, b + 1, b}, {a, b, b + 2}, {a, b + 2, b + 1}, {b, b + 1, b + 2}})
            soup.triangles.push_back(t);
    }
}

}  // namespace

FaceDirections directions_away_from_solid(std::span<const Vec3> vertices, const FaceList& faces,
                                          std::span<const Vec3> hole_points) {
    std::optional<mesh::RepairSoup> soup = soup_of(vertices, faces, hole_points);
    if (!soup) return {};
    const std::vector<Triangle> before = soup->triangles;
    std::vector<bool> mixed, inner(before.size());
    mesh::orient_neighbours(*soup, mixed);
    FaceDirections result;
    if (hole_points.empty()) {
        mesh::turn_shells(*soup, mixed);
    } else {
        mesh::RepairSoup with_probes = *soup;
        add_probes(with_probes, soup->vertices.size());
        const Regions regions(with_probes, before.size());
        if (!regions.all_closed()) return {};
        result.lost_holes = regions.lost_holes();
        for (std::size_t i = 0; i < before.size(); ++i) {
            inner[i] = regions.is_inner(i);
            if (!inner[i] && regions.looks_inwards(i))
                std::swap(soup->triangles[i][1], soup->triangles[i][2]);
        }
    }
    result.turns.resize(faces.size()), result.drops.resize(faces.size());
    std::vector<bool> seen(faces.size());
    for (std::size_t i = 0; i < before.size(); ++i) {
        const FaceIndex face = soup->origin[i];
        const bool turned = soup->triangles[i] != before[i];
        // Triangles of one face that go different ways are no surface to direct.
        if (seen[face] && (turned != result.turns[face] || inner[i] != result.drops[face])) return {};
        seen[face] = true;
        result.turns[face] = turned, result.drops[face] = inner[i];
    }
    result.inner = static_cast<std::size_t>(std::count(result.drops.begin(), result.drops.end(), true));
    for (std::size_t face = 0; face < faces.size(); ++face)
        result.turned += result.turns[face] && !result.drops[face];
    return result;
}

FaceList with_directions(const FaceList& faces, const FaceDirections& directions) {
    if (directions.turned == 0 && directions.inner == 0) return faces;
    FaceList result;
    std::vector<mesh::VertexIndex> corners;
    std::vector<std::uint32_t> contour_begin;
    for (std::size_t face = 0; face < faces.size(); ++face) {
        if (directions.drops[face]) continue;
        contours_of(faces, face, contour_begin);
        corners.assign(faces.corners(face).begin(), faces.corners(face).end());
        if (directions.turns[face])
            for (std::size_t c = 0; c + 1 < contour_begin.size(); ++c)
                std::reverse(corners.begin() + contour_begin[c] + 1, corners.begin() + contour_begin[c + 1]);
        result.add_with_holes(corners, contour_begin);
    }
    return result;
}

}  // namespace octavo::io
