// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <octavo/io/openscad_csg_parameters.hpp>

namespace octavo::io::openscad {

Parameters::Parameters(const Syntax& syntax, const Node& node,
                       std::initializer_list<std::string_view> positions)
    : syntax_(syntax), node_(node) {
    auto position = positions.begin();
    for (std::uint32_t i = 0; i < node.argument_count; ++i) {
        const Argument& argument = syntax.arguments[node.first_argument + i];
        if (!argument.name.empty())
            by_name_.emplace_back(argument.name, &argument);
        else if (position != positions.end())
            by_name_.emplace_back(*position++, &argument);
    }
}

const Argument* Parameters::find(std::string_view name) const {
    const Argument* found = nullptr;  // the last one counts, as in OpenSCAD
    for (const auto& [key, argument] : by_name_)
        if (key == name && value(*argument).kind() != Value::Kind::undefined) found = argument;
    return found;
}

void Parameters::fail(std::string sentence) {
    if (!error_)
        error_ = syntax_.error_at(node_.place, std::string(node_.name) + "(…): " + std::move(sentence));
}

void Parameters::wrong(const Argument& argument, const char* expected) {
    if (error_) return;
    const std::string name = argument.name.empty() ? "an argument" : "'" + std::string(argument.name) + "'";
    error_ =
        syntax_.error_at(argument.place, name + " of " + std::string(node_.name) + "(…) must be " + expected);
}

std::optional<double> Parameters::finite(const Argument& argument, const Value& v) {
    if (v.kind() != Value::Kind::number || !std::isfinite(v.number)) {
        wrong(argument, "a finite number");
        return {};
    }
    return v.number;
}

std::optional<double> Parameters::number(std::string_view name) {
    const Argument* argument = find(name);
    return argument ? finite(*argument, value(*argument)) : std::nullopt;
}

double Parameters::number(std::string_view name, double fallback) { return number(name).value_or(fallback); }

bool Parameters::boolean(std::string_view name, bool fallback) {
    const Argument* argument = find(name);
    if (!argument) return fallback;
    const Value& v = value(*argument);
    if (v.kind() == Value::Kind::boolean || v.kind() == Value::Kind::number) return v.number != 0;
    wrong(*argument, "true or false");
    return fallback;
}

std::string Parameters::string(std::string_view name) {
    const Argument* argument = find(name);
    if (!argument) return {};
    if (value(*argument).kind() == Value::Kind::string) return unescaped(argument->raw_string);
    wrong(*argument, "a string");
    return {};
}

void Parameters::fill(std::string_view name, std::vector<double>& values) {
    const Argument* argument = find(name);
    if (!argument) return;
    const Value& v = value(*argument);
    if (v.kind() == Value::Kind::number) {
        if (const std::optional<double> all = finite(*argument, v)) values.assign(values.size(), *all);
        return;
    }
    if (v.kind() != Value::Kind::vector) return wrong(*argument, "a vector of numbers");
    const Value* element = &v + 1;
    for (std::uint32_t i = 0; i < v.count && i < values.size(); ++i, element += element->size)
        if (const std::optional<double> one = finite(*argument, *element)) values[i] = *one;
}

std::vector<std::vector<double>> Parameters::rows(std::string_view name) {
    std::vector<std::vector<double>> result;
    const Argument* argument = find(name);
    if (!argument) return result;
    const Value& v = value(*argument);
    if (v.kind() != Value::Kind::vector) {
        wrong(*argument, "a vector of vectors");
        return result;
    }
    const Value* row = &v + 1;
    for (std::uint32_t i = 0; i < v.count && !error_; ++i, row += row->size) {
        if (row->kind() != Value::Kind::vector) {
            wrong(*argument, "a vector of vectors");
            break;
        }
        std::vector<double> numbers;
        const Value* element = row + 1;
        for (std::uint32_t k = 0; k < row->count && !error_; ++k, element += element->size)
            numbers.push_back(finite(*argument, *element).value_or(0));
        result.push_back(std::move(numbers));
    }
    return result;
}

std::vector<std::vector<std::uint32_t>> Parameters::index_rows(std::string_view name, std::size_t limit) {
    std::vector<std::vector<std::uint32_t>> result;
    for (const std::vector<double>& row : rows(name)) {
        std::vector<std::uint32_t> indices;
        for (const double index : row)
            if (index >= 0 && index < static_cast<double>(limit))
                indices.push_back(static_cast<std::uint32_t>(index));
        result.push_back(std::move(indices));
    }
    return result;
}

csg::Roundness Parameters::roundness() {
    csg::Roundness roundness;
    roundness.fn = number("$fn", roundness.fn);
    roundness.fa = number("$fa", roundness.fa);
    roundness.fs = number("$fs", roundness.fs);
    return roundness;
}

}  // namespace octavo::io::openscad
