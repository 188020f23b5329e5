// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <octavo/base/counted.hpp>
#include <octavo/query/closest.hpp>
#include <octavo/query/envelope_distance.hpp>

#include "point_query.hpp"

// `octavo distance MODEL POINTS`: for each point its signed distance from the surface, negative inside, and the nearest
// point and triangle of the surface.

namespace octavo::cli {
namespace {

struct DistanceOptions : PointQueryOptions {
    bool is_unsigned = false;
    int level = exact;
    static constexpr int exact = -1;  ///< no level: the exact distance
};

/// The answers as columns of numbers.
struct Columns {
    std::vector<double> distance, x, y, z;
    std::vector<std::uint32_t> triangle;
    double largest_displacement = 0;  ///< of the model's vertices, by rounding to the lattice

    void append(const std::vector<query::Closest>& answers) {
        for (const query::Closest& answer : answers) {
            distance.push_back(answer.distance);
            x.push_back(answer.point.x);
            y.push_back(answer.point.y);
            z.push_back(answer.point.z);
            triangle.push_back(answer.triangle);
        }
    }
};

Result<Columns> answers_of(Session& session, const Context& context, const DistanceOptions& options) {
    const Result<std::vector<Vec3>> points =
        read_points(session, context, options, "so is the distance there");
    if (!points) return points.error();
    const Result<OnLattice> solid = read_on_lattice(session, context, options.model, options.model_format);
    session.inputs.push_back(options.points);
    if (!solid) return solid.error();
    if (options.policy() == classic::OpenPolicy::winding) warn_of_closing(session, solid->mesh);
    query::ClosestOptions asking;
    if (options.is_unsigned) asking.sign = query::ClosestOptions::Sign::none;
    asking.inside.open = options.policy();
    Result<query::ClosestQuery> query =
        session.timed("build", [&] { return query::ClosestQuery::build(solid->mesh, asking, context); });
    if (!query) return in_file(std::move(query).error(), options.model);
    return session.timed("query", [&]() -> Result<Columns> {
        // Answers have four times the bytes of the columns; so many at a time are enough to sort well.
        constexpr std::size_t block = std::size_t{1} << 20;
        Columns columns;
        columns.largest_displacement = solid->largest_displacement;
        const std::span<const Vec3> all = *points;
        for (std::size_t begin = 0; begin < all.size(); begin += block) {
            columns.append((*query)(all.subspan(begin, std::min(block, all.size() - begin)), context));
            if (context.cancelled()) return Context::cancelled_error();
            context.report("query", static_cast<double>(begin) / static_cast<double>(all.size()));
        }
        return columns;
    });
}

/// Lower bounds from one level of a BP-octree, of which the beginning is enough.
Result<Columns> bounds_of(Session& session, const Context& context, const DistanceOptions& options) {
    const Result<std::vector<Vec3>> points =
        read_points(session, context, options, "so is the distance there");
    if (!points) return points.error();
    bp_octree::ReadBpoOptions reading;
    reading.levels = options.level;
    reading.partial = bp_octree::ReadBpoOptions::Partial::accept;
    Result<bp_octree::ReadBpo> file = read_bp_octree(session, context, options.model, reading);
    session.inputs.push_back(options.points);
    if (!file) return std::move(file).error();
    Columns columns;
    columns.distance = session.timed(
        "query", [&] { return query::EnvelopeDistance(file->tree, options.level)(*points, context); });
    if (context.cancelled()) return Context::cancelled_error();
    return columns;
}

/// min, max and mean of what is finite; null when nothing is.
Json summary_of(const std::vector<double>& distances) {
    double least = INFINITY, most = -INFINITY, sum = 0;
    std::size_t count = 0;
    for (const double distance : distances) {
        if (!std::isfinite(distance)) continue;
        least = std::min(least, distance);
        most = std::max(most, distance);
        sum += distance;
        ++count;
    }
    if (count == 0)
        return {{"min", nullptr}, {"max", nullptr}, {"mean", nullptr}, {"points", distances.size()}};
    return {{"min", least},
            {"max", most},
            {"mean", sum / static_cast<double>(count)},
            {"points", distances.size()}};
}

Result<ExitCode> distance(Session& session, const DistanceOptions& options) {
    const Context context = session.context();
    const Result<AnswerOutput> output = settle_answers(session, options);
    if (!output) return output.error();
    const bool is_bound = options.level != DistanceOptions::exact;
    if (is_bound && kind_of(options.model, options.model_format) != ModelKind::bp_octree)
        return session.usage_error("--level is for BP-octrees (.bpo), and " + options.model + " is none");
    const Result<Columns> answers =
        is_bound ? bounds_of(session, context, options) : answers_of(session, context, options);
    if (!answers) return answers.error();
    const Columns& columns = *answers;
    session.result = summary_of(columns.distance);
    if (!is_bound) session.result["largest_displacement"] = columns.largest_displacement;
    const std::string points = counted(columns.distance.size(), "point", "points");
    session.text = session.result["mean"].is_null()
                       ? points + ", none of them at a finite distance\n"
                       : fmt::format("{}: distance {} to {}, mean {}\n", points,
                                     number_text(session.result["min"].get<double>()),
                                     number_text(session.result["max"].get<double>()),
                                     number_text(session.result["mean"].get<double>()));
    session.text += rounding_text(columns.largest_displacement);
    std::vector<io::Column> told{{"distance", std::span<const double>(columns.distance)}};
    if (!is_bound) {
        told.push_back({"x", std::span<const double>(columns.x)});
        told.push_back({"y", std::span<const double>(columns.y)});
        told.push_back({"z", std::span<const double>(columns.z)});
        told.push_back({"triangle", std::span<const std::uint32_t>(columns.triangle)});
    }
    Status status = deliver(session, context, *output, told);
    if (!status) return std::move(status).error();
    return ExitCode::ok;
}

}  // namespace

void add_distance(Program& program) {
    const auto options = std::make_shared<DistanceOptions>();
    Verb* verb = program.verb("distance", "Analyse",
                              "Tell for each point its signed distance, and what of the surface is nearest",
                              [options](Session& session) { return distance(session, *options); });
    Option* open = add_point_query_options(
        verb, *options,
        "A closed mesh, a CSG tree (.csg), the black cells of an octree (.oct), or a BP-octree (.bpo)",
        "distance, x, y, z and triangle");
    verb->add_flag("--unsigned", options->is_unsigned, "Distances without a sign; the surface may be open")
        ->excludes(open);
    verb->add_option("--level", options->level,
                     "For .bpo: lower bounds by the envelopes of this level, 0 within; needs only the file's "
                     "beginning")
        ->check(whole_number(0, bp_octree::max_depth))
        ->type_name("L")
        ->excludes(open);
}

}  // namespace octavo::cli
