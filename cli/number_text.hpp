// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/grouped.hpp>
#include <octavo/base/vec3.hpp>

// The one way in which the program writes measured numbers for people; `--json` has all digits.
//
// Seven significant digits, as many as a float has, without zeros at the end; digits before the point are all kept and
// grouped like counts. Components of a vector are rounded at the digits of the largest, so that what is noise beside
// it reads 0.

namespace octavo::cli {

/// `value` with the digits that a number as large as `scale` gets.
std::string number_text(double value, double scale);
inline std::string number_text(double value) { return number_text(value, value); }

/// "1, 0.5, 0", at the digits of the largest component.
std::string vector_text(Vec3 v);
/// The same at the digits of `scale`.
std::string vector_text(Vec3 v, double scale);

}  // namespace octavo::cli
