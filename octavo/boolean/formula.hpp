// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/boolean/program.hpp>

// Set expressions as people write them: "(body | lid) - (bore & core)".
//
//   sum     = product { ("|" | "+" | "-" | "^") product }      union, union, difference, symmetric difference
//   product = factor { ("&" | "*") factor }                     intersection
//   factor  = name | "(" sum ")"
//
// Operators of one rank are read from left to right. A name is a letter or underscore and then letters, digits and
// underscores; it may stand in several places.

namespace octavo::boolean {

struct Formula {
    Program program;
    std::vector<std::string> names;  ///< of the operands, in the order of first use
};

/// Errors: bad_input, with the column.
Result<Formula> parse_formula(std::string_view text);

}  // namespace octavo::boolean
