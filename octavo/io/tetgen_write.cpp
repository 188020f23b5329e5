// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include <octavo/base/counted.hpp>
#include <octavo/io/tetgen.hpp>
#include <octavo/mesh/merge_coplanar.hpp>
#include <octavo/mesh/shells.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/triangulate.hpp>

namespace octavo::io {
namespace {

using mesh::Mesh;
using mesh::PolygonMesh;
using mesh::Triangle;
using mesh::VertexIndex;

/// A point well inside a contour: the middle of its largest triangle.
Vec3 point_inside(std::span<const Vec3> vertices, std::span<const VertexIndex> contour,
                  mesh::Triangulator& triangulator) {
    std::vector<VertexIndex> corners(contour.rbegin(), contour.rend());
    Vec3 middle;
    double largest = -1;
    for (const Triangle& t : triangulator(vertices, corners).triangles) {
        const Vec3 a = vertices[t[0]], u = vertices[t[1]] - a, v = vertices[t[2]] - a;
        const double area = length(cross(u, v));
        if (area > largest) largest = area, middle = a + (1.0 / 3) * (u + v);
    }
    return middle;
}

/// Where along a ray a triangle is met first, in lengths of the direction; infinite when it is not. Rounded.
double meets(Vec3 from, Vec3 direction, Vec3 a, Vec3 b, Vec3 c) {
    const Vec3 u = b - a, v = c - a, p = cross(direction, v);
    const double determinant = dot(u, p);
    if (determinant == 0) return Box3::infinity;
    const Vec3 s = from - a, q = cross(s, u);
    const double x = dot(s, p) / determinant, y = dot(direction, q) / determinant;
    const double t = dot(v, q) / determinant;
    return x >= 0 && y >= 0 && x + y <= 1 && t > 0 ? t : Box3::infinity;
}

/// A point in each cavity: from the middle of its largest facet, half the way to what is opposite.
std::vector<Vec3> points_in_cavities(const mesh::LatticeMesh& lattice_mesh, const Mesh& mesh) {
    const mesh::Shells shells =
        mesh::find_shells(lattice_mesh.points, lattice_mesh.triangles,
                          mesh::build_edges(lattice_mesh.triangles, lattice_mesh.points.size()));
    const auto normal = [&](const Triangle& t) {
        return cross(mesh.vertices[t[1]] - mesh.vertices[t[0]], mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    };
    const std::size_t none = mesh.triangles.size();
    std::vector<std::size_t> largest_of(shells.shells.size(), none);
    std::vector<double> area_of(shells.shells.size(), -1);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const std::uint32_t shell = shells.of_face[i];
        if (shell == mesh::no_index) continue;
        const double area = length(normal(mesh.triangles[i]));
        if (area > area_of[shell]) area_of[shell] = area, largest_of[shell] = i;
    }
    std::vector<Vec3> points;
    for (std::uint32_t shell = 0; shell < shells.shells.size(); ++shell) {
        const std::size_t largest = largest_of[shell];
        if (!shells.shells[shell].cavity() || largest == none) continue;
        const Triangle& t = mesh.triangles[largest];
        const Vec3 middle = (1.0 / 3) * (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
        const Vec3 direction = normal(t);
        double nearest = Box3::infinity;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            if (i != largest)
                nearest = std::min(
                    nearest, meets(middle, direction, mesh.vertices[mesh.triangles[i][0]],
                                   mesh.vertices[mesh.triangles[i][1]], mesh.vertices[mesh.triangles[i][2]]));
        if (std::isfinite(nearest)) points.push_back(middle + (nearest / 2) * direction);
    }
    return points;
}

/// A mesh as faces, where it fits on a lattice; else as its triangles.
struct Boundary {
    PolygonMesh faces;
    std::vector<Vec3> hole_points;
};

Boundary boundary_of(const Mesh& mesh) {
    Boundary boundary;
    if (Result<mesh::Snapped> snapped = mesh::snap(mesh)) {
        boundary.faces = mesh::merge_coplanar(snapped->mesh);
        boundary.hole_points = points_in_cavities(snapped->mesh, mesh);
    } else {
        for (const Triangle& t : mesh.triangles) {
            boundary.faces.corners.insert(boundary.faces.corners.end(), t.begin(), t.end());
            boundary.faces.contour_begin.push_back(static_cast<std::uint32_t>(boundary.faces.corners.size()));
            boundary.faces.face_begin.push_back(
                static_cast<std::uint32_t>(boundary.faces.contour_begin.size() - 1));
        }
    }
    boundary.faces.vertices = mesh.vertices;
    return boundary;
}

class BoundaryWriter {
  public:
    BoundaryWriter(Output& output, const Mesh& mesh) : output_(output), boundary_(boundary_of(mesh)) {}

    WriteReport write(bool with_contours) {
        output_.append("# written by Octavo\n");
        write_points();
        if (with_contours)
            write_poly_facets();
        else
            write_smesh_facets();
        write_point_list(boundary_.hole_points);
        output_.append("0\n");  // regions
        WriteReport report;
        if (points_ < boundary_.faces.vertices.size())
            report.warnings.push_back("not kept: " +
                                      counted(boundary_.faces.vertices.size() - points_,
                                              "vertex that is a corner of no face",
                                              "vertices that are corners of no face") +
                                      "; the file has " + counted(points_, "vertex", "vertices") + " and " +
                                      counted(faces_, "face", "faces"));
        return report;
    }

  private:
    std::span<const VertexIndex> contour(std::uint32_t c) const {
        const PolygonMesh& faces = boundary_.faces;
        return {faces.corners.data() + faces.contour_begin[c],
                faces.contour_begin[c + 1] - faces.contour_begin[c]};
    }
    std::uint32_t faces() const { return static_cast<std::uint32_t>(boundary_.faces.face_begin.size() - 1); }

    void number(std::uint64_t value) { output_.append_number(value); }
    void space() { output_.append(' '); }

    void write_point(Vec3 point) {
        for (int axis = 0; axis < 3; ++axis) space(), output_.append_number(point[axis]);
        output_.append('\n');
    }
    void write_point_list(std::span<const Vec3> points) {
        number(points.size());
        output_.append('\n');
        for (std::size_t i = 0; i < points.size(); ++i) number(i + 1), write_point(points[i]);
    }
    /// Those that are corners, numbered from 1: TetGen would put others into its mesh.
    void write_points() {
        number_of_.assign(boundary_.faces.vertices.size(), 0);
        for (const VertexIndex corner : boundary_.faces.corners) number_of_[corner] = 1;
        std::uint32_t count = 0;
        for (std::uint32_t& number : number_of_)
            if (number) number = ++count;
        points_ = count;
        number(count);
        output_.append(" 3 0 0\n");
        for (std::size_t i = 0; i < number_of_.size(); ++i)
            if (number_of_[i]) number(number_of_[i]), write_point(boundary_.faces.vertices[i]);
    }
    void write_corners(std::span<const VertexIndex> corners) {
        number(corners.size());
        for (const VertexIndex corner : corners) space(), number(number_of_[corner]);
        output_.append('\n');
    }

    void write_poly_facets() {
        faces_ = faces();
        number(faces_);
        output_.append(" 0\n");
        const std::vector<std::uint32_t>& begin = boundary_.faces.face_begin;
        for (std::uint32_t face = 0; face < faces(); ++face) {
            const std::uint32_t contours = begin[face + 1] - begin[face];
            number(contours), space(), number(contours - 1);
            output_.append('\n');
            for (std::uint32_t c = begin[face]; c < begin[face + 1]; ++c) write_corners(contour(c));
            for (std::uint32_t c = begin[face] + 1; c < begin[face + 1]; ++c) {
                number(c - begin[face]);
                write_point(point_inside(boundary_.faces.vertices, contour(c), triangulator_));
            }
        }
    }

    void write_smesh_facets() {
        const std::vector<std::uint32_t>& begin = boundary_.faces.face_begin;
        std::vector<std::uint32_t> contour_begin;
        std::vector<VertexIndex> corners, lists;
        std::vector<std::size_t> list_begin{0};
        const auto add = [&](std::span<const VertexIndex> list) {
            lists.insert(lists.end(), list.begin(), list.end());
            list_begin.push_back(lists.size());
        };
        for (std::uint32_t face = 0; face < faces(); ++face) {
            if (begin[face + 1] - begin[face] == 1) {
                add(contour(begin[face]));
                continue;
            }
            corners.clear(), contour_begin.assign(1, 0);
            for (std::uint32_t c = begin[face]; c < begin[face + 1]; ++c) {
                corners.insert(corners.end(), contour(c).begin(), contour(c).end());
                contour_begin.push_back(static_cast<std::uint32_t>(corners.size()));
            }
            for (const Triangle& t :
                 triangulator_(boundary_.faces.vertices, corners, contour_begin).triangles)
                add(t);
        }
        faces_ = list_begin.size() - 1;
        number(faces_);
        output_.append(" 0\n");
        for (std::size_t i = 0; i + 1 < list_begin.size(); ++i)
            write_corners({lists.data() + list_begin[i], list_begin[i + 1] - list_begin[i]});
    }

    Output& output_;
    Boundary boundary_;
    std::vector<std::uint32_t> number_of_;  ///< of each vertex; 0 for those that are corners of nothing
    mesh::Triangulator triangulator_;
    std::size_t points_ = 0, faces_ = 0;  ///< that were written
};

}  // namespace

Result<WriteReport> write_poly(Output& output, const Mesh& mesh, const WriteOptions&) {
    return BoundaryWriter(output, mesh).write(true);
}

Result<WriteReport> write_smesh(Output& output, const Mesh& mesh, const WriteOptions&) {
    return BoundaryWriter(output, mesh).write(false);
}

}  // namespace octavo::io
