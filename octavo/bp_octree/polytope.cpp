// SPDX-License-Identifier: Apache-2.0
#include <octavo/bp_octree/polytope.hpp>

namespace octavo::bp_octree {
namespace {

constexpr std::uint32_t no_vertex = 0xffffffff;

/// Scratch of one clip; kept by the thread, because nodes are clipped by the hundred thousand.
struct Scratch {
    struct Cut {
        std::uint32_t inside, outside, vertex;
    };
    std::vector<double> values;
    std::vector<std::uint32_t> new_index;
    std::vector<Vec3> vertices;
    std::vector<std::uint32_t> loops, face_begin;
    std::vector<std::int16_t> labels;
    std::vector<Cut> cuts;
    std::vector<std::uint32_t> successor;  ///< along the cap, by vertex
};

Scratch& scratch() {
    thread_local Scratch value;
    return value;
}

Vec3 between(Vec3 a, Vec3 b, double value_a, double value_b) {
    const double t = value_a / (value_a - value_b);
    return a + t * (b - a);
}

double six_volumes(Vec3 a, Vec3 b, Vec3 c) { return dot(a, cross(b, c)); }

}  // namespace

void Polytope::make_cell() {
    vertices_.clear();
    for (int i = 0; i < 8; ++i)
        vertices_.push_back({i & 1 ? cell_side : 0, i & 2 ? cell_side : 0, i & 4 ? cell_side : 0});
    loops_ = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
    face_begin_ = {0, 4, 8, 12, 16, 20, 24};
    labels_ = {0, 1, 2, 3, 4, 5};
}

double Polytope::volume() const {
    if (vertices_.empty()) return 0;
    const Vec3 origin = vertices_[0];
    double sum = 0;
    for (std::size_t face = 0; face < face_count(); ++face) {
        const std::uint32_t* loop = begin(face);
        const Vec3 first = vertices_[loop[0]] - origin;
        for (const std::uint32_t* p = loop + 1; p + 1 < end(face); ++p)
            sum += six_volumes(first, vertices_[p[0]] - origin, vertices_[p[1]] - origin);
    }
    return sum / 6;
}

double Polytope::removed_volume(const HalfSpace& half_space) const {
    Scratch& work = scratch();
    work.values.resize(vertices_.size());
    double most = 0;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        work.values[i] = half_space.value(vertices_[i]);
        most = work.values[i] > most ? work.values[i] : most;
    }
    if (most <= 0) return 0;

    // The part cut off, as pyramids from a point in the cutting plane over what its faces keep: the cut itself
    // then adds nothing.
    const double length2 = dot(half_space.normal, half_space.normal);
    const Vec3 apex = vertices_[0] - (work.values[0] / length2) * half_space.normal;
    double sum = 0;
    for (std::size_t face = 0; face < face_count(); ++face) {
        const std::uint32_t *loop = begin(face), *last = end(face) - 1;
        Vec3 first, previous;
        int count = 0;
        const auto add = [&](Vec3 x) {
            x = x - apex;
            if (count == 0)
                first = x;
            else if (count > 1)
                sum += six_volumes(first, previous, x);
            previous = x;
            ++count;
        };
        for (const std::uint32_t* p = loop; p <= last; ++p) {
            const std::uint32_t i = *p, j = p == last ? *loop : p[1];
            const double vi = work.values[i], vj = work.values[j];
            if (vi > 0) add(vertices_[i]);
            if ((vi > 0) != (vj > 0)) add(between(vertices_[i], vertices_[j], vi, vj));
        }
    }
    return sum > 0 ? sum / 6 : 0;
}

