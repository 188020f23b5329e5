// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <octavo/csg/tessellate.hpp>
#include <octavo/io/openscad_csg_syntax.hpp>

// The arguments of one node by name, by position or by default. The first thing that is wrong with any of them is
// kept, with its place, and asked for once at the end.

namespace octavo::io::openscad {

class Parameters {
  public:
    /// `positions` names the parameters that may be given without a name, in order.
    Parameters(const Syntax& syntax, const Node& node, std::initializer_list<std::string_view> positions);

    bool has(std::string_view name) const { return find(name) != nullptr; }
    /// Finite numbers only.
    double number(std::string_view name, double fallback);
    std::optional<double> number(std::string_view name);
    bool boolean(std::string_view name, bool fallback);
    std::string string(std::string_view name);
    /// A vector of `N` numbers; one number stands for all. Missing elements keep the fallback's.
    template <std::size_t N>
    std::array<double, N> vector(std::string_view name, std::array<double, N> fallback) {
        std::vector<double> values(fallback.begin(), fallback.end());
        fill(name, values);
        std::copy(values.begin(), values.end(), fallback.begin());
        return fallback;
    }
    /// Rows of numbers, such as points; empty when missing.
    std::vector<std::vector<double>> rows(std::string_view name);
    /// Rows of indices; those outside [0, limit) are dropped, as OpenSCAD does.
    std::vector<std::vector<std::uint32_t>> index_rows(std::string_view name, std::size_t limit);
    csg::Roundness roundness();

    void fail(std::string sentence);
    const std::optional<Error>& error() const { return error_; }

  private:
    const Argument* find(std::string_view name) const;
    const Value& value(const Argument& argument) const { return syntax_.values[argument.value]; }
    std::optional<double> finite(const Argument& argument, const Value& value);
    void fill(std::string_view name, std::vector<double>& values);
    void wrong(const Argument& argument, const char* expected);

    const Syntax& syntax_;
    const Node& node_;
    std::vector<std::pair<std::string_view, const Argument*>> by_name_;
    std::optional<Error> error_;
};

}  // namespace octavo::io::openscad
