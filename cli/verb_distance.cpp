// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "model.hpp"
#include "program.hpp"
#include <octavo/io/columns.hpp>
#include <octavo/io/points.hpp>
#include <octavo/query/closest.hpp>

// `octavo distance MODEL POINTS`: for each point its signed distance from the surface, negative inside, and the nearest
// point and triangle of the surface.

namespace octavo::cli {
namespace {

struct DistanceOptions {
    std::string model, points, output, model_format, points_format, output_format, open = "reject";
    bool is_unsigned = false;
};

/// The answers as columns of numbers.
struct Columns {
    std::vector<double> distance, x, y, z;
    std::vector<std::uint32_t> triangle;

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
    Result<mesh::LatticeMesh> solid = read_on_lattice(session, context, options.model, options.model_format);
    if (!solid) return std::move(solid).error();
    session.inputs.push_back(options.points);
    Result<io::ReadPoints> points = session.timed(
        "read", [&] { return io::read_points(options.points, {options.points_format}, context); });
    if (!points) return std::move(points).error();
    const auto nowhere = std::count_if(points->points.begin(), points->points.end(), [](Vec3 p) {
        return std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z);
    });
    if (nowhere)
        session.warn(
            fmt::format("{} points have a coordinate that is not a number; so are their distances", nowhere));
    query::ClosestOptions asking;
    if (options.is_unsigned) asking.sign = query::ClosestOptions::Sign::none;
    if (options.open == "winding") asking.inside.open = classic::OpenPolicy::winding;
    Result<query::ClosestQuery> query =
        session.timed("build", [&] { return query::ClosestQuery::build(*solid, asking, context); });
    if (!query) return in_file(std::move(query).error(), options.model);
    return session.timed("query", [&]() -> Result<Columns> {
        // Answers have four times the bytes of the columns; so many at a time are enough to sort well.
        constexpr std::size_t block = std::size_t{1} << 20;
        Columns columns;
        const std::span<const Vec3> all = points->points;
        for (std::size_t begin = 0; begin < all.size(); begin += block) {
            columns.append((*query)(all.subspan(begin, std::min(block, all.size() - begin)), context));
            if (context.cancelled()) return Context::cancelled_error();
            context.report("query", static_cast<double>(begin) / static_cast<double>(all.size()));
        }
        return columns;
    });
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
    if (same_file(options.model, options.output) || same_file(options.points, options.output))
        return would_overwrite(options.output);
    const Result<Columns> answers = answers_of(session, context, options);
    if (!answers) return answers.error();
    const Columns& columns = *answers;
    session.result = summary_of(columns.distance);
    session.text =
        session.result["mean"].is_null()
            ? fmt::format("{} points, none of them at a finite distance\n", grouped(columns.distance.size()))
            : fmt::format("{} points: distance {:.6g} to {:.6g}, mean {:.6g}\n",
                          grouped(columns.distance.size()), session.result["min"].get<double>(),
                          session.result["max"].get<double>(), session.result["mean"].get<double>());
    // Without --json or -o the answers themselves are the data.
    const std::string output = options.output.empty() && !session.options.json ? "-" : options.output;
    if (output.empty()) return ExitCode::ok;
    session.stdout_taken = output == "-";
    const std::vector<io::Column> written_columns{
        {"distance", std::span<const double>(columns.distance)},
        {"x", std::span<const double>(columns.x)},
        {"y", std::span<const double>(columns.y)},
        {"z", std::span<const double>(columns.z)},
        {"triangle", std::span<const std::uint32_t>(columns.triangle)}};
    io::WriteOptions writing;
    writing.format = options.output_format;
    Result<io::WriteReport> written =
        session.timed("write", [&] { return io::write_columns(output, written_columns, writing, context); });
    if (!written) return std::move(written).error();
    return ExitCode::ok;
}

}  // namespace

void add_distance(Program& program) {
    const auto options = std::make_shared<DistanceOptions>();
    CLI::App* verb = program.verb(
        "distance", "Analyse", "Tell for each point its signed distance, and what of the surface is nearest",
        [options](Session& session) { return distance(session, *options); });
    verb->add_option("MODEL", options->model, "A closed mesh, or a BP-octree (.bpo)")
        ->required()
        ->type_name("FILE");
    verb->add_option("POINTS", options->points, "The points: csv, xyz, npy or ply; - is stdin")
        ->required()
        ->type_name("FILE");
    verb->add_option("-o,--output", options->output,
                     "Where distance, x, y, z and triangle go: csv, npy or ply; stdout by default")
        ->type_name("FILE");
    CLI::Option* open =
        verb->add_option("--open", options->open, "An open surface: reject it, or close it and go by winding")
            ->check(CLI::IsMember({"reject", "winding"}))
            ->type_name("POLICY");
    verb->add_flag("--unsigned", options->is_unsigned, "Distances without a sign; the surface may be open")
        ->excludes(open);
    verb->add_option("--format", options->model_format, "Format of MODEL, instead of by its extension")
        ->type_name("FORMAT");
    verb->add_option("--points-format", options->points_format,
                     "Format of POINTS, instead of by its extension")
        ->type_name("FORMAT");
    verb->add_option("--to", options->output_format, "Format of the output, instead of by its extension")
        ->type_name("FORMAT");
}

}  // namespace octavo::cli
