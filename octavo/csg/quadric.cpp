// SPDX-License-Identifier: Apache-2.0
#include <octavo/csg/quadric.hpp>

namespace octavo::csg {

Quadric::Quadric(const SecondOrderCone& cone)
    : origin(cone.origin), magnitude(cone.magnitude), constant(cone.constant), axis(cone.row[3]) {
    for (std::size_t a = 0; a < 4; ++a)
        for (std::size_t b = 0; b < 4; ++b)
            form[a][b] = cone.row[0][a] * cone.row[0][b] + cone.row[1][a] * cone.row[1][b] +
                         cone.row[2][a] * cone.row[2][b] - cone.row[3][a] * cone.row[3][b];
    for (std::size_t a = 0; a < 3; ++a) axis_reach += std::fabs(axis[a]);
}

}  // namespace octavo::csg
