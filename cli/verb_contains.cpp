// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "model.hpp"
#include "program.hpp"
#include <octavo/io/columns.hpp>
#include <octavo/io/points.hpp>
#include <octavo/query/inside.hpp>
#include <octavo/query/stored_inside.hpp>

// `octavo contains MODEL POINTS`: on which side of the solid each point lies; −1 inside, 0 on, +1 outside.

namespace octavo::cli {
namespace {

struct ContainsOptions {
    std::string model, points, output, model_format, points_format, output_format, open = "reject";
};

Result<std::vector<query::Side>> sides_from_file(Session& session, const std::string& path,
                                                 std::span<const Vec3> points) {
    session.inputs.push_back(path);
    Result<query::StoredInside> stored =
        session.timed("open", [&] { return query::StoredInside::open(path); });
    if (!stored) return in_file(std::move(stored).error(), path);
    return session.timed("query", [&]() -> Result<std::vector<query::Side>> {
        std::vector<query::Side> sides;
        for (const Vec3& point : points) {
            const Result<query::Side> side = (*stored)(point);
            if (!side) return in_file(side.error(), path);
            sides.push_back(*side);
        }
        return sides;
    });
}

Result<std::vector<query::Side>> sides_of(Session& session, const Context& context,
                                          const ContainsOptions& options) {
    session.inputs.push_back(options.points);
    Result<io::ReadPoints> points = session.timed(
        "read", [&] { return io::read_points(options.points, {options.points_format}, context); });
    if (!points) return std::move(points).error();
    const auto nowhere = std::count_if(points->points.begin(), points->points.end(), [](Vec3 p) {
        return std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z);
    });
    if (nowhere)
        session.warn(fmt::format("{} points have a coordinate that is not a number; they are told as outside",
                                 nowhere));
    // So few answers come sooner from the file where it lies than decoding it takes.
    constexpr std::size_t few_points = 100;
    if (kind_of(options.model, options.model_format) == ModelKind::bp_octree && options.model != "-" &&
        points->points.size() <= few_points)
        return sides_from_file(session, options.model, points->points);
    Result<mesh::LatticeMesh> solid = read_on_lattice(session, context, options.model, options.model_format);
    if (!solid) return std::move(solid).error();
    query::InsideOptions asking;
    asking.open = options.open == "winding" ? classic::OpenPolicy::winding : classic::OpenPolicy::reject;
    Result<query::InsideQuery> inside =
        session.timed("build", [&] { return query::InsideQuery::build(*solid, asking, context); });
    if (!inside) return in_file(std::move(inside).error(), options.model);
    return session.timed("query", [&] { return (*inside)(points->points, context); });
}

Result<ExitCode> contains(Session& session, const ContainsOptions& options) {
    const Context context = session.context();
    if (same_file(options.model, options.output) || same_file(options.points, options.output))
        return would_overwrite(options.output);
    Result<std::vector<query::Side>> sides = sides_of(session, context, options);
    if (!sides) return std::move(sides).error();
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
    // Without --json or -o the answers themselves are the data.
    const std::string output = options.output.empty() && !session.options.json ? "-" : options.output;
    if (output.empty()) return ExitCode::ok;
    session.stdout_taken = output == "-";
    const io::Column side{"side", std::span<const std::int8_t>(column)};
    io::WriteOptions writing;
    writing.format = options.output_format;
    Result<io::WriteReport> written = session.timed("write", [&] {
        return io::write_columns(output, {&side, 1}, writing, context);
    });
    if (!written) return std::move(written).error();
    return ExitCode::ok;
}

}  // namespace

void add_contains(Program& program) {
    const auto options = std::make_shared<ContainsOptions>();
    CLI::App* verb =
        program.verb("contains", "Analyse", "Tell for each point whether it is inside, on or outside a solid",
                     [options](Session& session) { return contains(session, *options); });
    verb->add_option("MODEL", options->model, "A closed mesh, or a BP-octree (.bpo)")
        ->required()
        ->type_name("FILE");
    verb->add_option("POINTS", options->points, "The points: csv, xyz, npy or ply; - is stdin")
        ->required()
        ->type_name("FILE");
    verb->add_option("-o,--output", options->output,
                     "Where the column `side` goes: csv, npy or ply; stdout by default")
        ->type_name("FILE");
    verb->add_option("--open", options->open, "An open surface: reject it, or close it and go by winding")
        ->check(CLI::IsMember({"reject", "winding"}))
        ->type_name("POLICY");
    verb->add_option("--format", options->model_format, "Format of MODEL, instead of by its extension")
        ->type_name("FORMAT");
    verb->add_option("--points-format", options->points_format,
                     "Format of POINTS, instead of by its extension")
        ->type_name("FORMAT");
    verb->add_option("--to", options->output_format, "Format of the output, instead of by its extension")
        ->type_name("FORMAT");
}

}  // namespace octavo::cli
