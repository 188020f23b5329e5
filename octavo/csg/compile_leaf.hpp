// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include <octavo/csg/normal_form.hpp>
#include <octavo/csg/program.hpp>

// From a placed primitive to a leaf of a program: planes and vertices are rounded to the lattice, matrices of round
// primitives inverted and rounded to doubles. This is where a solid is approximated, once; lattice_plane.hpp and
// second_order_cone.hpp say by how much.

namespace octavo::csg {

/// What a primitive is on the lattice: a leaf of the program, or a constant.
struct CompiledLeaf {
    std::optional<std::uint32_t> leaf;
    bool constant = false;
};

/// Adds one primitive after the other to a program whose lattice is set. The places are not singular.
class LeafCompiler {
  public:
    explicit LeafCompiler(Program& program);
    ~LeafCompiler();

    /// `bounds` are those of the placed primitive in the world. Errors: limit when a mesh reaches too far.
    Result<CompiledLeaf> compile(const PlacedPrimitive& placed, const Box3& bounds);

  private:
    class Primitives;
    std::unique_ptr<Primitives> primitives_;
};

}  // namespace octavo::csg
