// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <ctime>

#include <octavo/bsp_octree/mill.hpp>
#include <octavo/mesh/transform.hpp>
#include <octavo/mesh/used_vertices.hpp>

namespace octavo::bsp_octree {
namespace {

/// CPU seconds of this thread.
double thread_seconds() {
#ifdef CLOCK_THREAD_CPUTIME_ID
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
#else
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
#endif
}

/// The finest lattice that holds the workpiece and the tool at every pose.
Result<exact::Lattice> joint_lattice(const mesh::Mesh& work, const mesh::Mesh& tool,
                                     std::span<const Affine> poses) {
    Box3 bounds = mesh::bounds_of_facets(work);
    const Box3 box = mesh::bounds_of_facets(tool);
    if (!box.empty())
        for (const Affine& pose : poses)
            for (int corner = 0; corner < 8; ++corner)
                bounds.add(pose({corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                                 corner & 4 ? box.high.z : box.low.z}));
    return exact::Lattice::fit(bounds);
}

}  // namespace

Result<Milled> mill(const mesh::Mesh& work, const mesh::Mesh& tool, std::span<const Affine> poses,
                    const MillOptions& options, const Context& context,
                    const std::function<void(const MillStep&)>& on_step) {
    const Result<exact::Lattice> lattice = joint_lattice(work, tool, poses);
    if (!lattice) return lattice.error();
    MeshOptions building;
    building.octree = options.octree;
    Milled milled;
    double start = thread_seconds();
    Result<Built> built = build(work, *lattice, building, context);
    if (!built) return built.error();
    milled.solid = std::move(built->octree);
    milled.report.build_seconds = thread_seconds() - start;

    std::size_t alive = milled.solid.store().bytes();
    for (const Affine& pose : poses) {
        if (context.cancelled()) return Context::cancelled_error();
        start = thread_seconds();
        const Result<Built> at =
            build(mesh::transform(tool, pose), *lattice, building, {}, milled.solid.shared_store());
        if (!at) return at.error();
        Edit edit;
        Result<BspOctree> cut = milled.solid.subtract(at->octree, &edit);
        if (!cut) return cut.error();
        milled.solid = std::move(*cut);
        if (static_cast<double>(milled.solid.store().bytes()) >
            options.most_garbage * static_cast<double>(alive)) {
            milled.solid = milled.solid.compacted();
            alive = milled.solid.store().bytes();
            ++milled.report.collections;
        }
        const double seconds = thread_seconds() - start;
        milled.report.step_seconds.push_back(seconds);
        milled.report.cutting_steps += !edit.changed.empty();
        if (on_step) on_step({milled.report.steps, seconds, milled.solid, edit.changed});
        ++milled.report.steps;
        context.report("mill", static_cast<double>(milled.report.steps) / static_cast<double>(poses.size()));
    }
    return milled;
}

}  // namespace octavo::bsp_octree
