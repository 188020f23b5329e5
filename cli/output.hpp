// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "session.hpp"
#include "verb.hpp"

// Where a verb's result goes, settled before any work is done: nobody waits an hour to learn that `.xyz` is no format.

namespace octavo::cli {

/// What a verb can write.
struct OutputFormats {
    const char* things;              ///< "meshes", for messages
    std::vector<std::string> names;  ///< also the extensions
    const char* for_stdout;          ///< the format that `-` has when none is named; empty: one must be
};

const OutputFormats& mesh_outputs();
const OutputFormats& octree_outputs();
/// Columns of answers for points.
const OutputFormats& answer_outputs();
const OutputFormats& picture_outputs();

/// "stl, obj or ply", for help and messages.
std::string one_of(const std::vector<std::string>& names);

/// Adds --to, the format of the output instead of the one that its extension names.
void add_to_option(Verb* verb, std::string& format, const OutputFormats& formats);

/// The format in which `output` is to be written: `format` when it is named, else by the extension; "" when `output`
/// is empty. Errors: usage when it is none of `formats`, when two inputs are stdin, when `--json` needs stdout for
/// itself, or when the output is one of the inputs.
Result<std::string> settle_output(Session& session, const std::vector<std::string>& inputs,
                                  const std::string& output, const std::string& format,
                                  const OutputFormats& formats);

/// The part of it that concerns inputs, for verbs without an output.
Status check_inputs(Session& session, const std::vector<std::string>& inputs);

/// For a file that is written beside the output, such as a picture. Errors: usage when it is one of the inputs or the
/// output.
Status settle_further_output(Session& session, const std::vector<std::string>& inputs,
                             const std::string& output);

/// Files that a model refers to are inputs that the command line does not name. Error: usage when one of them would be
/// overwritten.
Status check_files_of(Session& session, const std::string& model, const std::vector<std::string>& files);

}  // namespace octavo::cli
