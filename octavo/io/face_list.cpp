// SPDX-License-Identifier: Apache-2.0
#include <octavo/io/face_list.hpp>

namespace octavo::io {

void FaceList::add_polygon(std::span<const mesh::VertexIndex> corners) {
    if (begin_.empty()) {
        begin_.reserve(triangles_.size() + 2);
        corners_.reserve(3 * triangles_.size() + corners.size());
        begin_.push_back(0);
        for (const mesh::Triangle& triangle : triangles_) {
            corners_.insert(corners_.end(), triangle.begin(), triangle.end());
            begin_.push_back(corners_.size());
        }
        triangles_ = {};
    }
    corners_.insert(corners_.end(), corners.begin(), corners.end());
    begin_.push_back(corners_.size());
}

}  // namespace octavo::io
