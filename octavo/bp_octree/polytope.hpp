// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <octavo/base/vec3.hpp>

// A convex polyhedron inside a cell, clipped by half-spaces: the shape of an envelope.
//
// It serves to measure volumes, to choose planes and to draw; whether an envelope contains its content is decided
// by integers elsewhere, so doubles are good enough here. Faces are loops of vertex indices, and a cut adds its
// vertices once for both faces, so the surface stays closed whatever rounding does to the coordinates.
//
// Coordinates are those of the cell: [0, 65536] along each axis (see support.hpp).

namespace octavo::bp_octree {

/// The half-space normal · x <= offset.
struct HalfSpace {
    Vec3 normal;
    double offset = 0;
    double value(Vec3 x) const { return dot(normal, x) - offset; }
};

class Polytope {
  public:
    static constexpr double cell_side = 65536;
    /// Labels of faces: 0 to 5 are the sides of the cell (2 axis + 1 if high), others are the caller's.
    static constexpr int cell_faces = 6;

    /// Nothing; `make_cell` or `assign_octant` give it a shape.
    Polytope() = default;

    /// The whole cell.
    void make_cell();

    bool empty() const { return vertices_.empty(); }
    double volume() const;

    const std::vector<Vec3>& vertices() const { return vertices_; }
    std::size_t face_count() const { return labels_.size(); }
    int label(std::size_t face) const { return labels_[face]; }
    /// The vertices of a face, counter-clockwise seen from outside.
    const std::uint32_t* begin(std::size_t face) const { return loops_.data() + face_begin_[face]; }
    const std::uint32_t* end(std::size_t face) const { return loops_.data() + face_begin_[face + 1]; }

    /// What clipping would take away.
    double removed_volume(const HalfSpace& half_space) const;

    /// Cuts off what lies outside of the half-space; the new face gets `label`. Returns false and changes nothing
    /// when there is nothing to cut, or when rounding has left a shape that cannot be cut consistently.
    bool clip(const HalfSpace& half_space, int label);

    /// Becomes the part of `parent` in its octant `index`, in the octant's own coordinates. Faces keep labels; the
    /// cuts are sides of the cell.
    void assign_octant(const Polytope& parent, int index);

    std::size_t memory_bytes() const {
        return vertices_.capacity() * sizeof(Vec3) + (loops_.capacity() + face_begin_.capacity()) * 4 +
               labels_.capacity() * 2;
    }
    void shrink_to_fit() {
        vertices_.shrink_to_fit();
        loops_.shrink_to_fit();
        face_begin_.shrink_to_fit();
        labels_.shrink_to_fit();
    }

  private:
    std::vector<Vec3> vertices_;
    std::vector<std::uint32_t> loops_;
    std::vector<std::uint32_t> face_begin_{0};
    std::vector<std::int16_t> labels_;
};

}  // namespace octavo::bp_octree
