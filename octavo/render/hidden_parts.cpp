// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <utility>

#include <octavo/render/hidden_parts.hpp>
#include <octavo/render/picture_size.hpp>
#include <octavo/render/regions.hpp>
#include <octavo/render/strokes.hpp>
#include <octavo/render/visible.hpp>

namespace octavo::render {

Result<Drawing> remove_hidden_parts(const Scene& scene, const Camera& camera, const DrawingOptions& options,
                                    const Context& context) {
    if (Status size = check_size(options.width, options.height); !size) return std::move(size).error();
    const Result<Patches> patches = patches_of(scene, camera, context);
    if (!patches) return patches.error();
    return remove_hidden_parts(*patches, scene.lines, camera, options, context);
}

Result<Drawing> remove_hidden_parts(const Patches& patches, std::span<const Line> lines, const Camera& camera,
                                    const DrawingOptions& options, const Context& context) {
    if (Status size = check_size(options.width, options.height); !size) return std::move(size).error();
    std::vector<WorldLine> world_lines;
    for (const Line& line : lines) {
        if (!is_finite(line.from) || !is_finite(line.to))
            return Error{ErrorCode::bad_input, "a line has an end that is not finite", {}};
        world_lines.push_back({line.from, line.to});
    }
    const Result<Visible> visible =
        visible_parts(patches, world_lines, camera, options.width, options.height, context);
    if (!visible) return visible.error();

    Drawing drawing{options.width, options.height, options.background, {}, {}, {}, options.line_width};
    drawing.regions = regions_of(*visible, patches.patches);
    LineStrokes strokes = strokes_of(lines, visible->hidden, camera);
    drawing.edges = std::move(strokes.visible);
    if (options.hidden_lines == HiddenLines::dash) drawing.hidden = std::move(strokes.hidden);
    return drawing;
}

}  // namespace octavo::render
