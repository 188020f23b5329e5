// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "boolean_facts.hpp"
#include "model.hpp"
#include "program.hpp"
#include <octavo/boolean/expression.hpp>
#include <octavo/boolean/formula.hpp>
#include <octavo/io/openscad_csg.hpp>

// `octavo eval "(body | lid) - bore" body=b.stl lid=l.stl bore=c.ply -o OUT` and `octavo eval MODEL.csg -o OUT`: a whole
// expression in one pass.

namespace octavo::cli {
namespace {

struct EvalOptions {
    std::string expression;
    std::vector<std::string> operands;  ///< NAME=FILE
    bool skip_unsupported = false;
    BooleanOutput output;
};

bool is_csg(const std::string& expression) { return kind_of(expression, "") == ModelKind::csg; }

std::string check_expression(const std::string& text) {
    if (is_csg(text)) return "";
    const Result<boolean::Formula> formula = boolean::parse_formula(text);
    return formula ? "" : formula.error().sentence;
}

std::string check_operand(const std::string& text) {
    const std::size_t sign = text.find('=');
    return sign == std::string::npos || sign == 0 || sign + 1 == text.size() ? "wants NAME=FILE" : "";
}

Error misnamed(const std::string& sentence) { return {ErrorCode::bad_input, sentence, {}}; }

/// The file of each name of the formula.
Result<std::vector<std::string>> files_of(const boolean::Formula& formula, const EvalOptions& options) {
    std::vector<std::string> files(formula.names.size());
    for (const std::string& operand : options.operands) {
        const std::size_t sign = operand.find('=');
        const auto place = std::find(formula.names.begin(), formula.names.end(), operand.substr(0, sign));
        if (place == formula.names.end())
            return misnamed(fmt::format("{} is not in the expression", operand.substr(0, sign)));
        std::string& file = files[static_cast<std::size_t>(place - formula.names.begin())];
        if (!file.empty()) return misnamed(fmt::format("{} is given twice", *place));
        file = operand.substr(sign + 1);
    }
    for (std::size_t i = 0; i < files.size(); ++i)
        if (files[i].empty()) return misnamed(fmt::format("{0} has no file; add {0}=FILE", formula.names[i]));
    return files;
}

Result<boolean::Evaluated> evaluate_formula(Session& session, const Context& context,
                                            const EvalOptions& options) {
    const Result<boolean::Formula> formula = boolean::parse_formula(options.expression);
    if (!formula) return formula.error();
    const Result<std::vector<std::string>> files = files_of(*formula, options);
    if (!files) return files.error();
    std::vector<mesh::Mesh> meshes;
    for (const std::string& file : *files) {
        if (same_file(file, options.output.output)) return would_overwrite(file);
        Result<io::ReadMesh> read = read_mesh(session, context, file);
        if (!read) return std::move(read).error();
        meshes.push_back(std::move(read->mesh));
    }
    std::vector<const mesh::Mesh*> operands;
    for (const mesh::Mesh& mesh : meshes) operands.push_back(&mesh);
    return session.timed("evaluate", [&] {
        return boolean::evaluate(operands, formula->program, options.output.evaluation(), context);
    });
}

Result<boolean::Evaluated> evaluate_csg(Session& session, const Context& context,
                                        const EvalOptions& options) {
    if (!options.operands.empty()) return misnamed("a .csg file names its parts itself; leave out NAME=FILE");
    session.inputs.push_back(options.expression);
    io::CsgReadOptions reading;
    reading.faceted = true;
    reading.skip_unsupported = options.skip_unsupported;
    const Result<io::CsgFile> file =
        session.timed("read", [&] { return io::read_csg(options.expression, reading, context); });
    if (!file) return file.error();
    session.warn(file->warnings);
    return session.timed("evaluate", [&] {
        return boolean::evaluate(file->expression, options.output.evaluation(), context);
    });
}

Result<ExitCode> eval(Session& session, const EvalOptions& options) {
    const Context context = session.context();
    Result<boolean::Evaluated> evaluated = is_csg(options.expression)
                                               ? evaluate_csg(session, context, options)
                                               : evaluate_formula(session, context, options);
    if (!evaluated)
        return is_csg(options.expression) ? in_file(std::move(evaluated).error(), options.expression)
                                          : std::move(evaluated).error();
    return write_boolean(session, context, *evaluated, options.output);
}

}  // namespace

void add_eval(Program& program) {
    const auto options = std::make_shared<EvalOptions>();
    CLI::App* verb =
        program.verb("eval", "Edit", "Evaluate a set expression, or an OpenSCAD .csg tree, exactly",
                     [options](Session& session) { return eval(session, *options); });
    verb->add_option(
            "EXPRESSION", options->expression,
            "A .csg file, or names joined by | or + (union), & or * (intersection), - (difference), ^ "
            "(symmetric difference) and parentheses; & and * bind first, then left to right")
        ->required()
        ->check(check_expression)
        ->type_name("EXPRESSION");
    verb->add_option("OPERANDS", options->operands, "The closed mesh that each name stands for")
        ->check(check_operand)
        ->type_name("NAME=FILE");
    verb->add_flag("--skip-unsupported", options->skip_unsupported,
                   "Leave out .csg parts that cannot be read, with a warning");
    add_boolean_options(verb, options->output);
}

}  // namespace octavo::cli
