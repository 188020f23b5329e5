// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include <octavo/boolean/expression.hpp>
#include <octavo/boolean/formula.hpp>
#include <octavo/io/format.hpp>
#include <octavo/io/openscad_csg.hpp>

#include "boolean_facts.hpp"
#include "model.hpp"
#include "program.hpp"

// `octavo eval "(body | lid) - bore" body=b.stl lid=l.stl bore=c.ply -o OUT` and `octavo eval MODEL.csg -o OUT`: a
// whole expression in one pass.

namespace octavo::cli {
namespace {

struct EvalOptions {
    std::string expression;
    std::vector<std::string> operands;  ///< NAME=FILE
    bool skip_unsupported = false;
    BooleanOutput output;
};

bool is_csg(const std::string& expression) { return io::extension_of(expression) == "csg"; }

std::string check_expression(const std::string& text) {
    if (is_csg(text)) return "";
    const Result<boolean::Formula> formula = boolean::parse_formula(text);
    return formula ? "" : formula.error().sentence;
}

std::string check_operand(const std::string& text) {
    const std::size_t sign = text.find('=');
    return sign == std::string::npos || sign == 0 || sign + 1 == text.size() ? "wants NAME=FILE" : "";
}

/// The file of each name of the formula.
Result<std::vector<std::string>> files_of(Session& session, const boolean::Formula& formula,
                                          const EvalOptions& options) {
    std::vector<std::string> files(formula.names.size());
    for (const std::string& operand : options.operands) {
        const std::size_t sign = operand.find('=');
        const auto place = std::find(formula.names.begin(), formula.names.end(), operand.substr(0, sign));
        if (place == formula.names.end())
            return session.usage_error(fmt::format("{} is not in the expression", operand.substr(0, sign)));
        std::string& file = files[static_cast<std::size_t>(place - formula.names.begin())];
        if (!file.empty()) return session.usage_error(fmt::format("{} is given twice", *place));
        file = operand.substr(sign + 1);
    }
    for (std::size_t i = 0; i < files.size(); ++i)
        if (files[i].empty())
            return session.usage_error(fmt::format("{0} has no file; add {0}=FILE", formula.names[i]));
    return files;
}

Result<boolean::Evaluated> evaluate_formula(Session& session, const Context& context,
                                            const EvalOptions& options, const boolean::Formula& formula,
                                            const std::vector<std::string>& files,
                                            const std::string& format) {
    std::vector<mesh::Mesh> meshes;
    for (const std::string& file : files) {
        Result<io::ReadMesh> read = read_operand(session, context, file);
        if (!read) return std::move(read).error();
        meshes.push_back(std::move(read->mesh));
    }
    std::vector<const mesh::Mesh*> operands;
    for (const mesh::Mesh& mesh : meshes) operands.push_back(&mesh);
    boolean::Options evaluation = options.output.evaluation(format);
    evaluation.names = formula.names;
    return session.timed("evaluate",
                         [&] { return boolean::evaluate(operands, formula.program, evaluation, context); });
}

Result<boolean::Evaluated> evaluate_csg(Session& session, const Context& context, const EvalOptions& options,
                                        const std::string& format) {
    const Result<io::CsgFile> file =
        read_csg(session, context, options.expression,
                 {.faceted = true, .skip_unsupported = options.skip_unsupported});
    if (!file) return file.error();
    return session.timed("evaluate", [&] {
        return boolean::evaluate(file->expression,
                                 options.output.evaluation(format, {2e-6, boolean::Tolerance::Of::size}),
                                 context);
    });
}

Result<ExitCode> eval_csg(Session& session, const EvalOptions& options) {
    const Context context = session.context();
    if (!options.operands.empty())
        return session.usage_error("a .csg file names its parts itself; leave out NAME=FILE");
    const Result<std::string> format = settle_output(session, {options.expression}, options.output.output,
                                                     options.output.format, mesh_outputs());
    if (!format) return format.error();
    const Result<boolean::Evaluated> evaluated = evaluate_csg(session, context, options, *format);
    if (!evaluated) return in_file(evaluated.error(), options.expression);
    return write_boolean(session, context, *evaluated, options.output.output, *format);
}

Result<ExitCode> eval(Session& session, const EvalOptions& options) {
    if (is_csg(options.expression)) return eval_csg(session, options);
    const Context context = session.context();
    const Result<boolean::Formula> formula = boolean::parse_formula(options.expression);
    if (!formula) return formula.error();
    const Result<std::vector<std::string>> files = files_of(session, *formula, options);
    if (!files) return files.error();
    const Result<std::string> format =
        settle_output(session, *files, options.output.output, options.output.format, mesh_outputs());
    if (!format) return format.error();
    const Result<boolean::Evaluated> evaluated =
        evaluate_formula(session, context, options, *formula, *files, *format);
    if (!evaluated)
        return in_its_file(with_advice(evaluated.error(), options.output), *files, formula->names);
    return write_boolean(session, context, *evaluated, options.output.output, *format);
}

}  // namespace

void add_eval(Program& program) {
    const auto options = std::make_shared<EvalOptions>();
    Verb* verb = program.verb("eval", "Edit", "Evaluate a set expression, or an OpenSCAD .csg tree, exactly",
                              [options](Session& session) { return eval(session, *options); });
    verb->add_option(
            "EXPRESSION", options->expression,
            "A .csg file, or names joined by | or + (union), & or * (intersection), - (difference), ^ "
            "(symmetric difference) and parentheses; & and * bind first, then left to right")
        ->required()
        ->check(check_expression)
        ->type_name("EXPRESSION");
    verb->add_option("OPERANDS", options->operands,
                     "The closed mesh, .csg tree, .bso or .bpo that each name stands for")
        ->check(check_operand)
        ->type_name("NAME=FILE");
    verb->add_flag("--skip-unsupported", options->skip_unsupported,
                   "Leave out .csg parts that cannot be read, with a warning");
    add_boolean_options(verb, options->output);
}

}  // namespace octavo::cli
