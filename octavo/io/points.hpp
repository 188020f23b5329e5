// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/base/vec3.hpp>

// Reads lists of points, as queries take them:
//
//   csv, txt, tsv, xyz   a point a line, its numbers separated by commas, semicolons, tabs or spaces; the first line
//                        decides that and how many columns there are. It may hold names, none of which begins like a
//                        number: x, y and z are taken, or three columns of other names as they come. Without names
//                        the first three columns are taken; # begins a comment
//   npy                  an array of shape (n, 3) of 32- or 64-bit floats or integers of either byte order and layout
//   ply                  the vertices
//
// Points are queries, not geometry: nan and inf are kept, and it is for the query to say what they mean.

namespace octavo::io {

struct PointsOptions {
    /// "csv", "xyz", "npy" or "ply"; empty takes it from the extension, then from the content.
    std::string format;
};

struct ReadPoints {
    std::vector<Vec3> points;
    std::string format;
    std::vector<std::string> warnings;  ///< remarks on what was ignored, one sentence each
};

/// Reads the file `path`, or standard input when it is "-". Fails as read_mesh does; no points below
/// the names x, y and z are fine, a file without any line is not.
Result<ReadPoints> read_points(const std::string& path, const PointsOptions& options = {},
                               const Context& context = {});
Result<ReadPoints> read_points(Bytes bytes, const PointsOptions& options = {}, const Context& context = {});

}  // namespace octavo::io
