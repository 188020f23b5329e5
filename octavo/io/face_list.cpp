// SPDX-License-Identifier: Apache-2.0
#include <octavo/io/face_list.hpp>

namespace octavo::io {

void FaceList::begin_polygons() {
    begin_.reserve(triangles_.size() + 2);
    corners_.reserve(3 * triangles_.size());
    begin_.push_back(0);
    for (const mesh::Triangle& triangle : triangles_) {
        corners_.insert(corners_.end(), triangle.begin(), triangle.end());
        begin_.push_back(corners_.size());
    }
    triangles_ = {};
}

void FaceList::add_polygon(std::span<const mesh::VertexIndex> corners) {
    if (begin_.empty()) begin_polygons();
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    begin_.push_back(corners_.size());
    if (!face_begin_.empty()) face_begin_.push_back(begin_.size() - 1);
}

void FaceList::add_with_holes(std::span<const mesh::VertexIndex> corners,
                              std::span<const std::uint32_t> contour_begin) {
    if (contour_begin.size() == 2) return add(corners);
    if (begin_.empty()) begin_polygons();
    if (face_begin_.empty())
        for (std::size_t face = 0; face < begin_.size(); ++face) face_begin_.push_back(face);
    const std::size_t first = corners_.size();
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    for (std::size_t c = 1; c < contour_begin.size(); ++c) begin_.push_back(first + contour_begin[c]);
    face_begin_.push_back(begin_.size() - 1);
}

}  // namespace octavo::io
