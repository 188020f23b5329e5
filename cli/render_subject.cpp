// SPDX-License-Identifier: Apache-2.0
#include "render_subject.hpp"

#include <fmt/format.h>

#include <octavo/bsp_octree/bso_file.hpp>
#include <octavo/bsp_octree/to_mesh.hpp>
#include <octavo/mesh/used_vertices.hpp>

namespace octavo::cli {
namespace {

render::EdgeLines lines_of(const std::string& word, render::EdgeLines automatic) {
    if (word == "none" || word == "contours") return render::EdgeLines::none;
    if (word == "sharp") return render::EdgeLines::sharp;
    if (word == "all") return render::EdgeLines::all;
    return automatic;
}

void set_surface(Subject& subject, mesh::Mesh surface, const SubjectOptions& options) {
    render::MeshSceneOptions scene;
    scene.edges = lines_of(options.edges, render::EdgeLines::sharp);
    scene.sharp_degrees = options.sharp_degrees;
    if (options.color == "source") scene.colors = render::MeshColors::source;
    subject.scene = render::scene_of(surface, scene);
    subject.surface = std::move(surface);
    subject.wants_contours = options.edges != "none";
}

Result<Subject> surface_subject(Session& session, const Context& context, const SubjectOptions& options) {
    Result<io::ReadMesh> read = read_surface(session, context, options.input, options.format,
                                             {.keep_sources = options.color == "source"});
    if (!read) return std::move(read).error();
    Subject subject;
    if (options.cut.empty()) {
        set_surface(subject, std::move(read->mesh), options);
        return subject;
    }
    const Box3 removed = removed_box(options.cut, mesh::bounds_of_facets(read->mesh));
    Result<mesh::Mesh> cut =
        session.timed("cut", [&] { return render::cut_open(read->mesh, removed, context); });
    if (!cut && cut.error().code != ErrorCode::not_a_solid)
        return in_file(std::move(cut).error(), options.input);
    if (cut) {
        set_surface(subject, std::move(*cut), options);
        return subject;
    }
    subject.uncut = in_file(std::move(cut).error(), options.input);
    const CutRange range = options.cut[0];
    if (options.cut.size() > 1 || range.to < 1) return std::move(*subject.uncut);
    subject.cut_axis = range.axis;
    subject.cut_at =
        range.from > 0 ? removed.low[range.axis] : mesh::bounds_of_facets(read->mesh).low[range.axis];
    set_surface(subject, std::move(read->mesh), options);
    return subject;
}

Result<Subject> octree_subject(Session& session, const Context& context, const SubjectOptions& options) {
    Result<octree::Octree> tree = read_octree(session, context, options.input, options.format);
    if (!tree) return std::move(tree).error();
    render::OctreeSceneOptions scene;
    scene.edges = options.edges == "contours" ? render::EdgeLines::none
                                              : lines_of(options.edges, render::EdgeLines::all);
    const Box3 bounds = render::scene_of(*tree, {.edges = render::EdgeLines::none}).bounds();
    scene.removed = removed_box(options.cut, bounds);
    Subject subject;
    subject.scene = render::scene_of(*tree, scene);
    return subject;
}

Result<Subject> bsp_octree_subject(Session& session, const Context& context, const SubjectOptions& options) {
    session.inputs.push_back(options.input);
    Result<bsp_octree::BspOctree> tree =
        session.timed("read", [&] { return bsp_octree::read_bso(options.input, context); });
    if (!tree) return std::move(tree).error();
    const auto surface_of = [&](const bsp_octree::BspOctree& solid) {
        return session.timed("to_mesh", [&] { return bsp_octree::to_mesh(solid, context); });
    };
    Result<bsp_octree::ToMesh> surface = surface_of(*tree);
    if (!surface) return in_file(std::move(surface).error(), options.input);
    Subject subject;
    subject.bsp_octree = render::CutBspOctree{std::move(*tree), {}};
    if (!options.cut.empty()) {
        const Box3 removed = removed_box(options.cut, mesh::bounds_of_facets(surface->mesh));
        Result<render::CutBspOctree> cut = session.timed(
            "cut", [&] { return render::cut_open(subject.bsp_octree->solid, removed, context); });
        if (!cut) return in_file(std::move(cut).error(), options.input);
        subject.bsp_octree = std::move(*cut);
        surface = surface_of(subject.bsp_octree->solid);
        if (!surface) return in_file(std::move(surface).error(), options.input);
    }
    set_surface(subject, std::move(surface->mesh), options);
    if (options.color == "node") subject.bsp_octree_colors = render::BspOctreeColors::node;
    return subject;
}

/// Which models have the colours that the word names.
Status check_color(Session& session, const std::string& color, ModelKind kind) {
    const bool has_nodes = kind == ModelKind::octree || kind == ModelKind::bsp_octree;
    if (color == "node" && !has_nodes)
        return session.usage_error("--paint node is for octrees: .oct and .bso; this model has no nodes");
    if (color == "source" && kind != ModelKind::csg)
        return session.usage_error(
            "--paint source is for .csg, whose parts a model of another kind does not know");
    if (color == "solid" && kind == ModelKind::octree)
        return session.usage_error("an octree (.oct) is drawn as its cells, by the colour of its nodes");
    return Done{};
}

}  // namespace

Result<Subject> read_subject(Session& session, const Context& context, const SubjectOptions& options) {
    const ModelKind kind = kind_of(options.input, options.format);
    if (Status color = check_color(session, options.color, kind); !color) return std::move(color).error();
    if (kind == ModelKind::octree) return octree_subject(session, context, options);
    if (kind == ModelKind::bsp_octree) return bsp_octree_subject(session, context, options);
    return surface_subject(session, context, options);
}

}  // namespace octavo::cli
