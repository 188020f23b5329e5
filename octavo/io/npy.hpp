// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <octavo/base/bytes.hpp>
#include <octavo/base/result.hpp>
#include <octavo/base/vec3.hpp>
#include <octavo/io/columns.hpp>
#include <octavo/io/output.hpp>

// NPY (NumPy Enhancement Proposal 1, "A Simple File Format for NumPy Arrays", 2007; versions 1 to 3): a header
// that is a Python dictionary, then the array. Pickled objects are never touched.

namespace octavo::io {

/// The rows of an array of shape (n, 3).
Result<std::vector<Vec3>> read_npy_points(Bytes bytes);

/// One column becomes a plain array of shape (n,), several one of records with a field for each.
void write_npy(Output& output, std::span<const Column> columns);

}  // namespace octavo::io
