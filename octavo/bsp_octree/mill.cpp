// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <ctime>

#include <octavo/base/counted.hpp>
#include <octavo/bsp_octree/bounds.hpp>
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

bool overlap(const Box3& a, const Box3& b) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(a.low[axis] <= b.high[axis] && b.low[axis] <= a.high[axis])) return false;
    return true;
}

/// Holds the image of whatever is in `box`, also as it is rounded. Three products and three sums of terms of at most L
/// are off by less than 2^-49 L, and so are the corners.
Box3 image_of(const Box3& box, const Affine& pose) {
    Box3 image;
    if (box.empty()) return image;
    for (int corner = 0; corner < 8; ++corner)
        image.add(pose({corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                        corner & 4 ? box.high.z : box.low.z}));
    for (int row = 0; row < 3; ++row) {
        const auto& m = pose.m[static_cast<std::size_t>(row)];
        double largest = std::fabs(m[3]);
        for (int axis = 0; axis < 3; ++axis)
            largest = std::max(largest, std::fabs(m[static_cast<std::size_t>(axis)]) *
                                            std::max(std::fabs(box.low[axis]), std::fabs(box.high[axis])));
        const double slack = std::ldexp(largest, -48);
        image.low[row] -= slack, image.high[row] += slack;
    }
    return image;
}

/// Error: bad_input for the first pose that takes the tool to coordinates that are not finite.
Status check_poses(const Box3& tool, std::span<const Affine> poses) {
    for (std::size_t i = 0; i < poses.size() && !tool.empty(); ++i)
        if (const Box3 box = image_of(tool, poses[i]); !is_finite(box.low) || !is_finite(box.high))
            return Error{ErrorCode::bad_input,
                         "pose " + std::to_string(i) +
                             ", counted from 0, takes the tool to coordinates that are not finite",
                         {}};
    return Done{};
}

/// Where the tool comes near what lies in `work`: its boxes at these poses.
std::vector<Box3> boxes_near(const Box3& work, const Box3& tool, std::span<const Affine> poses) {
    std::vector<Box3> boxes;
    for (const Affine& pose : poses)
        if (const Box3 box = image_of(tool, pose); overlap(box, work)) boxes.push_back(box);
    return boxes;
}

Error of_operand(Error error, std::uint32_t operand) {
    if (error.code != ErrorCode::cancelled) error.place.operand = operand;
    return error;
}

void warn_of(const BuildReport& built, const std::string& what, std::vector<std::string>& warnings) {
    for (const std::string& warning : built.warnings) warnings.push_back(what + ": " + warning);
    if (built.resolved)
        warnings.push_back(what + " meets itself; it is taken for where it winds about a point");
    if (built.facets_without_area > 0)
        warnings.push_back(
            counted(built.facets_without_area, "facet of " + what + " has", "facets of " + what + " have") +
            " no area on the lattice");
}

/// Takes the tool away from one version of the workpiece after the other.
class Miller {
  public:
    /// `bounds` holds the workpiece.
    Miller(Milled& milled, const Box3& bounds, const mesh::Mesh& tool, const MillOptions& options,
           const Context& context)
        : milled_(milled),
          bounds_(bounds),
          tool_(tool),
          options_(options),
          context_(context),
          alive_(milled.solid.store().bytes()) {}

    Status step(const Affine& pose, const OnMillStep& on_step) {
        const double start = thread_seconds();
        Edit edit;
        if (Status taken = take_away(pose, edit); !taken) return taken;
        collect_garbage();
        MillReport& report = milled_.report;
        const double seconds = thread_seconds() - start;
        report.step_seconds.push_back(seconds);
        report.cutting_steps += !edit.changed.empty();
        if (on_step) on_step({report.steps, seconds, milled_.solid, edit.changed});
        ++report.steps;
        return Done{};
    }

  private:
    Status take_away(const Affine& pose, Edit& edit) {
        const mesh::Mesh moved = mesh::transform(tool_, pose);
        if (!overlap(mesh::bounds_of_facets(moved), bounds_)) return Done{};
        BspOctree& solid = milled_.solid;
        const Result<Built> built =
            build(moved, solid.lattice(), {.octree = solid.options()}, context_, solid.shared_store());
        if (!built) return of_operand(built.error(), 1);
        Result<BspOctree> rest = solid.subtract(built->octree, &edit, context_);
        if (!rest) return std::move(rest).error();
        solid = std::move(*rest);
        return Done{};
    }

