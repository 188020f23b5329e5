// SPDX-License-Identifier: Apache-2.0
#include <numeric>

#include <octavo/bp_octree/triangle_cell.hpp>
#include <octavo/query/lattice_coordinate.hpp>
#include <octavo/query/leaf_test.hpp>
#include <octavo/query/stored_inside.hpp>

namespace octavo::query {
namespace {

static_assert(53 + 2 + 1 + 54 + 2 < 120, "the offset of a plane on the halved lattice fits a LinearForm");

/// The triangle on the halved lattice.
classic::FacetCorners doubled(const bp_octree::DecodedGeometry& geometry, const mesh::Triangle& t) {
    classic::FacetCorners corners;
    for (std::size_t k = 0; k < 3; ++k) {
        const exact::Point p = geometry.points[t[k]];
        corners[k] = {2 * p.x, 2 * p.y, 2 * p.z};
    }
    return corners;
}

}  // namespace

Result<StoredInside> StoredInside::open(const std::string& path) {
    auto source = io::open_file(path);
    if (!source) return source.error();
    return open(std::move(*source));
}

Result<StoredInside> StoredInside::open(std::unique_ptr<io::ByteSource> source) {
    auto reader = bp_octree::BpoReader::open(std::move(source));
    if (!reader) return reader.error();
    if (!reader->head().is_solid)
        return Error{
            ErrorCode::not_a_solid, "the BP-octree is that of an open surface, which has no inside", {}};
    const exact::Lattice& lattice = reader->head().lattice;
    std::array<std::int64_t, 3> origin = lattice.origin();
    for (std::int64_t& value : origin) value *= 2;
    auto half = exact::Lattice::from_parts(lattice.exponent() - 1, origin);
    if (!half) return Error{ErrorCode::limit, "the solid lies too far from the world's origin", {}};
    return StoredInside(std::move(*reader), *half);
}

Result<Side> StoredInside::operator()(Vec3 point) {
    LatticePlace place;
    place.world = point;
    std::array<std::int64_t, 3> whole{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        LatticeCoordinate coordinate;
        if (!coordinate.split(point[axis], inverse_half_)) return Side::outside;
        whole[i] = coordinate.whole - half_.origin()[i];
        place.part[i] = coordinate.part;
    }
    const auto leaf = reader_.leaf_at(whole);
    if (!leaf) return leaf.error();
    if (leaf->node == octree::Node::white) return Side::outside;
    if (leaf->node == octree::Node::black) return Side::inside;
    for (std::size_t i = 0; i < 3; ++i) place.whole[i] = static_cast<std::int32_t>(whole[i]);

    const auto near = reader_.triangles_near(leaf->cell);
    if (!near) return near.error();
    const bp_octree::CellBox box = reader_.head().frame.box(leaf->cell);
    std::vector<classic::FacetCorners> facets;
    for (const mesh::Triangle& t : (*near)->triangles) {
        const auto& points = (*near)->points;
        if (!bp_octree::TriangleInCells(points[t[0]], points[t[1]], points[t[2]]).meets(box)) continue;
        facets.push_back(doubled(**near, t));
    }
    std::vector<std::uint32_t> all(facets.size());
    std::iota(all.begin(), all.end(), 0U);
    const LeafAnswer answer = test_in_leaf(place, box.low, leaf->winding, all, facets, half_);
    return answer.on_facet ? Side::on : answer.winding > 0 ? Side::inside : Side::outside;
}

}  // namespace octavo::query
