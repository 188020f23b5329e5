// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <optional>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/bsp_octree/build.hpp>
#include <octavo/mesh/shapes.hpp>
#include <octavo/mesh/used_vertices.hpp>
#include <octavo/render/cut_open.hpp>

namespace octavo::render {
namespace {

/// The box without its infinite sides: they go where nothing of the solid is. None when the box misses `universe`.
std::optional<mesh::Mesh> box_within(const Box3& removed, const Box3& universe) {
    Box3 box;
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::max(removed.low[axis], universe.low[axis]);
        box.high[axis] = std::min(removed.high[axis], universe.high[axis]);
        if (!(box.low[axis] < box.high[axis])) return std::nullopt;
    }
    return mesh::box(box.low, box.high);
}

}  // namespace

Result<mesh::Mesh> cut_open(const mesh::Mesh& solid, const Box3& removed, const Context& context) {
    Box3 universe = mesh::bounds_of_facets(solid);
    const Vec3 extents = universe.extents();
    const double margin = 0.1 * std::max({extents.x, extents.y, extents.z});
    for (int axis = 0; axis < 3; ++axis) universe.low[axis] -= margin, universe.high[axis] += margin;
    const std::optional<mesh::Mesh> tool = box_within(removed, universe);
    if (!tool) return solid;

    const std::array<const mesh::Mesh*, 2> operands{&solid, &*tool};
    Result<boolean::Evaluated> cut =
        boolean::evaluate(operands, boolean::Program::difference(operands.size()), {}, context);
    if (!cut) return std::move(cut).error();
    for (mesh::Source& source : cut->mesh.sources) {
        if (source.operand == 1)
            source = {cut_operand, 0};
        else if (!solid.sources.empty())
            source = solid.sources[source.face];
    }
    return std::move(cut->mesh);
}

Result<CutBspOctree> cut_open(const bsp_octree::BspOctree& solid, const Box3& removed,
                              const Context& context) {
    const exact::Lattice& lattice = solid.lattice();
    constexpr std::int32_t last = exact::universe_side - 2;
    const Box3 universe{lattice.to_world({1, 1, 1}), lattice.to_world({last, last, last})};
    const std::optional<mesh::Mesh> tool = box_within(removed, universe);
    if (!tool) return CutBspOctree{solid, {}};
    const Result<bsp_octree::Built> built =
        bsp_octree::build(*tool, lattice, {}, context, solid.shared_store());
    if (!built) return built.error();
    Result<bsp_octree::BspOctree> cut = solid.subtract(built->octree, nullptr, context);
    if (!cut) return std::move(cut).error();

    CutBspOctree result{std::move(*cut), {}};
    bsp::PlaneTable& planes = solid.shared_store()->planes;
    for (const mesh::Triangle& t : tool->triangles)
        result.cut.push_back(planes
                                 .add(lattice.snap(tool->vertices[t[0]]), lattice.snap(tool->vertices[t[1]]),
                                      lattice.snap(tool->vertices[t[2]]))
                                 .opposite());
    std::sort(result.cut.begin(), result.cut.end());
    result.cut.erase(std::unique(result.cut.begin(), result.cut.end()), result.cut.end());
    return result;
}

}  // namespace octavo::render
