// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string_view>

// The dictionaries without which no program of OpenFOAM starts: with them `checkMesh` and `paraFoam` run on a mesh at
// once. They ask for nothing but one step of nothing; whoever computes something brings their own.

namespace octavo::io {

struct OpenfoamDictionary {
    std::string_view name;  ///< also of the file, in the folder `system`
    std::string_view content;
};

std::span<const OpenfoamDictionary> openfoam_dictionaries();

}  // namespace octavo::io
