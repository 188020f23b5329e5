// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/mesh/transform.hpp>

#include "boolean_facts.hpp"
#include "model.hpp"
#include "numbers.hpp"
#include "program.hpp"

// `octavo union A B … -o OUT`, `intersection`, `difference` and `xor`: exact set operations on any number of meshes,
// in one pass.

namespace octavo::cli {
namespace {

struct BooleanOptions {
    std::vector<std::string> operands, transforms;
    BooleanOutput output;
};

using Operation = Result<boolean::Evaluated> (*)(std::span<const mesh::Mesh>, const boolean::Options&,
                                                 const Context&);

/// One --transform: FILE and the matrix for it.
struct Transform {
    std::string file;
    Affine map;
};

/// `text` is FILE:m0,m1,… with 12 or 16 numbers, row-major.
std::optional<Transform> parse_transform(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos || colon == 0) return std::nullopt;
    const std::optional<std::vector<double>> parsed = parse_numbers(std::string_view(text).substr(colon + 1));
    if (!parsed) return std::nullopt;
    const std::vector<double>& numbers = *parsed;
    const bool affine = numbers.size() == 12 || (numbers.size() == 16 && numbers[12] == 0 &&
                                                 numbers[13] == 0 && numbers[14] == 0 && numbers[15] == 1);
    if (!affine) return std::nullopt;
    Transform transform{text.substr(0, colon), {}};
    for (int k = 0; k < 12; ++k) transform.map.m[k / 4][k % 4] = numbers[k];
    return transform;
}

std::string check_transform(const std::string& text) {
    return parse_transform(text)
               ? ""
               : "wants FILE:m0,m1,... with 12 numbers (3 rows of 4) or 16 (the last row 0,0,0,1)";
}

Result<std::vector<mesh::Mesh>> read_operands(Session& session, const Context& context,
                                              const BooleanOptions& options) {
    std::vector<mesh::Mesh> operands;
    for (const std::string& path : options.operands) {
        Result<io::ReadMesh> read = read_operand(session, context, path);
        if (!read) return std::move(read).error();
        operands.push_back(std::move(read->mesh));
    }
    for (const std::string& text : options.transforms) {
        const Transform transform = *parse_transform(text);
        bool found = false;
        for (std::size_t i = 0; i < operands.size(); ++i)
            if (options.operands[i] == transform.file) {
                operands[i] = mesh::transform(operands[i], transform.map);
                found = true;
            }
        if (!found)
            return session.usage_error("--transform names " + transform.file + ", which is no operand");
    }
    return operands;
}

Result<ExitCode> evaluate(Session& session, const BooleanOptions& options, Operation operation) {
    const Context context = session.context();
    const Result<std::string> format = settle_output(session, options.operands, options.output.output,
                                                     options.output.format, mesh_outputs());
    if (!format) return format.error();
    Result<std::vector<mesh::Mesh>> operands = read_operands(session, context, options);
    if (!operands) return std::move(operands).error();
    boolean::Options evaluation = options.output.evaluation(*format);
    evaluation.names = options.operands;
    Result<boolean::Evaluated> evaluated =
        session.timed("evaluate", [&] { return operation(*operands, evaluation, context); });
    if (!evaluated)
        return in_its_file(with_advice(std::move(evaluated).error(), options.output), options.operands);
    return write_boolean(session, context, *evaluated, options.output.output, *format);
}

void add_operation(Program& program, const char* name, const char* summary, Operation operation) {
    const auto options = std::make_shared<BooleanOptions>();
    Verb* verb = program.verb(name, "Edit", summary, [options, operation](Session& session) {
        return evaluate(session, *options, operation);
    });
    verb->add_option("FILES", options->operands,
                     "Closed meshes, one or more; of one the surface is made anew where it meets itself")
        ->required()
        ->type_name("FILE");
    verb->add_option("--transform", options->transforms,
                     "FILE:m0,m1,...: moves an operand by a matrix of 12 or 16 numbers, row-major")
        ->check(check_transform)
        ->type_name("FILE:MATRIX");
    add_boolean_options(verb, options->output);
}

}  // namespace

void add_boolean(Program& program) {
    add_operation(program, "union", "Unite solids exactly", boolean::unite);
    add_operation(program, "intersection", "Intersect solids exactly", boolean::intersect);
    add_operation(program, "difference", "Subtract solids from the first, exactly", boolean::subtract);
    add_operation(program, "xor", "Keep what is inside an odd number of solids",
                  boolean::symmetric_difference);
}

}  // namespace octavo::cli
