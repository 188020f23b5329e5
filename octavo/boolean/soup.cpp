// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>

#include <octavo/boolean/soup.hpp>
#include <octavo/exact/orient.hpp>

namespace octavo::boolean {

PointIndex::PointIndex(std::size_t expected) {
    std::size_t capacity = 16;
    while (capacity < 2 * expected) capacity *= 2;
    slots_.assign(capacity, no_index);
    mask_ = capacity - 1;
}

std::uint64_t PointIndex::hash(exact::Point point) {
    // Multiplications spread the low bits upwards; the high half is what survives in the slot number.
    const std::uint64_t xy = static_cast<std::uint64_t>(static_cast<std::uint32_t>(point.x)) |
                             static_cast<std::uint64_t>(static_cast<std::uint32_t>(point.y)) << 32;
    const std::uint64_t mixed =
        (xy * 0x9E3779B97F4A7C15ull) ^
        (static_cast<std::uint64_t>(static_cast<std::uint32_t>(point.z)) * 0xC2B2AE3D27D4EB4Full);
    return (mixed * 0x9E3779B97F4A7C15ull) >> 24;
}

std::uint32_t PointIndex::add(exact::Point point, std::vector<exact::Point>& points) {
    std::size_t slot = hash(point) & mask_;
    for (; slots_[slot] != no_index; slot = (slot + 1) & mask_)
        if (points[slots_[slot]] == point) return slots_[slot];
    const std::uint32_t id = static_cast<std::uint32_t>(points.size());
    slots_[slot] = id;
    points.push_back(point);
    if (2 * ++used_ > slots_.size()) grow(points);
    return id;
}

std::uint32_t PointIndex::find(exact::Point point, std::span<const exact::Point> points) const {
    for (std::size_t slot = hash(point) & mask_; slots_[slot] != no_index; slot = (slot + 1) & mask_)
        if (points[slots_[slot]] == point) return slots_[slot];
    return no_index;
}

void PointIndex::grow(std::span<const exact::Point> points) {
    slots_.assign(2 * slots_.size(), no_index);
    mask_ = slots_.size() - 1;
    for (std::uint32_t id = 0; id < points.size(); ++id) {
        std::size_t slot = hash(points[id]) & mask_;
        while (slots_[slot] != no_index) slot = (slot + 1) & mask_;
        slots_[slot] = id;
    }
}

mesh::Source Soup::source(std::uint32_t facet) const {
    const auto after = std::upper_bound(first_triangle.begin(), first_triangle.end(), origin[facet]);
    const auto operand = static_cast<std::uint32_t>(after - first_triangle.begin() - 1);
    return {operand, origin[facet] - first_triangle[operand]};
}

namespace {

Result<exact::Lattice> joint_lattice(std::span<const mesh::Mesh* const> operands) {
    Box3 all;
    for (std::size_t operand = 0; operand < operands.size(); ++operand) {
        for (const Vec3& vertex : operands[operand]->vertices) {
            if (!is_finite(vertex))
                return Error{ErrorCode::bad_input,
                             "operand " + std::to_string(operand) + " has a vertex that is not finite",
                             {}};
            all.add(vertex);
        }
    }
    if (all.empty()) return exact::Lattice{};
    return exact::Lattice::fit(all);
}

/// Snaps and welds the vertices of one operand; the result names the point of each vertex.
std::vector<std::uint32_t> add_vertices(const mesh::Mesh& operand, Soup& soup) {
    std::vector<std::uint32_t> point_of(operand.vertices.size());
    for (std::size_t vertex = 0; vertex < point_of.size(); ++vertex) {
        const exact::Point point = soup.lattice.snap(operand.vertices[vertex]);
        point_of[vertex] = soup.index.add(point, soup.points);
        const Vec3 moved = soup.lattice.to_world(point) - operand.vertices[vertex];
        if (moved == Vec3{}) continue;
        ++soup.moved_vertices;
        soup.largest_displacement = std::max(soup.largest_displacement, length(moved));
    }
    return point_of;
}

Status add_facets(const mesh::Mesh& mesh, std::uint32_t operand, std::span<const std::uint32_t> point_of,
                  Soup& soup) {
    for (std::size_t face = 0; face < mesh.triangles.size(); ++face) {
        const mesh::Triangle& triangle = mesh.triangles[face];
        for (const mesh::VertexIndex corner : triangle)
            if (corner >= point_of.size()) {
                Error error{
                    ErrorCode::bad_input,
                    "operand " + std::to_string(operand) + " has a facet with a corner that does not exist",
                    {}};
                error.place.faces = {static_cast<std::uint32_t>(face)};
                return error;
            }
        const mesh::Triangle facet{point_of[triangle[0]], point_of[triangle[1]], point_of[triangle[2]]};
        if (exact::collinear(soup.points[facet[0]], soup.points[facet[1]], soup.points[facet[2]])) {
            ++soup.flat_facets;
            continue;
        }
        soup.facets.push_back(facet);
        soup.origin.push_back(soup.first_triangle[operand] + static_cast<std::uint32_t>(face));
        soup.transition.push_back(operand);
    }
    return Done{};
}

struct SortedCorners {
    std::uint32_t middle, high;
    bool odd;  ///< the facet runs low, high, middle
};

SortedCorners sorted_corners(const mesh::Triangle& facet) {
    const int low = facet[0] < facet[1] ? (facet[0] < facet[2] ? 0 : 2) : (facet[1] < facet[2] ? 1 : 2);
    const std::uint32_t second = facet[(low + 1) % 3], third = facet[(low + 2) % 3];
    return {std::min(second, third), std::max(second, third), second > third};
}

/// Facets of equal corners become one. Buckets by least corner hold two facets on average, so comparing inside
/// them beats hashing all triples.
void merge_coincident(Soup& soup) {
    const std::size_t count = soup.facets.size();
    std::vector<std::uint32_t> begin(soup.points.size() + 1, 0);
    for (const mesh::Triangle& facet : soup.facets) ++begin[std::min({facet[0], facet[1], facet[2]}) + 1];
    for (std::size_t point = 0; point < soup.points.size(); ++point) begin[point + 1] += begin[point];
    std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1), bucket(count);
    for (std::uint32_t facet = 0; facet < count; ++facet) {
        const mesh::Triangle& corners = soup.facets[facet];
        bucket[next[std::min({corners[0], corners[1], corners[2]})]++] = facet;
    }

