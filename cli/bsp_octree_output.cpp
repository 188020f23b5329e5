// SPDX-License-Identifier: Apache-2.0
#include "bsp_octree_output.hpp"

#include <octavo/bsp_octree/bso_file.hpp>

#include "model.hpp"

namespace octavo::cli {

const OutputFormats& bsp_octree_outputs() {
    static const OutputFormats formats = [] {
        OutputFormats all{"BSP-octrees", {"bso"}, "bso"};
        all.names.insert(all.names.end(), mesh_outputs().names.begin(), mesh_outputs().names.end());
        return all;
    }();
    return formats;
}

Result<WrittenBspOctree> write_bsp_octree(Session& session, const Context& context, const std::string& path,
                                          const bsp_octree::BspOctree& solid, const std::string& format) {
    WrittenBspOctree result;
    if (format == "bso") {
        if (path == "-") session.stdout_taken = true;
        Result<io::WriteReport> report =
            session.timed("write", [&] { return bsp_octree::write_bso(path, solid, context); });
        if (!report) return std::move(report).error();
        result.report = std::move(*report);
        return result;
    }
    Result<bsp_octree::ToMesh> made =
        session.timed("mesh", [&] { return bsp_octree::to_mesh(solid, context); });
    if (!made) return std::move(made).error();
    Result<io::WriteReport> report = write_mesh(session, context, path, made->mesh, {.format = format});
    if (!report) return std::move(report).error();
    result.report = std::move(*report);
    result.made = std::move(*made);
    return result;
}

}  // namespace octavo::cli
