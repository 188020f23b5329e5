// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/csg/expression.hpp>

// Reads OpenSCAD's .csg: the tree of a program after all variables, loops and modules have been evaluated.
//
// Three steps, none of them recursive, so that no nesting overruns the stack: the text becomes tokens, the tokens a
// flat syntax tree (openscad_csg_syntax.hpp), and of that the leaves are evaluated in order, then operations, children
// before parents (openscad_csg_leaf.cpp, openscad_csg_inner.cpp). Flat geometry stays polygons; solids become a
// csg::Expr with the primitives kept as primitives.
//
// Meaning follows OpenSCAD 2021.01: children of the file, of groups and of transformations are united; an empty
// first child makes a difference empty and an empty child an intersection; `%` parts are no geometry, `*` parts are
// not there, `!` shows one part alone. Numbers in a dump have six digits; nothing is guessed back.

namespace octavo::io {

struct CsgReadOptions {
    /// Round things become the polyhedra that OpenSCAD makes by $fn, $fa and $fs. Otherwise spheres, cylinders and
    /// bodies of revolution are truly round; operands of hull, minkowski, projection and resize never are.
    bool faceted = false;
    /// text, surface, roof and imports that cannot be read are left out with a warning instead of an error.
    bool skip_unsupported = false;
    /// Limits against hostile files: nodes, and numbers in all vectors together. A node takes some 150 bytes in
    /// all, a number 16.
    std::uint64_t most_nodes = 20'000'000;
    std::uint64_t most_values = 50'000'000;
    /// Vertices of one faceted primitive or extrusion.
    std::uint64_t most_vertices = 10'000'000;
    /// Corners round one faceted circle, cylinder, ball, offset or body of revolution: what they take grows with the
    /// square. Truly round ones may have any $fn.
    int most_segments = 1 << 16;
};

struct CsgFile {
    csg::Expr expression;
    std::vector<std::string> warnings;  ///< one sentence each, with line and column
    std::vector<std::string> files;     ///< that were imported, and what these refer to
    std::uint64_t nodes = 0;
    std::uint64_t primitives = 0;  ///< solid and flat ones
};

/// Reads the file `path`, or standard input when it is "-"; imports are looked for beside it. Errors, with line and
/// column: bad_input (grammar, unknown nodes, wrong or missing parameters, more nodes or numbers than the options
/// allow), unsupported, not_a_solid (the tree is flat, an open polyhedron), limit (a primitive of too many
/// vertices or segments),
/// io, cancelled.
Result<CsgFile> read_csg(const std::string& path, const CsgReadOptions& options = {},
                         const Context& context = {});

/// The same from memory; imports are relative to `folder`.
Result<CsgFile> read_csg_text(std::string_view text, const std::string& folder = ".",
                              const CsgReadOptions& options = {}, const Context& context = {});

}  // namespace octavo::io
