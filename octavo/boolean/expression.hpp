// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <octavo/boolean/evaluate.hpp>
#include <octavo/csg/expression.hpp>
#include <octavo/csg/normal_form.hpp>

// From CSG expressions to programs over meshes: affine maps go to the leaves, complements too (positive normal form),
// and each leaf becomes an operand.

namespace octavo::boolean {

/// Operand k of the program is leaf k of the form, which must not be constant.
Program program_of(const csg::NormalForm& form);

/// Evaluates an expression whose leaves are meshes (csg::Polyhedron) and boxes, each under one affine map composed
/// in double. Operands are numbered as the leaves of the normal form; `sources` name them.
/// Errors: those of `evaluate` and `csg::normal_form`; unsupported when a leaf has no facets (a curved primitive must
/// be faceted first, a half space bounded by a box); bad_input when the expression is all of space.
Result<Evaluated> evaluate(const csg::Expr& expression, const Options& options = {},
                           const Context& context = {});

}  // namespace octavo::boolean
