// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/boolean/evaluate.hpp>

#include "output.hpp"
#include "session.hpp"
#include "verb.hpp"

// What the verbs of exact set operations have in common: options, writing the result, and what they tell about it.

namespace octavo::cli {

struct BooleanOutput {
    std::string output, format, simplify = "coplanar", open = "reject", regularized = "yes", tolerance;

    /// For a result in the settled format; `standard` is the tolerance where none is given.
    boolean::Options evaluation(const std::string& settled,
                                boolean::Tolerance standard = {2, boolean::Tolerance::Of::lattice}) const;
};

void add_boolean_options(Verb* verb, BooleanOutput& options);

/// The error, with the option that takes open operands where they were refused.
Error with_advice(Error error, const BooleanOutput& options);

/// Writes the result in the settled format and puts its facts into the session.
Result<ExitCode> write_boolean(Session& session, const Context& context, const boolean::Evaluated& evaluated,
                               const std::string& output, const std::string& format);

}  // namespace octavo::cli
