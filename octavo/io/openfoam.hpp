// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/io/write.hpp>
#include <octavo/mesh/polyhedral_mesh.hpp>

// OpenFOAM's polyMesh: a folder with points, faces, owner, neighbour, boundary, cellZones and cellLevel, in ASCII; and
// where the case has none, the dictionaries of `system` without which no program of OpenFOAM starts.
//
// The folder constant/polyMesh of the case is written under another name and renamed when it is complete; a mesh that
// was there is replaced, what else is there (sets, faceZones, blockMeshDict) stays, with a warning. An error or
// cancellation leaves nothing that was not there. Names of patches and zones become words: what OpenFOAM does not allow
// turns into "_".

namespace octavo::io {

/// Writes the mesh of the case folder `path`, which is made when it is missing.
/// Errors: io; unsupported for "-"; cancelled.
Result<WriteReport> write_openfoam(const std::string& path, const mesh::PolyhedralMesh& mesh,
                                   const Context& context = {});

}  // namespace octavo::io
