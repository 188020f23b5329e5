// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>

// Numbers for the cells of a mesh, from whoever computed them: one line a cell, in the order of the cells.

namespace octavo::cli {

/// The last number of each line ("17", or "element,17"); a first line without a number is a header. Errors: io,
/// cancelled, bad_input with the line, or when there are not `count`.
Result<std::vector<double>> read_cell_values(const std::string& path, std::size_t count,
                                             const Context& context = {});

}  // namespace octavo::cli
