// SPDX-License-Identifier: Apache-2.0
#include <memory>
#include <string>
#include <variant>

#include <octavo/boolean/expression.hpp>
#include <octavo/csg/tessellate.hpp>
#include <octavo/mesh/transform.hpp>

namespace octavo::boolean {

Program program_of(const csg::NormalForm& form) {
    // Read backwards, prefix order is postfix order: every operation finds its operands on the stack.
    struct Pending {
        Program::NodeId node;
        bool complemented;
        std::uint32_t size;
    };
    OCTAVO_CHECK(!form.is_constant(), "a constant expression has no operands");
    Program program;
    for (std::uint32_t leaf = 0; leaf < form.leaves.size(); ++leaf) program.operand(leaf);
    std::vector<Pending> stack;
    std::vector<Program::NodeId> inputs;
    std::vector<char> flags;
    for (std::size_t at = form.tokens.size(); at-- > 0;) {
        const csg::NormalToken& token = form.tokens[at];
        if (token.kind == csg::NormalKind::leaf) {
            stack.push_back({program.operand(token.leaf), token.complemented, token.size});
            continue;
        }
        inputs.clear(), flags.clear();
        for (std::uint32_t below = token.size - 1; below > 0; below -= stack.back().size, stack.pop_back()) {
            inputs.push_back(stack.back().node);
            flags.push_back(stack.back().complemented);
        }
        const auto negated = std::make_unique<bool[]>(flags.size());
        for (std::size_t i = 0; i < flags.size(); ++i) negated[i] = flags[i] != 0;
        const Gate gate = token.kind == csg::NormalKind::union_of       ? Gate::any
                          : token.kind == csg::NormalKind::intersection ? Gate::all
                                                                        : Gate::odd;
        stack.push_back(
            {program.gate(gate, inputs, {negated.get(), flags.size()}), token.complemented, token.size});
    }
    // A gate of one input ends the program, so that the root is the last node whatever the form was.
    const bool negated = stack.back().complemented;
    program.gate(Gate::any, {&stack.back().node, 1}, {&negated, 1});
    return program;
}

namespace {

/// The facets of a leaf in place, or what keeps it from having any.
Result<mesh::Mesh> facets_of(const csg::PlacedPrimitive& leaf, std::size_t number) {
    if (const auto* polyhedron = std::get_if<csg::Polyhedron>(leaf.primitive)) {
        if (!polyhedron->mesh) return mesh::Mesh{};
        return mesh::transform(*polyhedron->mesh, leaf.place);
    }
    if (const auto* cuboid = std::get_if<csg::Cuboid>(leaf.primitive))
        return mesh::transform(csg::cuboid_mesh(cuboid->low, cuboid->high), leaf.place);
    return Error{ErrorCode::unsupported,
                 "leaf " + std::to_string(number) + " of the expression is no polyhedron; facet it first",
                 {}};
}

}  // namespace

Result<Evaluated> evaluate(const csg::Expr& expression, const Options& options, const Context& context) {
    const Result<csg::NormalForm> form = csg::normal_form(expression);
    if (!form) return form.error();
    if (form->is_constant()) {
        if (form->tokens.front().complemented)
            return Error{ErrorCode::bad_input, "the result is unbounded: the expression is all of space", {}};
        Evaluated nothing;
        nothing.report.warnings.push_back("the result is empty");
        return nothing;
    }
    std::vector<mesh::Mesh> meshes;
    meshes.reserve(form->leaves.size());
    for (const csg::PlacedPrimitive& leaf : form->leaves) {
        Result<mesh::Mesh> mesh = facets_of(leaf, meshes.size());
        if (!mesh) return mesh.error();
        meshes.push_back(std::move(*mesh));
    }
    std::vector<const mesh::Mesh*> operands;
    for (const mesh::Mesh& mesh : meshes) operands.push_back(&mesh);
    return evaluate(operands, program_of(*form), options, context);
}

}  // namespace octavo::boolean
