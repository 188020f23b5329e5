// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <octavo/io/face_list.hpp>
#include <octavo/mesh/orient2d.hpp>
#include <octavo/mesh/triangulate.hpp>

// From a facet as TetGen means it to faces with holes.
//
// A facet is any number of closed contours in one plane, side by side or inside one another, running either way. They
// divide the plane; what lies in a contour belongs to the facet, unless a hole point lies there and in no smaller
// contour. So each contour without a hole point is a face, and the contours directly inside it are its holes: those
// with a hole point because nothing is there, the others because a face of their own is. Together the faces cover
// what the facet covers, and all edges stay edges.
//
// The facet is seen along the coordinate axis nearest to its normal, and what lies in what is decided exactly there,
// on the numbers of the file. All faces look the way of the first contour.
// Cost: linear for a single contour; else contours times corners whose boxes meet.
// Source: H. Si, TetGen user's manual, file formats .poly and .smesh; the rule for holes.

namespace octavo::io {

class FacetRegions {
  public:
    using Contours = std::vector<std::vector<mesh::VertexIndex>>;

    /// What is wrong with a facet: a sentence without its subject, and the hole point concerned, if one is.
    struct Trouble {
        std::string sentence;
        std::size_t hole_point = none;
        static constexpr std::size_t none = ~std::size_t{0};
    };

    /// Appends the faces of a facet to `faces` and returns how many there are. Contours have three corners at least.
    struct Taken {
        std::size_t faces = 0;
        std::optional<Trouble> trouble;  ///< then nothing was appended
    };
    Taken take(std::span<const Vec3> vertices, const Contours& contours, std::span<const Vec3> hole_points,
               FaceList& faces);

    /// How far the corners of the last facet are from its plane at most; rounded.
    double deviation() const { return deviation_; }

  private:
    struct Region {
        std::size_t begin = 0, end = 0;  ///< corners in points_
        double area = 0;                 ///< twice, positive; rounded
        bool reversed = false;           ///< runs against the first contour
        bool is_hole = false;
        std::size_t around = none;  ///< the contour directly around
        mesh::Point2 low, high, inside;
        static constexpr std::size_t none = ~std::size_t{0};
    };

    bool project(std::span<const Vec3> vertices, const Contours& contours, std::span<const Vec3> hole_points);
    bool measure(Region& region);
    bool find_inside(Region& region);
    /// 1 inside, 0 on, −1 outside.
    int place(mesh::Point2 point, const Region& region) const;
    std::optional<Trouble> nest();
    std::optional<Trouble> open_holes(std::size_t hole_points);
    std::optional<Trouble> add_face(std::span<const Vec3> vertices, const Contours& contours,
                                    std::size_t region, FaceList& faces);

    double deviation_ = 0;
    std::vector<mesh::Point2> points_;  ///< of all contours, then the hole points
    std::vector<Region> regions_;
    mesh::Triangulator triangulator_;
    std::vector<Vec3> positions_;
    std::vector<mesh::VertexIndex> corners_;
    std::vector<std::uint32_t> contour_begin_;
};

}  // namespace octavo::io
