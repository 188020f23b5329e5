// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include <octavo/octree/linear_octree.hpp>
#include <octavo/query/inside.hpp>
#include <octavo/query/stored_inside.hpp>

#include "point_query.hpp"

// `octavo contains MODEL POINTS`: on which side of the solid each point lies; −1 inside, 0 on, +1 outside. Of an octree
// the colour of the point's cell decides, and 0 means a gray cell: not decided at that depth.

namespace octavo::cli {
namespace {

using Sides = std::vector<query::Side>;

/// Cells are half-open, so a point in a wall goes with the cell on its high side.
query::Side side_in(const octree::LinearOctree& tree, Vec3 point) {
    const std::optional<exact::Point> unit_cell = tree.lattice().cell_at(point);
    if (!unit_cell) return query::Side::outside;
    switch (tree.color(tree.locate(*unit_cell))) {
        case octree::Color::black:
            return query::Side::inside;
        case octree::Color::gray:
            return query::Side::on;
        case octree::Color::white:
            break;
    }
    return query::Side::outside;
}

Result<Sides> sides_in_octree(Session& session, const Context& context, const PointQueryOptions& options,
                              const std::vector<Vec3>& points) {
    Result<octree::Octree> tree = read_octree(session, context, options.model, options.model_format);
    if (!tree) return std::move(tree).error();
    Result<octree::LinearOctree> leaves =
        session.timed("build", [&] { return octree::LinearOctree::from(*tree); });
    if (!leaves) return in_file(std::move(leaves).error(), options.model);
    Sides sides(points.size());
    session.timed("query", [&] {
        std::transform(points.begin(), points.end(), sides.begin(),
                       [&](Vec3 point) { return side_in(*leaves, point); });
    });
    const auto undecided = std::count(sides.begin(), sides.end(), query::Side::on);
    if (undecided)
        session.warn(
            fmt::format("{} points lie in gray cells: the octree does not decide them; they are told as 0",
                        grouped(static_cast<std::uint64_t>(undecided))));
    return sides;
}

/// So few answers come sooner from a .bpo file where it lies than decoding it takes.
constexpr std::size_t few_points = 100;

Result<Sides> sides_from_file(Session& session, const PointQueryOptions& options,
                              const std::vector<Vec3>& points) {
    session.inputs.push_back(options.model);
    Result<query::StoredInside> stored =
        session.timed("open", [&] { return query::StoredInside::open(options.model); });
    if (!stored) return in_file(std::move(stored).error(), options.model);
    return session.timed("query", [&]() -> Result<Sides> {
        Sides sides;
        for (const Vec3& point : points) {
            const Result<query::Side> side = (*stored)(point);
            if (!side) return in_file(side.error(), options.model);
            sides.push_back(*side);
        }
        return sides;
    });
}

Result<Sides> sides_of_surface(Session& session, const Context& context, const PointQueryOptions& options,
                               const std::vector<Vec3>& points) {
    Result<mesh::LatticeMesh> solid = read_on_lattice(session, context, options.model, options.model_format);
    if (!solid) return std::move(solid).error();
    query::InsideOptions asking;
    asking.open = options.policy();
    Result<query::InsideQuery> inside =
        session.timed("build", [&] { return query::InsideQuery::build(*solid, asking, context); });
    if (!inside) return in_file(std::move(inside).error(), options.model);
    return session.timed("query", [&] { return (*inside)(points, context); });
}

Result<Sides> sides_of(Session& session, const Context& context, const PointQueryOptions& options,
                       const std::vector<Vec3>& points) {
    const ModelKind kind = kind_of(options.model, options.model_format);
    if (kind == ModelKind::octree) return sides_in_octree(session, context, options, points);
    if (kind == ModelKind::bp_octree && options.model != "-" && points.size() <= few_points)
        return sides_from_file(session, options, points);
    return sides_of_surface(session, context, options, points);
}

Result<ExitCode> contains(Session& session, const PointQueryOptions& options) {
    const Context context = session.context();
    const Result<AnswerOutput> output = settle_answers(session, options);
    if (!output) return output.error();
    const Result<std::vector<Vec3>> points =
        read_points(session, context, options, "they are told as outside");
    if (!points) return points.error();
    const Result<Sides> sides = sides_of(session, context, options, *points);
    if (!sides) return sides.error();
    if (context.cancelled()) return Context::cancelled_error();

    std::vector<std::int8_t> column(sides->size());
    std::transform(sides->begin(), sides->end(), column.begin(),
                   [](query::Side side) { return static_cast<std::int8_t>(side); });
    const auto count = [&](int side) {
        return static_cast<std::uint64_t>(std::count(column.begin(), column.end(), side));
    };
    session.result = {{"inside", count(-1)}, {"outside", count(1)}, {"on", count(0)}};
    session.text = fmt::format("{} points: {} inside, {} on, {} outside\n", grouped(column.size()),
                               grouped(count(-1)), grouped(count(0)), grouped(count(1)));
    if (Status status = deliver(session, context, *output, {{"side", std::span<const std::int8_t>(column)}});
        !status)
        return std::move(status).error();
    return ExitCode::ok;
}

}  // namespace

void add_contains(Program& program) {
    const auto options = std::make_shared<PointQueryOptions>();
    Verb* verb =
        program.verb("contains", "Analyse", "Tell for each point whether it is inside, on or outside a solid",
                     [options](Session& session) { return contains(session, *options); });
    add_point_query_options(
        verb, *options,
        "A closed mesh, a CSG tree (.csg), a BP-octree (.bpo), or an octree (.oct), whose gray "
        "cells answer 0",
        "the sides (-1 inside, 0 on, 1 outside)");
}

}  // namespace octavo::cli
