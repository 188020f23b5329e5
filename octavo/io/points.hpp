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
//   csv, txt, tsv, xyz   a point a line, its numbers separated by commas, semicolons, tabs or spaces (the first line
//                        of numbers decides); an optional line of names before them, of which x, y and z are taken
//                        when all three are there, else the first three columns; # begins a comment
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
};

/// Reads the file `path`, or standard input when it is "-". Fails as read_mesh does; no points at all is
/// fine, an empty file is not.
Result<ReadPoints> read_points(const std::string& path, const PointsOptions& options = {},
                               const Context& context = {});
Result<ReadPoints> read_points(Bytes bytes, const PointsOptions& options = {}, const Context& context = {});

}  // namespace octavo::io
