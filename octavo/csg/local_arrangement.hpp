// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <octavo/csg/prune.hpp>

// Looks again at a cell that three-valued logic leaves gray.
//
// Problem: gray ∪ gray is gray even when two boxes share the face between them and the cell is full; an inner
// wall of gray cells would remain wherever primitives abut, coincide or overlap by less than a cell. Idea: inside
// the cell every leaf is a conjunction of a few half spaces and quadrics. Equal surfaces, whichever primitives
// they came from and whichever way they face, become one Boolean variable. The signs of the variables are tried
// one after the other, and a combination counts only when the open half spaces (and the quadrics that the cell is
// inside of) have a point in common with the cell's interior, which `overlap` decides. When the expression has
// the same colour for all combinations that count, the cell has that colour: this is the arrangement of the
// surfaces in the cell, evaluated region by region.
//
// What holds: white and black are right. For flat primitives gray is right too, except where `overlap` is unsure
// or a limit below is met. Curved surfaces that coincide are recognised; that two *different* quadrics have no
// common point outside both is not looked for, so gray may remain where they touch.
// A leaf that occurs more than once is first tried as one variable: a body less itself is nothing, however many facets
// it has. A mesh takes part when all its triangles in the cell lie in one plane: being closed, it is then a half space,
// or constant. Otherwise it is one variable of its own. A convex body whose interior `overlap` shows to keep off the
// cell is no variable at all.
// Cost: at most `most_combinations` calls of `overlap`, typically two to six; second_look.hpp asks only when nothing
// cheaper tells.

namespace octavo::csg {

inline constexpr std::size_t most_surfaces = 24;
inline constexpr int most_combinations = 256;

/// A surface in the cell, on which a point lies strictly inside (true) or strictly outside (false).
struct LocalSurface {
    enum class Kind : std::uint8_t { plane, cone, torus, leaf } kind = Kind::plane;
    std::uint32_t index = 0;  ///< in the program; not of a plane
    LatticePlane plane;
    /// Where the points of the cell lie, of a plane or cone: most combinations of signs are those of some point.
    PointColors points;
};

/// Resolves one cell after the other; keeps its buffers.
class LocalArrangement {
  public:
    /// `words` is what pruning left for the cell, not empty, and `below` has just evaluated it in the cell's octants.
    octree::Color resolve(const Program& program, std::span<const std::uint32_t> words,
                          const octree::Cell& cell, const Pruner& below);

  private:
    struct Literal {
        std::uint8_t surface = 0;
        bool value = true;
    };
    /// The expression in the cell with leaves replaced by conjunctions of literals, in prefix order.
    struct Node {
        enum class Kind : std::uint8_t { operation, literals, constant } kind = Kind::constant;
        bool complemented = false;           // of literals; of a constant: its value
        std::uint32_t word = 0;              // of an operation
        std::uint32_t end = 0;               // of an operation: one past its last node
        std::uint32_t first = 0, count = 0;  // literals
    };
    struct Open {
        std::uint32_t word, end;
        octree::Color color;
    };

    /// What the Boolean variables are: whole leaves, of whose shape nothing is asked, or their surfaces.
    enum class Variables : std::uint8_t { leaves, surfaces };
    octree::Color arrange(std::span<const std::uint32_t> words, Variables variables);
    bool repeats_a_leaf(std::span<const std::uint32_t> words);

    bool read(std::span<const std::uint32_t> words);
    bool read_leaf(std::span<const std::uint32_t> words, std::size_t at);
    bool read_box(const Leaf& leaf);
    bool keeps_off(std::span<const std::uint32_t> constraints) const;
    bool read_convex(std::span<const std::uint32_t> constraints, bool met, Node& node);
    bool read_polyhedron(std::uint32_t leaf_index, std::span<const std::uint32_t> items, Node& node);
    bool add_plane(const LatticePlane& plane, bool value);
    bool add_cone(std::uint32_t index);
    bool add_torus(std::uint32_t index);
    bool add_leaf(std::uint32_t index);
    bool add_surface(const LocalSurface& surface);
    bool add_literal(std::size_t surface, bool value);

    octree::Color evaluate();
    octree::Color color_of(const Node& node) const;
    void try_signs(std::size_t depth);
    bool is_possible(std::size_t depth);

    const Program* program_ = nullptr;
    const Pruner* below_ = nullptr;
    octree::Cell cell_;
    Variables variables_ = Variables::surfaces;
    std::vector<std::uint32_t> seen_leaves_;
    std::vector<Node> nodes_;
    std::vector<Literal> literals_;
    std::vector<Open> open_;
    std::array<LocalSurface, most_surfaces> surfaces_;
    /// By surface: the side that is tried, gray when none is yet.
    std::array<octree::Color, most_surfaces> sides_{};
    std::size_t count_ = 0;
    bool black_ = false, white_ = false;
    int combinations_ = 0;
};

}  // namespace octavo::csg
