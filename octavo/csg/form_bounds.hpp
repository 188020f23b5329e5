// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <octavo/csg/normal_form.hpp>

// Bounding boxes of a normal form, and what they show to have no effect.
//
// Problem: in large expressions most operands do nothing: a body is taken from another that it does not touch, or meets
// one that is elsewhere. Idea: boxes go up, each one around a solid or around its complement, so that A − B lies in the
// box of A and A ∪ ¬B is everything outside of that of B. Then what can reach the result comes down, the box of each
// operation cut by that of the one around it. A leaf whose box keeps off that region is constant there, and becomes it.
// Why that holds: a leaf that becomes what it is outside of its box breaks no box, so outside of its box an operation
// stays what it was, whatever goes below it; inside, all that matters there is kept.
// Cost: two passes. Source: S. Cameron, Efficient bounds in constructive solid geometry, 1991 (S-bounds), one round of
// it.

namespace octavo::csg {

struct FormBounds {
    /// Outside of the box there is nothing of the solid, or nothing is missing.
    struct Token {
        Box3 box;
        bool full_outside = false;
    };
    std::vector<Box3> leaves;   ///< of the primitives as they are, by leaf
    std::vector<Token> tokens;  ///< by token

    /// Of the whole form: infinite when everything, a half space or a complement shows through.
    Box3 box() const;
};
FormBounds form_bounds(const NormalForm& form);
inline Box3 bounds(const NormalForm& form) { return form_bounds(form).box(); }

/// Replaces leaves and operations that cannot reach the result by constants, which may now stand anywhere in the form.
/// Leaves are kept in `leaves`. Boxes are taken to be wider by `margin` on all sides.
void drop_out_of_reach(NormalForm& form, const FormBounds& bounds, double margin);

}  // namespace octavo::csg
