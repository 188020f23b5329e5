// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <functional>
#include <string>

// What a verb takes, in the terms of CLI11, of which only verb.cpp and the files that read the definitions back know.
//
// CLI11 is headers only: including it took more than half of the time in which a verb compiles. Here values are bound
// by a template that verb.cpp instantiates for the types that options have.

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace octavo::cli {

/// Says in words what is wanted and what was given; an empty string is approval.
using OptionCheck = std::function<std::string(const std::string&)>;

/// One option or positional of a verb. All return the option itself, for more.
class Option {
  public:
    explicit Option(CLI::Option* option) : option_(option) {}

    Option* required();
    Option* type_name(const std::string& placeholder);
    Option* check(OptionCheck check);
    /// Help tells the value that the variable has now.
    Option* capture_default_str();
    Option* group(const std::string& heading);
    Option* excludes(Option* other);
    Option* needs(Option* other);

  private:
    CLI::Option* option_;
};

class Verb {
  public:
    explicit Verb(CLI::App* app) : app_(app) {}

    /// `names`: "-o,--output", or "FILE" for a positional; a vector takes several values. Parsing writes `value`,
    /// which must live as long as the verb.
    template <class Value>
    Option* add_option(const std::string& names, Value& value, const std::string& help);
    Option* add_flag(const std::string& names, bool& value, const std::string& help);

  private:
    CLI::App* app_;
    std::deque<Option> options_;  // which stay where they are
};

}  // namespace octavo::cli