    void collect_garbage() {
        BspOctree& solid = milled_.solid;
        if (static_cast<double>(solid.store().bytes()) <= options_.most_garbage * static_cast<double>(alive_))
            return;
        solid = solid.compacted();
        alive_ = solid.store().bytes();
        ++milled_.report.collections;
    }

    Milled& milled_;
    Box3 bounds_;
    const mesh::Mesh& tool_;
    const MillOptions& options_;
    const Context& context_;
    std::size_t alive_;  ///< bytes of the workpiece after the last collection
};

Result<Milled> mill_all(Milled milled, const Box3& bounds, const mesh::Mesh& tool,
                        std::span<const Affine> poses, const MillOptions& options, const Context& context,
                        const OnMillStep& on_step) {
    Context quiet = context;
    quiet.on_progress = nullptr;  // steps are parts of one phase
    // Where it is nowhere near the workpiece, nobody would look at the tool.
    const Result<Built> built = build(tool, {}, quiet);
    if (!built) return of_operand(built.error(), 1);
    warn_of(built->report, "the tool", milled.report.warnings);
    const mesh::Mesh used = mesh::without_unused_vertices(tool);
    Miller miller(milled, bounds, used, options, quiet);
    for (const Affine& pose : poses) {
        if (context.cancelled()) return Context::cancelled_error();
        if (Status done = miller.step(pose, on_step); !done) return std::move(done).error();
        context.report("mill", static_cast<double>(milled.report.steps) / static_cast<double>(poses.size()));
    }
    return milled;
}

}  // namespace

Result<Milled> mill(const mesh::Mesh& work, const mesh::Mesh& tool, std::span<const Affine> poses,
                    const MillOptions& options, const Context& context, const OnMillStep& on_step) {
    const Box3 bounds = mesh::bounds_of_facets(work), tool_bounds = mesh::bounds_of_facets(tool);
    if (Status finite = check_poses(tool_bounds, poses); !finite) return std::move(finite).error();
    Box3 near = bounds;
    for (const Box3& box : boxes_near(bounds, tool_bounds, poses)) near.add(box);
    const Result<exact::Lattice> lattice = exact::Lattice::fit(near);
    if (!lattice) return lattice.error();
    Milled milled;
    const double start = thread_seconds();
    Result<Built> built = build(work, *lattice, {.octree = options.octree}, context);
    if (!built) return of_operand(std::move(built).error(), 0);
    milled.solid = std::move(built->octree);
    milled.report.build_seconds = thread_seconds() - start;
    milled.report.largest_displacement = built->report.largest_displacement;
    warn_of(built->report, "the workpiece", milled.report.warnings);
    return mill_all(std::move(milled), bounds, tool, poses, options, context, on_step);
}

Result<Milled> mill(const BspOctree& work, const mesh::Mesh& tool, std::span<const Affine> poses,
                    const MillOptions& options, const Context& context, const OnMillStep& on_step) {
    if (Status finite = check_poses(mesh::bounds_of_facets(tool), poses); !finite)
        return std::move(finite).error();
    if (!has_room(work, tool, poses))
        return Error{ErrorCode::limit, "the tool reaches beyond the lattice of the workpiece", {}};
    Milled milled;
    milled.solid = work;
    return mill_all(std::move(milled), bounds_of(work), tool, poses, options, context, on_step);
}

bool has_room(const BspOctree& work, const mesh::Mesh& tool, std::span<const Affine> poses) {
    // A unit stays free on each side.
    constexpr std::int32_t last = exact::universe_side - 2;
    const Vec3 low = work.lattice().to_world({1, 1, 1}), high = work.lattice().to_world({last, last, last});
    const std::vector<Box3> boxes = boxes_near(bounds_of(work), mesh::bounds_of_facets(tool), poses);
    return std::all_of(boxes.begin(), boxes.end(), [&](const Box3& box) {
        for (int axis = 0; axis < 3; ++axis)
            if (!(box.low[axis] >= low[axis] && box.high[axis] <= high[axis])) return false;
        return true;
    });
}

}  // namespace octavo::bsp_octree
