// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/boolean/evaluate.hpp>
#include <octavo/io/openscad_csg.hpp>
#include <octavo/mesh/mesh.hpp>

#include "session.hpp"

// The solids that `hexmesh` meshes: read, and made anew where their surface overlaps itself.

namespace octavo::cli {

/// One solid a file: its surface, or the solid that a .csg tree describes, faceted as OpenSCAD does it.
Result<std::vector<mesh::Mesh>> read_solids(Session& session, const Context& context,
                                            const std::vector<std::string>& paths,
                                            const io::CsgReadOptions& csg);

/// Makes the surface of a solid that `refusal` says is none anew by an exact union with nothing, which leaves what it
/// winds about at least once, and warns of that. Leaves it as it is and says false when a union is no remedy: what is
/// open, unless `options` close it, inside out or holds nothing. Errors: cancelled.
Result<bool> unite_with_nothing(Session& session, const Context& context, const std::string& path,
                                const Error& refusal, const boolean::Options& options, mesh::Mesh& solid);

}  // namespace octavo::cli
