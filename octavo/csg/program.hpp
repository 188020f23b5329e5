// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/csg/lattice_plane.hpp>
#include <octavo/csg/lattice_polyhedron.hpp>
#include <octavo/csg/lattice_torus.hpp>
#include <octavo/csg/normal_form.hpp>
#include <octavo/csg/quadric.hpp>

// An expression on a lattice, ready to be asked about cells.
//
// The normal form becomes a list of 32-bit words in prefix order; a descent rewrites that list for each cell it
// enters, leaving only what is undecided there (prune.hpp). A leaf word may be followed by a payload: the
// constraints of a convex body, or the triangles of a polyhedron, that still matter. Without one, all do.
//
//     bit 31    30 29          28         27 … 0
//     0         operation      odd/even   words of the sub-tree, this one included
//     1         ¬  payload      29-bit index of the leaf;   with a payload: count, then that many words
//
// Leaves: boxes along the axes (integers), convex bodies as intersections of half spaces and convex quadrics
// (ellipsoids, cylinders, cones, slanted boxes, hulls), tori, and closed meshes.

namespace octavo::csg {

namespace word {

inline constexpr std::uint32_t leaf_bit = 1U << 31;
inline constexpr std::uint32_t complement_bit = 1U << 30;
inline constexpr std::uint32_t payload_bit = 1U << 29;
inline constexpr std::uint32_t leaf_mask = payload_bit - 1;
inline constexpr int operation_shift = 29;
inline constexpr std::uint32_t even_bit = 1U << 28;
inline constexpr std::uint32_t size_mask = even_bit - 1;

enum Operation : std::uint32_t { union_of = 0, intersection = 1, symmetric_difference = 2, skip = 3 };

constexpr bool is_leaf(std::uint32_t w) { return (w & leaf_bit) != 0; }
constexpr Operation operation(std::uint32_t w) { return static_cast<Operation>(w >> operation_shift & 3); }
constexpr std::uint32_t leaf(std::uint32_t w) { return w & leaf_mask; }
/// Words that the sub-tree at `words[0]` takes.
inline std::uint32_t size(const std::uint32_t* words) {
    if (!is_leaf(*words)) return *words & size_mask;
    return *words & payload_bit ? 2 + words[1] : 1;
}

}  // namespace word

/// A half space or a convex quadric of a program.
struct ConstraintId {
    static constexpr std::uint32_t cone_bit = 1U << 31;
    static bool is_cone(std::uint32_t id) { return (id & cone_bit) != 0; }
    static std::uint32_t index(std::uint32_t id) { return id & ~cone_bit; }
};

enum class LeafKind : std::uint8_t { box, convex, torus, polyhedron };

struct Leaf {
    LeafKind kind = LeafKind::box;
    /// Outside this lattice box the leaf is white; a leaf of kind `box` is black inside. Clamped to the universe.
    std::array<std::int32_t, 3> low{}, high{};
    /// Convex: its constraints are constraints[first, first + count). Torus or polyhedron: first is its index.
    std::uint32_t first = 0, count = 0;
};

struct Program {
    exact::Lattice lattice;
    std::vector<std::uint32_t> words;  ///< empty when the expression is `constant`
    bool constant = false;             ///< with no words: everything or nothing
    std::size_t primitives = 0;        ///< of the expression, whether or not they reach the result
    std::vector<Leaf> leaves;
    std::vector<std::uint32_t> constraints;
    std::vector<LatticePlane> planes;
    std::vector<SecondOrderCone> cones;
    std::vector<Quadric> quadrics;  ///< the same, squared
    std::vector<LatticeTorus> tori;
    std::vector<LatticePolyhedron> polyhedra;

    std::span<const std::uint32_t> constraints_of(const Leaf& leaf) const {
        return {constraints.data() + leaf.first, leaf.count};
    }
    std::size_t memory_bytes() const;
};

struct CompileOptions {
    /// The part of the world that the lattice must contain; by default the bounds of the expression. Needed when
    /// those are infinite.
    std::optional<Box3> universe;
    NormalFormOptions normal_form;
    /// Which primitives become leaves: those that can reach the result by their bounding boxes (form_bounds.hpp), or
    /// all. The solid is the same.
    enum class Primitives : std::uint8_t { within_reach, all } primitives = Primitives::within_reach;
};

/// Puts an expression on a lattice. Errors: bad_input when a number is not finite; limit when the expression is
/// unbounded and no universe is given, when it has too many primitives, lies too far from the origin for its size, or
/// a primitive reaches farther than a double can hold, in the world or in lattice units; cancelled. A round body
/// thinner than 2^-200 lattice units is nothing.
Result<Program> compile(const Expr& expression, const CompileOptions& options = {},
                        const Context& context = {});

}  // namespace octavo::csg
