// SPDX-License-Identifier: Apache-2.0
#include <octavo/bsp_octree/subdivide.hpp>
#include <octavo/mesh/weld.hpp>
#include <octavo/render/patch_maker.hpp>
#include <octavo/render/tree_order.hpp>

namespace octavo::render {
namespace {

using bsp_octree::Fragments;

/// The facets of a scene as lattice triangles; those without area are left out.
struct LatticeFacets {
    exact::Lattice lattice;
    std::vector<exact::Point> points;
    std::vector<mesh::Triangle> triangles;
    std::vector<std::uint32_t> facet;  ///< of the scene, by triangle
};

Result<LatticeFacets> on_lattice(const Scene& scene) {
    Box3 bounds;
    for (const Facet& facet : scene.facets)
        for (const Vec3& corner : facet.corners) {
            if (!is_finite(corner))
                return Error{ErrorCode::bad_input, "a facet has a corner that is not finite", {}};
            bounds.add(corner);
        }
    LatticeFacets result;
    if (scene.facets.empty()) return result;
    Result<exact::Lattice> lattice = exact::Lattice::fit(bounds);
    if (!lattice) return std::move(lattice).error();
    result.lattice = *lattice;

    std::vector<exact::Point> corners;
    corners.reserve(3 * scene.facets.size());
    for (const Facet& facet : scene.facets)
        for (const Vec3& corner : facet.corners) corners.push_back(lattice->snap(corner));
    const mesh::WeldMap weld = mesh::equal_vertices(corners);
    for (const mesh::VertexIndex kept : weld.kept) result.points.push_back(corners[kept]);
    for (std::uint32_t i = 0; i < scene.facets.size(); ++i) {
        const mesh::Triangle t{weld.index[3 * i], weld.index[3 * i + 1], weld.index[3 * i + 2]};
        if (exact::Plane::through(result.points[t[0]], result.points[t[1]], result.points[t[2]]).degenerate())
            continue;
        result.triangles.push_back(t);
        result.facet.push_back(i);
    }
    return result;
}

/// Subdivides for one view, and hands leaf after leaf to the patch maker.
class SceneOrder {
  public:
    SceneOrder(const Scene& scene, const LatticeFacets& facets, PatchMaker& maker, const Context& context)
        : scene_(scene),
          facets_(facets),
          pool_(store_.planes, facets.points, facets.triangles),
          workspace_(store_, pool_, {}, context, "order"),
          maker_(maker),
          context_(context) {}

    void run() {
        Fragments fragments;
        for (std::uint32_t i = 0; i < facets_.triangles.size(); ++i) {
            const mesh::Triangle& t = facets_.triangles[i];
            const bsp::Facing facing =
                store_.planes.add(facets_.points[t[0]], facets_.points[t[1]], facets_.points[t[2]]);
            fragments.push_back(pool_.triangle(i, facing));
        }
        visit(octree::Cell::root(), fragments);
    }

  private:
    void visit(const octree::Cell& cell, std::span<const bsp::Fragment> fragments) {
        if (context_.cancelled()) return;
        if (fragments.empty()) return workspace_.finish(cell);
        const bsp::FragmentPool::Mark mark = pool_.mark();
        const std::array<Fragments, 8>* octants = nullptr;
        if (!workspace_.is_simple(cell, fragments)) octants = &workspace_.distribute(cell, fragments);
        if (!octants || workspace_.is_futile(fragments, *octants)) {
            add_leaf(fragments);
            workspace_.finish(cell);
        } else {
            const int nearest = maker_.eye().nearest_octant(cell);
            for (int k = 0; k < 8; ++k)
                visit(cell.child(nearest ^ k), (*octants)[static_cast<std::size_t>(nearest ^ k)]);
        }
        pool_.release(mark);
    }

    void add_leaf(std::span<const bsp::Fragment> fragments) {
        const bsp_octree::NodeRef leaf = workspace_.make_leaf(fragments);
        sorted_.clear();
        order_.sort(pool_, store_.tree(leaf), maker_.eye(), fragments, sorted_);
        for (const bsp::Fragment& fragment : sorted_) {
            const Facet& facet = scene_.facets[facets_.facet[fragment.source]];
            maker_.add(pool_, fragment, {facet.front, facet.back, facet.is_cap});
        }
        store_.nodes.clear(), store_.leaves.clear();
    }

    const Scene& scene_;
    const LatticeFacets& facets_;
    bsp_octree::Store store_;
    bsp::FragmentPool pool_;
    bsp_octree::Workspace workspace_;
    PatchMaker& maker_;
    const Context& context_;
    TreeOrder order_;
    Fragments sorted_;
};

}  // namespace

Result<Patches> patches_of(const Scene& scene, const Camera& camera, const Context& context) {
    const Result<LatticeFacets> facets = on_lattice(scene);
    if (!facets) return facets.error();
    PatchMaker maker(camera, facets->lattice);
    SceneOrder(scene, *facets, maker, context).run();
    if (context.cancelled()) return Context::cancelled_error();
    return std::move(maker).take();
}

}  // namespace octavo::render
