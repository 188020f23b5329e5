// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/base/bytes.hpp>
#include <octavo/base/context.hpp>
#include <octavo/io/file_mesh.hpp>
#include <octavo/io/output.hpp>
#include <octavo/io/read.hpp>
#include <octavo/io/write.hpp>

// .poly and .smesh, the boundaries that TetGen reads (H. Si, TetGen user's manual, "File formats"): points, facets,
// hole points and regions. A facet of .poly is any number of contours and hole points in one plane, one of .smesh a
// single contour. Points are numbered from 0 or 1, as the first one says, and may stand in a .node file beside the
// boundary, which then announces none. # begins a comment; contours go on over line ends.
//
// Facets become faces with holes (facet_regions.hpp), and look away from the solid (face_directions.hpp). A facet
// whose corners are not in one plane is refused, and named. Contours of one or two corners, which only force edges
// and points on a mesh, are left out and counted; attributes, markers and regions are left out.

namespace octavo::io {

Result<FileMesh> read_poly(Bytes bytes, const ReadOptions& options, const Context& context);
Result<FileMesh> read_smesh(Bytes bytes, const ReadOptions& options, const Context& context);

/// How far a corner may be from its facet's plane, as a part of the model's largest coordinate. Files are written with
/// six digits and more: rounding to them moves a corner by 5e-6 of its largest coordinate at most, and the corners that
/// the plane goes through too.
inline constexpr double most_deviation = 2e-5;

/// Writes neighbours in one plane as one facet, with its holes, and a hole point in each cavity.
Result<WriteReport> write_poly(Output& output, const mesh::Mesh& mesh, const WriteOptions& options);
/// The same; faces with holes stay triangles, as the format has no others.
Result<WriteReport> write_smesh(Output& output, const mesh::Mesh& mesh, const WriteOptions& options);

}  // namespace octavo::io
