// SPDX-License-Identifier: Apache-2.0
#include <octavo/classic/facet_lists.hpp>
#include <octavo/classic/from_mesh.hpp>
#include <octavo/mesh/snap.hpp>

namespace octavo::classic {
namespace {

/// The DF code and how many tests made it: one a facet and cell that is split.
class CountedOutput {
  public:
    template <class Workspace>
    void split(const octree::Cell& cell, const FacetRange& range, const Workspace& workspace) {
        code_.split(cell, range, workspace);
        tests_ += range.size();
    }
    template <class Workspace>
    void leaf(const octree::Cell& cell, const octree::Restricted<FacetRange>& leaf,
              const Workspace& workspace) {
        code_.leaf(cell, leaf, workspace);
    }
    void merge(const octree::Cell& cell, octree::Color color) { code_.merge(cell, color); }
    void append(CountedOutput&& next) {
        code_.append(std::move(next.code_));
        tests_ += next.tests_;
    }

    octree::DfCode take_code() { return code_.take_code(); }
    std::uint64_t tests() const { return tests_; }

  private:
    octree::DfOutput code_;
    std::uint64_t tests_ = 0;
};

class MeshProblem {
  public:
    using Description = FacetRange;
    using Output = CountedOutput;
    struct Workspace {
        FacetLists lists;
    };

    MeshProblem(std::span<const Facet> facets, int depth) : facets_(facets), depth_(depth) {}

    int depth() const { return depth_; }
    Workspace make_workspace() const { return {}; }
    Output make_output() const { return {}; }
    std::size_t weight(const FacetRange& range) const { return range.size(); }

    octree::Restricted<FacetRange> root(Workspace& workspace) const {
        const FacetRange range = universe_facets(facets_, Touch::interior, workspace.lists);
        return {range.size() > 0 ? octree::Node::split : color_of_winding(range.winding), range};
    }

    void restrict_to_children(const octree::Cell& cell, const FacetRange& range, Workspace& workspace,
                              octree::Children<FacetRange>& children) const {
        const bool last = cell.level + 1 == depth_;
        const OctantFacets found = last
                                       ? find_touched<Touch::interior>(facets_, cell, range, workspace.lists)
                                       : find_octants<Touch::interior>(facets_, cell, range, workspace.lists);
        for (std::size_t octant = 0; octant < 8; ++octant) {
            const bool touched = found.touched >> octant & 1;
            children[octant].node = touched ? octree::Node::split : color_of_winding(found.winding[octant]);
        }
        if (last) return;
        const std::array<FacetRange, 8> ranges = distribute(cell, range, found, workspace.lists);
        for (std::size_t octant = 0; octant < 8; ++octant) children[octant].description = ranges[octant];
    }

    FacetRange transfer(const octree::Cell& cell, const FacetRange& range, const Workspace& from,
                        Workspace& to) const {
        return classic::transfer(cell, range, from.lists, to.lists);
    }

  private:
    static octree::Node color_of_winding(std::int32_t winding) {
        return winding > 0 ? octree::Node::black : octree::Node::white;
    }

    std::span<const Facet> facets_;
    int depth_;
};

}  // namespace

Result<Built> build(const mesh::LatticeMesh& mesh, const BuildOptions& options, const Context& context) {
    if (options.depth < 0 || options.depth > octree::max_level)
        return Error{ErrorCode::bad_input,
                     "the depth of an octree is 0 to 21, not " + std::to_string(options.depth),
                     {}};
    Result<std::vector<Facet>> facets = facets_of(mesh);
    if (!facets) return facets.error();
    if (const Status some = check_some_have_area(mesh); !some) return some.error();

    Built built;
    built.report.facets_without_area = mesh.triangles.size() - facets->size();
    const std::vector<OpenEdge> open = open_edges(mesh);
    if (!open.empty()) {
        const Error error = open_surface_error(open);
        if (options.open == OpenPolicy::reject) return error;
        const mesh::LatticeMesh closed = close_holes(mesh, open);
        built.report.open_facets = error.place.faces;
        built.report.closing_facets = closed.triangles.size() - mesh.triangles.size();
        facets = facets_of(closed);
    }

    Result<CountedOutput> output =
        octree::descend(MeshProblem(*facets, options.depth), context, {.max_nodes = options.max_nodes});
    if (!output) return output.error();
    built.octree = octree::Octree(mesh.lattice, options.depth, output->take_code());
    built.report.primitive_tests = output->tests();
    built.report.peak_nodes = built.octree.code().size();
    return built;
}

Result<Built> build(const mesh::Mesh& mesh, const BuildOptions& options, const Context& context) {
    Result<mesh::Snapped> snapped = mesh::snap(mesh);
    if (!snapped) return snapped.error();
    return build(snapped->mesh, options, context);
}

}  // namespace octavo::classic
