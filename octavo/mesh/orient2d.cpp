// SPDX-License-Identifier: Apache-2.0
#include <octavo/base/expansion.hpp>
#include <octavo/mesh/orient2d.hpp>

namespace octavo::mesh {
int orient2d_exact(Point2 a, Point2 b, Point2 c) {
    // (a − c) × (b − c) multiplied out; the two products c.x c.y cancel.
    Expansion<12> determinant;
    determinant.add_product(a.x, b.y);
    determinant.add_product(-a.x, c.y);
    determinant.add_product(-c.x, b.y);
    determinant.add_product(-a.y, b.x);
    determinant.add_product(a.y, c.x);
    determinant.add_product(c.y, b.x);
    return determinant.sign();
}

}  // namespace octavo::mesh
