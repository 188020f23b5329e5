// SPDX-License-Identifier: Apache-2.0
#include "point_query.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include <octavo/base/counted.hpp>
#include <octavo/io/points.hpp>

namespace octavo::cli {

Option* add_point_query_options(Verb* verb, PointQueryOptions& options, const std::string& models,
                                const std::string& columns) {
    verb->add_option("MODEL", options.model, models)->required()->type_name("FILE");
    verb->add_option("POINTS", options.points, "The points: csv, xyz, npy or ply; - is stdin")
        ->required()
        ->type_name("FILE");
    verb->add_option("-o,--output", options.output,
                     "Where " + columns +
                         " go: csv, npy or ply; by default csv on stdout, or with --json into its object")
        ->type_name("FILE");
    Option* open = take_one_of(
        verb->add_option("--open", options.open, "An open surface: reject it, or close it and go by winding"),
        {"reject", "winding"});
    add_from_option(verb, options.model_format, "MODEL");
    take_one_of(verb->add_option("--points-format", options.points_format,
                                 "Format of POINTS, instead of by its extension"),
                {"csv", "xyz", "npy", "ply"});
    take_one_of(
        verb->add_option("--to", options.output_format, "Format of the output, instead of by its extension"),
        {"csv", "npy", "ply"});
    return open;
}

Result<AnswerOutput> settle_answers(Session& session, const PointQueryOptions& options) {
    // Without --json or -o the answers themselves are the data.
    const std::string path = options.output.empty() && !session.options.json ? "-" : options.output;
    Result<std::string> format = settle_output(session, {options.model, options.points}, path,
                                               options.output_format, answer_outputs());
    if (!format) return std::move(format).error();
    return AnswerOutput{path, *format};
}

Result<std::vector<Vec3>> read_points(Session& session, const Context& context,
                                      const PointQueryOptions& options, const char* remark) {
    Result<io::ReadPoints> read = session.timed(
        "read", [&] { return io::read_points(options.points, {options.points_format}, context); });
    if (!read) {
        session.inputs = {options.model, options.points};
        return std::move(read).error();
    }
    session.warn(read->warnings);
    const auto nowhere = std::count_if(read->points.begin(), read->points.end(), [](Vec3 p) {
        return std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z);
    });
    if (nowhere)
        session.warn(fmt::format("{} a coordinate that is not a number; {}",
                                 counted(static_cast<std::uint64_t>(nowhere), "point has", "points have"),
                                 remark));
    return std::move(read->points);
}

Status deliver(Session& session, const Context& context, const AnswerOutput& output,
               const std::vector<io::Column>& columns) {
    if (output.path.empty()) {
        for (const io::Column& column : columns)
            session.result[column.name] =
                std::visit([](const auto& values) { return Json(std::vector(values.begin(), values.end())); },
                           column.values);
        return Done{};
    }
    session.stdout_taken = output.path == "-";
    Result<io::WriteReport> written = session.timed(
        "write", [&] { return io::write_columns(output.path, columns, {.format = output.format}, context); });
    if (!written) return std::move(written).error();
    return Done{};
}

}  // namespace octavo::cli
