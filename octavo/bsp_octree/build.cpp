// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/base/shared_progress.hpp>
#include <octavo/bsp_octree/build.hpp>
#include <octavo/bsp_octree/self_contact.hpp>
#include <octavo/bsp_octree/subdivide.hpp>
#include <octavo/classic/closed_surface.hpp>
#include <octavo/classic/crossing.hpp>
#include <octavo/classic/facet.hpp>
#include <octavo/classic/octant_overlap.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/used_vertices.hpp>

namespace octavo::bsp_octree {
namespace {

/// Colours of cells without faces by the winding number at their low corners.
class WindingColors {
  public:
    using State = std::int32_t;

    /// `facets` by source triangle; `separates` when they have 0 before and 1 behind them everywhere.
    WindingColors(std::span<const classic::Facet> facets, bool separates)
        : facets_(facets), separates_(separates) {}

    std::array<State, 8> octants(const octree::Cell& cell, std::span<const bsp::Fragment> fragments,
                                 State winding) {
        using Frame = classic::OctantFrame<classic::Touch::interior>;
        const Frame frame(cell);
        std::array<int, classic::octant_steps.size()> change{};
        const std::int32_t half = cell.side() >> 1;
        for (const bsp::Fragment& fragment : fragments) {
            const classic::Facet& facet = facets_[fragment.source];
            unsigned steps = frame.bounds(facet).steps;
            for (; steps; steps &= steps - 1) {
                const auto step = static_cast<std::size_t>(std::countr_zero(steps));
                const auto [from, axis] = classic::octant_steps[step];
                const exact::Point low = cell.child(from).low;
                change[step] += classic::crossing(facet, {low.x, low.y, low.z}, axis, half);
            }
        }
        std::array<State, 8> windings{winding};
        for (std::size_t step = 0; step < classic::octant_steps.size(); ++step) {
            const auto [from, axis] = classic::octant_steps[step];
            windings[from + (std::size_t{1} << axis)] = windings[from] + change[step];
        }
        return windings;
    }

    bsp::Label label(const octree::Cell&, State winding) const {
        return winding > 0 ? bsp::Label::in : bsp::Label::out;
    }

    NodeRef leaf(Workspace& workspace, const octree::Cell& cell, std::span<const bsp::Fragment> fragments,
                 State winding) const {
        return separates_ ? workspace.make_leaf(fragments)
                          : workspace.make_resolved_leaf(cell, fragments, winding);
    }

  private:
    std::span<const classic::Facet> facets_;
    bool separates_;
};

/// The facets of a mesh by index; those without area are left as they are and not used.
std::vector<classic::Facet> by_source(const std::vector<classic::Facet>& facets, std::size_t count) {
    std::vector<classic::Facet> all(count);
    for (const classic::Facet& facet : facets) all[facet.source] = facet;
    return all;
}

bool keeps_a_unit_free(const mesh::LatticeMesh& mesh) {
    return std::all_of(mesh.points.begin(), mesh.points.end(), [](exact::Point p) {
        const auto within = [](std::int32_t v) { return v > 0 && v < exact::universe_side - 1; };
        return within(p.x) && within(p.y) && within(p.z);
    });
}

/// Builds from a closed surface; `separates` when its facets have 0 before and 1 behind them everywhere.
Result<Built> build_from(const mesh::LatticeMesh& lattice_mesh, bool separates, const Options& options,
                         const Context& context, std::shared_ptr<Store> store) {
    Result<std::vector<classic::Facet>> facets = classic::facets_of(lattice_mesh);
    if (!facets) return facets.error();
    Built built;
    built.report.facets_without_area = lattice_mesh.triangles.size() - facets->size();
    if (!store) store = std::make_shared<Store>();
    bsp::FragmentPool pool(store->planes, lattice_mesh.points, lattice_mesh.triangles);
    Fragments fragments;
    fragments.reserve(facets->size());
    for (const classic::Facet& facet : *facets) {
        const mesh::Triangle& t = lattice_mesh.triangles[facet.source];
        const bsp::Facing facing = store->planes.add(lattice_mesh.points[t[0]], lattice_mesh.points[t[1]],
                                                     lattice_mesh.points[t[2]]);
        fragments.push_back(pool.triangle(facet.source, facing));
    }
    const std::vector<classic::Facet> sources = by_source(*facets, lattice_mesh.triangles.size());
    Workspace workspace(*store, pool, options, context, "octree");
    Subdivider<WindingColors> subdivide(workspace, WindingColors(sources, separates));
    const NodeRef root = subdivide(octree::Cell::root(), fragments, 0);
    if (context.cancelled()) return Context::cancelled_error();
    built.octree = BspOctree(lattice_mesh.lattice, options, std::move(store), root);
    built.report.resolved = workspace.resolved_leaves() > 0;
    if (root.is_white() && built.report.resolved)
        built.report.warnings.push_back("the surface winds about nothing; its facets may look inwards");
    return built;
}

}  // namespace

Result<Built> build(const mesh::Mesh& mesh, const MeshOptions& options, const Context& context) {
    if (mesh.triangles.empty()) return Built{BspOctree(exact::Lattice{}, options.octree), {}};
    Result<exact::Lattice> lattice = exact::Lattice::fit(mesh::bounds_of_facets(mesh));
    if (!lattice) return lattice.error();
    return build(mesh, *lattice, options, context);
}

Result<Built> build(const mesh::Mesh& mesh, const exact::Lattice& lattice, const MeshOptions& options,
                    const Context& context, std::shared_ptr<Store> store) {
    if (Status in_range = check(options.octree); !in_range) return std::move(in_range).error();
    Result<mesh::Snapped> snapped = mesh::snap(mesh, lattice);
    if (!snapped) return snapped.error();
    if (!keeps_a_unit_free(snapped->mesh))
        return Error{ErrorCode::bad_input, "the mesh reaches the border of the lattice's universe", {}};
    if (Result<std::vector<classic::Facet>> facets = classic::facets_of(snapped->mesh); !facets)
        return facets.error();
    const std::vector<classic::OpenEdge> open = classic::open_edges(snapped->mesh);
    if (!open.empty()) return classic::open_surface_error(open);
    if (context.cancelled()) return Context::cancelled_error();

    bool separates = true;
    if (options.surface == SurfaceCheck::resolve) {
        context.report("surface", 0);
        const Result<bool> meets = may_meet_itself(snapped->mesh, context);
        if (!meets) return meets.error();
        separates = !*meets;
    }
    context.report("octree", 0.4);
    Result<Built> built = build_from(snapped->mesh, separates, options.octree,
                                     part_of(context, "octree", 0.4, 1), std::move(store));
    if (!built) return built;
    built->report.moved_vertices = snapped->report.moved_vertices;
    built->report.largest_displacement = snapped->report.largest_displacement;
    return built;
}

}  // namespace octavo::bsp_octree
