// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <variant>

#include <octavo/csg/compile_leaf.hpp>
#include <octavo/csg/form_bounds.hpp>

namespace octavo::csg {
namespace {

/// How far the meshes of a form reach, which must stay within LatticePolyhedron::reach.
Box3 polyhedra_bounds(const NormalForm& form, const FormBounds& bounds) {
    Box3 box;
    for (std::size_t i = 0; i < form.leaves.size(); ++i) {
        const auto* polyhedron = std::get_if<Polyhedron>(form.leaves[i].primitive);
        if (polyhedron && polyhedron->convexity == Convexity::any) box.add(bounds.leaves[i]);
    }
    return box;
}

/// The finest lattice for the content on which the polyhedra are within reach.
Result<exact::Lattice> fit_lattice(const Box3& content, const Box3& polyhedra) {
    Result<exact::Lattice> fitted = exact::Lattice::fit(content);
    if (!fitted || polyhedra.empty()) return fitted;
    exact::Lattice lattice = *fitted;
    // A few doublings at most matter; each centres the content again.
    for (int exponent = lattice.exponent();; ++exponent) {
        const double unit = std::ldexp(1.0, exponent);
        std::array<std::int64_t, 3> origin = lattice.origin();
        if (exponent != lattice.exponent())
            for (int axis = 0; axis < 3; ++axis)
                origin[static_cast<std::size_t>(axis)] =
                    static_cast<std::int64_t>(
                        std::floor(0.5 * (content.low[axis] + content.high[axis]) / unit)) -
                    exact::universe_side / 2;
        double farthest = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const auto o = static_cast<double>(origin[static_cast<std::size_t>(axis)]);
            farthest = std::max({farthest, std::fabs(polyhedra.low[axis] / unit - o),
                                 std::fabs(polyhedra.high[axis] / unit - o)});
        }
        if (farthest < LatticePolyhedron::reach - 2.0) return exact::Lattice::from_parts(exponent, origin);
        if (!std::isfinite(farthest) || exponent > lattice.exponent() + 2000)
            return Error{ErrorCode::bad_input, "a polyhedron has a vertex that is not finite", {}};
    }
}

/// Replaces the leaves of a normal form by words, dropping those that became constant on the lattice.
class WordWriter {
  public:
    WordWriter(Program& program, const NormalForm& form, std::vector<CompiledLeaf> leaves)
        : program_(program), form_(form), leaves_(std::move(leaves)) {}

    /// One pass backwards: the operands of an operation are complete when it is reached, so that constants and
    /// operations left with one operand vanish at once. The words come out reversed, leaf words have no payload.
    void write() {
        std::vector<std::uint32_t>& words = program_.words;
        for (std::size_t i = form_.tokens.size(); i-- > 0;) {
            const NormalToken& token = form_.tokens[i];
            if (token.kind == NormalKind::constant)
                operands_.push_back({State::constant, token.complemented, 1, words.size()});
            else if (token.kind == NormalKind::leaf)
                write_leaf(token);
            else
                write_operation(token);
        }
        const Operand& root = operands_.back();
        program_.constant = root.state == State::constant && root.value;
        std::reverse(words.begin(), words.end());
    }

  private:
    enum class State { constant, words };
    struct Operand {
        State state;
        bool value;            // of a constant
        std::uint32_t tokens;  // of the normal form
        std::size_t begin;     // of its words
    };

    void write_leaf(const NormalToken& token) {
        const CompiledLeaf& compiled = leaves_[token.leaf];
        const std::size_t begin = program_.words.size();
        if (!compiled.leaf) {
            operands_.push_back({State::constant, compiled.constant != token.complemented, 1, begin});
            return;
        }
        program_.words.push_back(word::leaf_bit | (token.complemented ? word::complement_bit : 0) |
                                 *compiled.leaf);
        operands_.push_back({State::words, false, 1, begin});
    }

    void write_operation(const NormalToken& token) {
        // Operands lie on the stack with the first on top, so the words of the last begin first.
        std::vector<std::uint32_t>& words = program_.words;
        std::size_t begin = words.size();
        std::uint32_t count = 0;
        bool odd = token.complemented, decided = false;
        for (std::uint32_t left = token.size - 1; left > 0;) {
            const Operand operand = operands_.back();
            operands_.pop_back();
            left -= operand.tokens;
            begin = operand.begin;
            if (operand.state == State::words)
                ++count;
            else if (token.kind == NormalKind::symmetric_difference)
                odd ^= operand.value;
            else if (operand.value == (token.kind == NormalKind::union_of))
                decided = true;
        }
        if (decided || count == 0) {
            words.resize(begin);
            const bool value = token.kind == NormalKind::symmetric_difference
                                   ? odd
                                   : decided == (token.kind == NormalKind::union_of);
            operands_.push_back({State::constant, value, token.size, begin});
            return;
        }
        if (count > 1 || odd) {
            const auto operation = token.kind == NormalKind::union_of       ? word::union_of
                                   : token.kind == NormalKind::intersection ? word::intersection
                                                                            : word::symmetric_difference;
            const bool even = operation == word::symmetric_difference && odd;
            if (count > 1 || even)
                words.push_back(std::uint32_t{operation} << word::operation_shift |
                                (even ? word::even_bit : 0) |
                                static_cast<std::uint32_t>(words.size() + 1 - begin));
        }
        operands_.push_back({State::words, false, token.size, begin});
    }

