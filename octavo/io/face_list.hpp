// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <octavo/mesh/mesh.hpp>

// The faces of a file in its own order. Most files hold triangles only, so triangles are kept as such; the
// first face with more corners turns the list into one of polygons, once.

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

    std::size_t size() const { return begin_.empty() ? triangles_.size() : begin_.size() - 1; }
    bool has_polygons() const { return !begin_.empty(); }
    std::size_t too_small() const { return too_small_; }

    /// The triangles, while there is no other face; writable for readers that fill them in place.
    std::vector<mesh::Triangle>& triangles() { return triangles_; }

    /// The corners of face `face`.
    std::span<const mesh::VertexIndex> corners(std::size_t face) const {
        if (begin_.empty()) return triangles_[face];
        return std::span(corners_).subspan(begin_[face], begin_[face + 1] - begin_[face]);
    }

  private:
    void add_polygon(std::span<const mesh::VertexIndex> corners);

    std::vector<mesh::Triangle> triangles_;
    std::vector<std::size_t> begin_;  ///< empty while all are triangles
    std::vector<mesh::VertexIndex> corners_;
    std::size_t too_small_ = 0;
};

}  // namespace octavo::io
