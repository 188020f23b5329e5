// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include <octavo/base/counted.hpp>
#include <octavo/base/parallel.hpp>
#include <octavo/bsp_octree/bso_file.hpp>
#include <octavo/octree/linear_octree.hpp>
#include <octavo/query/inside.hpp>
#include <octavo/query/stored_inside.hpp>

#include "point_query.hpp"

// `octavo contains MODEL POINTS`: on which side of the solid each point lies; −1 inside, 0 on, +1 outside. Of an octree
// the colour of the point's cell decides, and 0 means a gray cell: not decided at that depth.

namespace octavo::cli {
namespace {

using Sides = std::vector<query::Side>;

struct Answers {
    Sides sides;
    double largest_displacement = 0;  ///< of the model's vertices, by rounding to the lattice
};

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
        session.warn(counted(static_cast<std::uint64_t>(undecided), "point lies", "points lie") +
                     " in gray cells, which the octree does not decide; the answer there is 0");
    return sides;
}

query::Side side_of(bsp::Position position) {
    switch (position) {
        case bsp::Position::in:
            return query::Side::inside;
        case bsp::Position::on:
            return query::Side::on;
        case bsp::Position::out:
            break;
    }
    return query::Side::outside;
}

Result<Sides> sides_in_bsp_octree(Session& session, const Context& context, const PointQueryOptions& options,
                                  const std::vector<Vec3>& points) {
    session.inputs.push_back(options.model);
    const Result<bsp_octree::BspOctree> tree =
        session.timed("read", [&] { return bsp_octree::read_bso(options.model, context); });
    if (!tree) return tree.error();
    Sides sides(points.size(), query::Side::outside);
    session.timed("query", [&] {
        constexpr std::size_t points_at_once = 1024;
        parallel_chunks(context, points.size(), points_at_once, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                if (is_finite(points[i])) sides[i] = side_of(tree->classify(points[i]));
        });
    });
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

Result<Answers> sides_of_surface(Session& session, const Context& context, const PointQueryOptions& options,
                                 const std::vector<Vec3>& points) {
    const Result<OnLattice> solid = read_on_lattice(session, context, options.model, options.model_format);
    if (!solid) return solid.error();
    if (options.policy() == classic::OpenPolicy::winding) warn_of_closing(session, solid->mesh);
    query::InsideOptions asking;
    asking.open = options.policy();
    Result<query::InsideQuery> inside =
        session.timed("build", [&] { return query::InsideQuery::build(solid->mesh, asking, context); });
    if (!inside) return in_file(std::move(inside).error(), options.model);
    return Answers{session.timed("query", [&] { return (*inside)(points, context); }),
                   solid->largest_displacement};
}

Result<Answers> answers_without_rounding(Result<Sides> sides) {
    if (!sides) return std::move(sides).error();
    return Answers{std::move(*sides), 0};
}

Result<Answers> answers_of(Session& session, const Context& context, const PointQueryOptions& options,
                           const std::vector<Vec3>& points) {
    const ModelKind kind = kind_of(options.model, options.model_format);
    if (kind == ModelKind::octree)
        return answers_without_rounding(sides_in_octree(session, context, options, points));
    if (kind == ModelKind::bsp_octree)
        return answers_without_rounding(sides_in_bsp_octree(session, context, options, points));
    if (kind == ModelKind::bp_octree && options.model != "-" && points.size() <= few_points)
        return answers_without_rounding(sides_from_file(session, options, points));
    return sides_of_surface(session, context, options, points);
}

Result<ExitCode> contains(Session& session, const PointQueryOptions& options) {
    const Context context = session.context();
    const Result<AnswerOutput> output = settle_answers(session, options);
    if (!output) return output.error();
    const Result<std::vector<Vec3>> points =
        read_points(session, context, options, "the answer there is outside");
    if (!points) return points.error();
    const Result<Answers> answers = answers_of(session, context, options, *points);
    session.inputs.push_back(options.points);
    if (!answers) return answers.error();
    const Sides& sides = answers->sides;
    if (context.cancelled()) return Context::cancelled_error();

    std::vector<std::int8_t> column(sides.size());
    std::transform(sides.begin(), sides.end(), column.begin(),
                   [](query::Side side) { return static_cast<std::int8_t>(side); });
    const auto count = [&](int side) {
        return static_cast<std::uint64_t>(std::count(column.begin(), column.end(), side));
    };
    session.result = {{"inside", count(-1)},
                      {"outside", count(1)},
                      {"on", count(0)},
                      {"largest_displacement", answers->largest_displacement}};
    session.text =
        fmt::format("{}: {} inside, {} on, {} outside\n", counted(column.size(), "point", "points"),
                    grouped(count(-1)), grouped(count(0)), grouped(count(1))) +
        rounding_text(answers->largest_displacement);
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
        "A closed mesh, a CSG tree (.csg), a BP-octree (.bpo), a BSP-octree (.bso), or an octree "
        "(.oct), whose gray cells answer 0",
        "the sides (-1 inside, 0 on, 1 outside)");
}

}  // namespace octavo::cli