    Program& program_;
    const NormalForm& form_;
    std::vector<CompiledLeaf> leaves_;
    std::vector<Operand> operands_;
};

/// Room for what the leaves become at most: growing in steps would touch, and let the system clear, twice the memory.
void reserve(const NormalForm& form, Program& program) {
    std::size_t planes = 0, cones = 0;
    std::size_t leaves = 0;
    for (const NormalToken& token : form.tokens) {
        if (token.kind != NormalKind::leaf) continue;
        const Primitive& primitive = *form.leaves[token.leaf].primitive;
        ++leaves;
        if (std::holds_alternative<Cuboid>(primitive)) planes += 6;
        if (std::holds_alternative<HalfSpace>(primitive)) planes += 1;
        if (std::holds_alternative<Frustum>(primitive)) planes += 2;
        cones += std::holds_alternative<Frustum>(primitive) || std::holds_alternative<Ball>(primitive);
    }
    program.leaves.reserve(leaves);
    program.planes.reserve(planes);
    program.cones.reserve(cones);
    program.quadrics.reserve(cones);
    program.constraints.reserve(planes + cones);
    program.words.reserve(form.tokens.size());
}

bool is_bounded(const Box3& box) { return octavo::is_finite(box.low) && octavo::is_finite(box.high); }

}  // namespace

Result<Program> compile(const Expr& expression, const CompileOptions& options, const Context& context) {
    Result<NormalForm> form = normal_form(expression, options.normal_form);
    if (!form) return form.error();
    FormBounds bounds = form_bounds(*form);
    for (std::size_t i = 0; i < form->leaves.size(); ++i)
        if (!is_bounded(bounds.leaves[i]) && !std::holds_alternative<HalfSpace>(*form->leaves[i].primitive))
            return Error{ErrorCode::limit, "a primitive reaches farther than a double can hold", {}};
    Box3 content = options.universe ? *options.universe : bounds.box();
    Program program;
    if (content.empty() && !options.universe)
        content = {{0, 0, 0}, {1, 1, 1}};  // of an empty solid any will do
    if (!is_bounded(content))
        return Error{ErrorCode::limit, "the solid is unbounded; say which part of space to look at", {}};
    Result<exact::Lattice> lattice = fit_lattice(content, polyhedra_bounds(*form, bounds));
    if (!lattice) return lattice.error();
    program.lattice = *lattice;
    program.primitives = form->leaves.size();

    // Putting a primitive on the lattice moves it by less than two units.
    if (options.primitives == CompileOptions::Primitives::within_reach)
        drop_out_of_reach(*form, bounds, 2 * program.lattice.unit());
    // Their memory is what the program takes next: fresh pages would cost more than what is written into them.
    bounds.tokens = std::vector<FormBounds::Token>();
    reserve(*form, program);
    LeafCompiler compiler(program);
    std::vector<CompiledLeaf> leaves(form->leaves.size());
    // Backwards in the tokens is forwards in the leaves.
    for (std::size_t i = form->tokens.size(); i-- > 0;) {
        const NormalToken& token = form->tokens[i];
        if (i % 4096 == 0 && context.cancelled()) return Context::cancelled_error();
        if (token.kind != NormalKind::leaf) continue;
        Result<CompiledLeaf> compiled = compiler.compile(form->leaves[token.leaf], bounds.leaves[token.leaf]);
        if (!compiled) return compiled.error();
        leaves[token.leaf] = *compiled;
    }
    WordWriter(program, *form, std::move(leaves)).write();
    return program;
}

std::size_t Program::memory_bytes() const {
    std::size_t bytes = words.capacity() * sizeof(std::uint32_t) + leaves.capacity() * sizeof(Leaf) +
                        constraints.capacity() * sizeof(std::uint32_t) +
                        planes.capacity() * sizeof(LatticePlane) +
                        cones.capacity() * sizeof(SecondOrderCone) + quadrics.capacity() * sizeof(Quadric) +
                        tori.capacity() * sizeof(LatticeTorus);
    for (const LatticePolyhedron& polyhedron : polyhedra)
        bytes += polyhedron.points.capacity() * sizeof(polyhedron.points[0]) +
                 polyhedron.triangles.capacity() * sizeof(polyhedron.triangles[0]);
    return bytes;
}

}  // namespace octavo::csg