    struct Key {
        std::uint32_t middle, high, facet;
        bool odd;
        bool operator<(const Key& other) const {
            return std::tie(middle, high, facet) < std::tie(other.middle, other.high, other.facet);
        }
    };
    std::vector<Key> keys;
    TransitionSum sum;
    std::vector<char> dropped;
    for (std::size_t point = 0; point < soup.points.size(); ++point) {
        const std::size_t size = begin[point + 1] - begin[point];
        if (size < 2) continue;
        keys.clear();
        for (std::uint32_t i = begin[point]; i < begin[point + 1]; ++i) {
            const SortedCorners corners = sorted_corners(soup.facets[bucket[i]]);
            keys.push_back({corners.middle, corners.high, bucket[i], corners.odd});
        }
        bool repeated = false;
        if (size <= 8) {
            for (std::size_t i = 0; i < size; ++i)
                for (std::size_t j = 0; j < i; ++j)
                    repeated = repeated || (keys[i].middle == keys[j].middle && keys[i].high == keys[j].high);
            if (!repeated) continue;
        }
        std::sort(keys.begin(), keys.end());
        for (std::size_t i = 0, end; i < size; i = end) {
            for (end = i + 1;
                 end < size && keys[end].middle == keys[i].middle && keys[end].high == keys[i].high;)
                ++end;
            if (end == i + 1) continue;
            sum.clear();
            if (dropped.empty()) dropped.assign(count, 0);
            for (std::size_t k = i; k < end; ++k) {
                sum.add(soup.transitions.of(soup.transition[keys[k].facet]),
                        keys[k].odd == keys[i].odd ? 1 : -1);
                dropped[keys[k].facet] = k > i;
            }
            soup.coincident_facets += end - i - 1;
            const std::span<const Delta> total = sum.normalised();
            if (total.empty())
                dropped[keys[i].facet] = 1;
            else
                soup.transition[keys[i].facet] = soup.transitions.intern(total);
        }
    }
    if (dropped.empty()) return;
    std::size_t kept = 0;
    for (std::size_t facet = 0; facet < count; ++facet) {
        if (dropped[facet]) continue;
        soup.facets[kept] = soup.facets[facet];
        soup.transition[kept] = soup.transition[facet];
        soup.origin[kept++] = soup.origin[facet];
    }
    soup.facets.resize(kept), soup.transition.resize(kept), soup.origin.resize(kept);
}

}  // namespace

Result<Soup> make_soup(std::span<const mesh::Mesh* const> operands, const Context& context) {
    Soup soup;
    Result<exact::Lattice> lattice = joint_lattice(operands);
    if (!lattice) return lattice.error();
    soup.lattice = *lattice;

    std::size_t triangles = 0, vertices = 0;
    for (const mesh::Mesh* operand : operands) {
        soup.first_triangle.push_back(static_cast<std::uint32_t>(triangles));
        triangles += operand->triangles.size();
        vertices += operand->vertices.size();
    }
    // Corners are numbered three to a facet, with ids of 32 bits.
    if (triangles > (std::size_t{1} << 30) / 3 || vertices > (std::size_t{1} << 30))
        return Error{
            ErrorCode::limit, "the operands have more than 357 million facets or 1 billion vertices", {}};
    soup.first_triangle.push_back(static_cast<std::uint32_t>(triangles));
    soup.transitions = TransitionTable(static_cast<std::uint32_t>(operands.size()));
    soup.index = PointIndex(vertices);
    soup.points.reserve(vertices);
    soup.facets.reserve(triangles), soup.transition.reserve(triangles), soup.origin.reserve(triangles);
    for (std::uint32_t operand = 0; operand < operands.size(); ++operand) {
        if (context.cancelled()) return Context::cancelled_error();
        const std::vector<std::uint32_t> point_of = add_vertices(*operands[operand], soup);
        const Status added = add_facets(*operands[operand], operand, point_of, soup);
        if (!added) return added.error();
    }
    merge_coincident(soup);
    return soup;
}

}  // namespace octavo::boolean
