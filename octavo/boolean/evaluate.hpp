// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/boolean/classify.hpp>
#include <octavo/boolean/flush.hpp>
#include <octavo/boolean/program.hpp>
#include <octavo/boolean/rounded_points.hpp>
#include <octavo/boolean/soup.hpp>
#include <octavo/mesh/mesh.hpp>

// Exact set operations on solids bounded by triangle meshes: a whole expression of any number of operands in one
// pass, without intermediate meshes.
//
// A point is inside an operand when the operand's surface winds about it at least once, so operands may be nested
// and may intersect themselves. Every decision is exact on the joint lattice of the operands.
//
// Guaranteed of a result: closed, consistently oriented, every edge with two facets and every vertex with one fan
// (where the solid touches itself, vertices are doubled), no T-junctions; facets that nothing cut are the input's;
// the same bytes for any number of threads.
// Not guaranteed: detail finer than the lattice (2^-26 of the joint bounds), and that the smallest facets survive the
// rounding of exact intersection points to doubles, or floats. Those that it turns over or makes cross are found by an
// exact test of what leaves the library and mended by taking points to other numbers nearby; the report names those
// left. Source: C. J. Ogayar, F. R. Feito, R. J. Segura, M. Rivero, Evaluación optimizada de árboles CSG de sólidos
// triangulados de forma libre, 2008 (one pass over the whole tree: cut only what meets, classify groups by one point,
// select by the expression). We depart from it in exactness, in winding numbers instead of in/out/on, and in
// classifying all groups of a component by one ray.

namespace octavo::boolean {

enum class Simplify : std::uint8_t {
    none,
    coplanar,  ///< pieces of cut facets that lie in one plane become one polygon again
};

/// What counts as flush (flush.hpp); 0 is nothing but what touches exactly.
struct Tolerance {
    enum class Of : std::uint8_t {
        length,   ///< world units
        lattice,  ///< units of the joint lattice: two join what one rounding of each part has moved apart
        size,     ///< the longest side of the operands' joint bounds
    };
    double value = 0;
    Of unit = Of::length;
};

/// What rounding does to facets (rounding_faults.hpp).
enum class Faults : std::uint8_t {
    mended,   ///< where that is possible; the report names those left
    ignored,  ///< for callers that round again; the report tells of none
};

struct Options {
    Simplify simplify = Simplify::coplanar;
    Tolerance tolerance{};
    OpenOperands open = OpenOperands::reject;
    Dangling dangling = Dangling::dropped;  ///< faces that closed operands share outside of the result
    Numbers numbers = Numbers::doubles;     ///< that the result will be written as
    Faults faults = Faults::mended;
    std::vector<std::string> names{};  ///< of operands, for warnings
};

struct Report {
    std::size_t operands = 0;
    std::size_t input_triangles = 0;
    std::size_t coincident_facets = 0;  ///< merged with another facet before anything else
    std::size_t flat_facets = 0;        ///< had no area on the lattice
    std::size_t closing_facets = 0;     ///< added to close open operands
    std::size_t moved_vertices = 0;     ///< by snapping
    double largest_displacement = 0;    ///< by snapping, in world units
    FlushReport flush;                  ///< what the tolerance joined
    std::size_t pairs_tested = 0;       ///< facet against facet
    std::size_t cut_facets = 0;
    std::size_t pieces = 0;          ///< of the cut facets
    std::size_t dropped_facets = 0;  ///< facets that nothing cut, and pieces, that do not bound the result
    std::size_t constructed_points = 0;
    std::size_t patches = 0;
    std::size_t components = 0;       ///< each located by one exact ray
    std::size_t exact_fallbacks = 0;  ///< predicates that the floating-point filter left undecided
    double largest_rounding = 0;      ///< of an exact point on export, in world units
    std::size_t mended_points = 0;    ///< not at the nearest doubles, so that no facet turns over or crosses
    std::size_t inverted_facets = 0;  ///< turned over or made flat by rounding on export
    std::vector<std::uint32_t> first_inverted;  ///< up to 8 of them, as triangles of the result
    std::size_t crossing_facets = 0;            ///< pairs of others that rounding made cross or touch
    std::vector<std::pair<std::uint32_t, std::uint32_t>> first_crossing;  ///< up to 8 of them
    std::size_t duplicated_vertices = 0;
    std::size_t dangling_facets = 0;  ///< the last of the result; with vertices of their own
    bool closed = true;
    bool manifold = true;
    std::vector<std::string> warnings;

    /// Wall seconds of the phases, in their order.
    struct Phase {
        const char* name;
        double seconds;
    };
    std::vector<Phase> phases;
};

struct Evaluated {
    mesh::Mesh mesh;  ///< `sources` names operand and facet for each triangle; may be empty, with a warning
    Report report;
};

/// Evaluates `program` over closed meshes; operand k of the program is `operands[k]`.
/// Errors: not_a_solid when an operand is open or inconsistently oriented and `open` rejects that (with operand and
/// facets), bad_input when a mesh is malformed, the tolerance no length, or the result unbounded, limit when the
/// operands have no common lattice, cancelled.
Result<Evaluated> evaluate(std::span<const mesh::Mesh* const> operands, const Program& program,
                           const Options& options = {}, const Context& context = {});

Result<Evaluated> unite(std::span<const mesh::Mesh> operands, const Options& options = {},
                        const Context& context = {});
Result<Evaluated> intersect(std::span<const mesh::Mesh> operands, const Options& options = {},
                            const Context& context = {});
/// The first operand without all others.
Result<Evaluated> subtract(std::span<const mesh::Mesh> operands, const Options& options = {},
                           const Context& context = {});
/// What is inside an odd number of operands.
Result<Evaluated> symmetric_difference(std::span<const mesh::Mesh> operands, const Options& options = {},
                                       const Context& context = {});

}  // namespace octavo::boolean
