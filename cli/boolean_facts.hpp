// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <octavo/boolean/evaluate.hpp>

#include "output.hpp"
#include "session.hpp"
#include "verb.hpp"

// What the verbs of exact set operations have in common: options, writing the result, and what they tell about it.

namespace octavo::cli {

struct BooleanOutput {
    std::string output, format, simplify = "coplanar", open = "reject", regularized = "yes", tolerance;

    /// `standard` is the tolerance where none is given.
    boolean::Options evaluation(boolean::Tolerance standard = {2, boolean::Tolerance::Of::lattice}) const;
};

void add_boolean_options(Verb* verb, BooleanOutput& options);

/// The operands of a set operation as users know them.
struct OperandNames {
    std::vector<std::string> files;
    std::vector<std::string> names = {};  ///< in an expression; else operands are called by their files
};

/// The error with the file of its operand, and with the option that takes open operands where they were refused.
Error error_of_operand(Error error, const BooleanOutput& options, const OperandNames& operands);

/// Writes the result in the settled format and puts its facts into the session; warnings call operands by their names,
/// or by number where there are none.
Result<ExitCode> write_boolean(Session& session, const Context& context, const boolean::Evaluated& evaluated,
                               const std::string& output, const std::string& format,
                               const OperandNames& operands = {});

}  // namespace octavo::cli
