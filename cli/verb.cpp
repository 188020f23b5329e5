// SPDX-License-Identifier: Apache-2.0
#include "verb.hpp"

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace octavo::cli {

Option* Option::required() {
    option_->required();
    return this;
}
Option* Option::type_name(const std::string& placeholder) {
    option_->type_name(placeholder);
    return this;
}
Option* Option::check(OptionCheck check) {
    option_->check(std::move(check));
    return this;
}
Option* Option::capture_default_str() {
    option_->capture_default_str();
    return this;
}
Option* Option::group(const std::string& heading) {
    option_->group(heading);
    return this;
}
Option* Option::excludes(Option* other) {
    option_->excludes(other->option_);
    return this;
}
Option* Option::needs(Option* other) {
    option_->needs(other->option_);
    return this;
}

template <class Value>
Option* Verb::add_option(const std::string& names, Value& value, const std::string& help) {
    return &options_.emplace_back(app_->add_option(names, value, help));
}
Option* Verb::add_flag(const std::string& names, bool& value, const std::string& help) {
    return &options_.emplace_back(app_->add_flag(names, value, help));
}

template Option* Verb::add_option(const std::string&, std::string&, const std::string&);
template Option* Verb::add_option(const std::string&, std::vector<std::string>&, const std::string&);
template Option* Verb::add_option(const std::string&, int&, const std::string&);
template Option* Verb::add_option(const std::string&, std::uint32_t&, const std::string&);
template Option* Verb::add_option(const std::string&, std::uint64_t&, const std::string&);
template Option* Verb::add_option(const std::string&, double&, const std::string&);
template Option* Verb::add_option(const std::string&, std::optional<int>&, const std::string&);
template Option* Verb::add_option(const std::string&, std::optional<std::uint32_t>&, const std::string&);
template Option* Verb::add_option(const std::string&, std::optional<double>&, const std::string&);

}  // namespace octavo::cli
