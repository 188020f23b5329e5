// SPDX-License-Identifier: Apache-2.0
#include <array>

#include <octavo/io/openfoam_case.hpp>

namespace octavo::io {
namespace {

constexpr std::array<OpenfoamDictionary, 3> dictionaries{{{"controlDict",
                                                           R"(application     checkMesh;
startFrom       startTime;
startTime       0;
stopAt          endTime;
endTime         1;
deltaT          1;
writeControl    timeStep;
writeInterval   1;
writeFormat     ascii;
)"},
                                                          {"fvSchemes",
                                                           R"(ddtSchemes
{
    default         steadyState;
}
gradSchemes
{
    default         Gauss linear;
}
divSchemes
{
    default         none;
}
laplacianSchemes
{
    default         Gauss linear corrected;
}
interpolationSchemes
{
    default         linear;
}
snGradSchemes
{
    default         corrected;
}
)"},
                                                          {"fvSolution",
                                                           R"(solvers
{
}
)"}}};

}  // namespace

std::span<const OpenfoamDictionary> openfoam_dictionaries() { return dictionaries; }

}  // namespace octavo::io
