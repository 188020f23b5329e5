// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/mesh/mesh.hpp>

// The faces of a file in its own order. Most files hold triangles only, so triangles are kept as such; the
// first face with more corners turns the list into one of polygons, once. Faces with holes are rarer still: the
// first turns it into one of contours.

namespace octavo::io {

class FaceList {
  public:
    void reserve_triangles(std::size_t count) { triangles_.reserve(count); }

    void add_triangle(mesh::VertexIndex a, mesh::VertexIndex b, mesh::VertexIndex c) {
        if (begin_.empty()) {
            triangles_.push_back({a, b, c});
        } else {
            add_polygon(std::array{a, b, c});
        }
    }

    /// Adds a face of any number of corners. Faces of fewer than three bound nothing: they are left out and
    /// counted.
    void add(std::span<const mesh::VertexIndex> corners) {
        if (corners.size() == 3) {
            add_triangle(corners[0], corners[1], corners[2]);
        } else if (corners.size() < 3) {
            ++too_small_;
        } else {
            add_polygon(corners);
        }
    }

    /// Adds a face with holes: contour c is corners [contour_begin[c], contour_begin[c + 1]), the first is the outer
    /// one. Contours have three corners at least.
    void add_with_holes(std::span<const mesh::VertexIndex> corners,
                        std::span<const std::uint32_t> contour_begin);

    std::size_t size() const {
        if (!face_begin_.empty()) return face_begin_.size() - 1;
        return begin_.empty() ? triangles_.size() : begin_.size() - 1;
    }
    bool has_polygons() const { return !begin_.empty(); }
    std::size_t too_small() const { return too_small_; }

    /// The triangles, while there is no other face; writable for readers that fill them in place.
    std::vector<mesh::Triangle>& triangles() { return triangles_; }

    /// The corners of face `face`, those of its outer contour first.
    std::span<const mesh::VertexIndex> corners(std::size_t face) const {
        if (begin_.empty()) return triangles_[face];
        const std::size_t begin = begin_[contour(face)], end = begin_[contour(face + 1)];
        return std::span(corners_).subspan(begin, end - begin);
    }

    std::size_t contours(std::size_t face) const { return contour(face + 1) - contour(face); }
    /// How many of the face's corners come before its contour `c`; for c = contours(face), how many it has.
    std::size_t corners_before(std::size_t face, std::size_t c) const {
        if (begin_.empty()) return 3 * c;
        return begin_[contour(face) + c] - begin_[contour(face)];
    }

  private:
    void begin_polygons();
    void add_polygon(std::span<const mesh::VertexIndex> corners);
    std::size_t contour(std::size_t face) const { return face_begin_.empty() ? face : face_begin_[face]; }

    std::vector<mesh::Triangle> triangles_;
    std::vector<std::size_t> begin_;       ///< of contours in corners_; empty while all faces are triangles
    std::vector<std::size_t> face_begin_;  ///< of faces in begin_; empty while all have one contour
    std::vector<mesh::VertexIndex> corners_;
    std::size_t too_small_ = 0;
};

}  // namespace octavo::io