bool Polytope::clip(const HalfSpace& half_space, int label) {
    Scratch& work = scratch();
    work.values.resize(vertices_.size());
    work.new_index.assign(vertices_.size(), no_vertex);
    work.vertices.clear();
    bool any_outside = false;
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
        work.values[i] = half_space.value(vertices_[i]);
        if (work.values[i] > 0) {
            any_outside = true;
        } else {
            work.new_index[i] = static_cast<std::uint32_t>(work.vertices.size());
            work.vertices.push_back(vertices_[i]);
        }
    }
    if (!any_outside) return false;
    if (work.vertices.empty()) {
        *this = {};
        return true;
    }

    work.loops.clear();
    work.face_begin.assign(1, 0);
    work.labels.clear();
    work.cuts.clear();
    work.successor.assign(vertices_.size() + loops_.size(), no_vertex);
    const auto cut_vertex = [&](std::uint32_t inside, std::uint32_t outside) {
        for (const Scratch::Cut& cut : work.cuts)
            if (cut.inside == inside && cut.outside == outside) return cut.vertex;
        const std::uint32_t vertex = static_cast<std::uint32_t>(work.vertices.size());
        work.vertices.push_back(
            between(vertices_[inside], vertices_[outside], work.values[inside], work.values[outside]));
        work.cuts.push_back({inside, outside, vertex});
        return vertex;
    };

    std::size_t cap_edges = 0;
    std::uint32_t cap_start = no_vertex;
    for (std::size_t face = 0; face < face_count(); ++face) {
        const std::uint32_t *loop = begin(face), *last = end(face) - 1;
        std::uint32_t leaving = no_vertex, entering = no_vertex;
        int crossings = 0;
        for (const std::uint32_t* p = loop; p <= last; ++p) {
            const std::uint32_t i = *p, j = p == last ? *loop : p[1];
            const bool inside_i = work.values[i] <= 0, inside_j = work.values[j] <= 0;
            if (inside_i) work.loops.push_back(work.new_index[i]);
            if (inside_i == inside_j) continue;
            ++crossings;
            const std::uint32_t vertex = inside_i ? cut_vertex(i, j) : cut_vertex(j, i);
            (inside_i ? leaving : entering) = vertex;
            work.loops.push_back(vertex);
        }
        if (crossings > 2) return false;  // not convex to the last bit
        if (crossings == 2) {
            // The face runs leaving → entering; the cap runs the other way.
            if (work.successor[entering] != no_vertex) return false;
            work.successor[entering] = leaving;
            cap_start = entering;
            ++cap_edges;
        }
        if (work.loops.size() > work.face_begin.back()) {
            work.face_begin.push_back(static_cast<std::uint32_t>(work.loops.size()));
            work.labels.push_back(labels_[face]);
        }
    }
    // One loop through all cuts, or the shape is refused.
    if (cap_start == no_vertex) return false;
    std::uint32_t vertex = cap_start;
    for (std::size_t i = 0; i < cap_edges; ++i) {
        work.loops.push_back(vertex);
        vertex = work.successor[vertex];
        if (vertex == no_vertex || (vertex == cap_start) != (i + 1 == cap_edges)) return false;
    }
    work.face_begin.push_back(static_cast<std::uint32_t>(work.loops.size()));
    work.labels.push_back(static_cast<std::int16_t>(label));

    vertices_.swap(work.vertices);
    loops_.swap(work.loops);
    face_begin_.swap(work.face_begin);
    labels_.swap(work.labels);
    return true;
}

void Polytope::assign_octant(const Polytope& parent, int index) {
    *this = parent;
    for (int axis = 0; axis < 3 && !empty(); ++axis) {
        const bool high = index >> axis & 1;
        // What remains of the parent's side on the other half is cut off with it, so labels stay unique.
        HalfSpace half;
        half.normal[axis] = high ? -1 : 1;
        half.offset = high ? -cell_side / 2 : cell_side / 2;
        clip(half, 2 * axis + (high ? 0 : 1));
    }
    for (Vec3& vertex : vertices_)
        for (int axis = 0; axis < 3; ++axis)
            vertex[axis] = 2 * vertex[axis] - (index >> axis & 1 ? cell_side : 0);
}

}  // namespace octavo::bp_octree
