// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <octavo/render/cut_open.hpp>
#include <octavo/render/patches.hpp>
#include <octavo/render/scene.hpp>

#include "model.hpp"
#include "render_cut.hpp"

// What `render` draws: a model of any kind, cut open, as a scene.

namespace octavo::cli {

struct SubjectOptions {
    std::string input, format, edges = "auto", color = "auto";
    double sharp_degrees = 30;
    Cut cut;
};

struct Subject {
    render::Scene scene;

    /// Of surfaces, to find contours in; empty otherwise.
    mesh::Mesh surface;
    bool wants_contours = false;

    /// A BSP-octree is drawn in its own order.
    std::optional<render::CutBspOctree> bsp_octree;
    render::BspOctreeColors bsp_octree_colors = render::BspOctreeColors::solid;

    /// Set when the surface bounds no solid, and so cannot be cut by the kernel: what lies beyond is not drawn.
    std::optional<Error> uncut;
    int cut_axis = 0;
    double cut_at = Box3::infinity;
};

/// Reads the model, cuts it open and makes the scene. Errors: those of reading; usage for colours that the model does
/// not have.
Result<Subject> read_subject(Session& session, const Context& context, const SubjectOptions& options);

}  // namespace octavo::cli
