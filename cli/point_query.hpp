// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <octavo/classic/closed_surface.hpp>
#include <octavo/io/columns.hpp>

#include "model.hpp"
#include "program.hpp"

// What `contains` and `distance` share: a model, points, and columns of answers, one row a point.

namespace octavo::cli {

struct PointQueryOptions {
    std::string model, points, output, model_format, points_format, output_format, open = "reject";

    classic::OpenPolicy policy() const {
        return open == "winding" ? classic::OpenPolicy::winding : classic::OpenPolicy::reject;
    }
};

/// Adds MODEL, POINTS and the options of both and of the output, whose columns are `columns`; returns `--open`.
Option* add_point_query_options(Verb* verb, PointQueryOptions& options, const std::string& models,
                                const std::string& columns);

/// Where answers go and how, before any work is done.
struct AnswerOutput {
    std::string path, format;  ///< `path` is empty when the answers become part of the JSON object
};
Result<AnswerOutput> settle_answers(Session& session, const PointQueryOptions& options);

/// Reads the points. Warns of those that are not numbers, which `remark` says more about. The model comes before them
/// on the command line and is read after them, so who has read it adds them to the session's inputs.
Result<std::vector<Vec3>> read_points(Session& session, const Context& context,
                                      const PointQueryOptions& options, const char* remark);

/// Writes the columns, or adds them to the result as arrays of their names.
Status deliver(Session& session, const Context& context, const AnswerOutput& output,
               const std::vector<io::Column>& columns);

}  // namespace octavo::cli
