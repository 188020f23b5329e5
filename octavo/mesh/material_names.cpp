// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include <octavo/mesh/material_names.hpp>

namespace octavo::mesh {
namespace {

bool is_of_words(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '+' || c == '-' || c == '.';
}

std::string spelled(std::string name, const NameRules& rules) {
    for (char& c : name) {
        if (rules.allows && !rules.allows(c)) c = '_';
        if (rules.upper_case) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    }
    const bool begins_with_letter = !name.empty() && std::isalpha(static_cast<unsigned char>(name[0]));
    if (!begins_with_letter) name.insert(0, rules.before_other_than_letters);
    return name.substr(0, rules.longest);
}

/// Spells more names, unlike each other and those in `taken`, to which they are added.
std::vector<std::string> distinct_from(std::set<std::string>& taken, std::span<const std::string> wanted,
                                       const NameRules& rules) {
    std::vector<std::string> names;
    std::vector<bool> is_first;
    for (const std::string& name : wanted) {
        names.push_back(spelled(name, rules));
        is_first.push_back(taken.insert(names.back()).second);
    }
    for (std::size_t i = 0; i < names.size(); ++i) {
        const std::string alike = names[i];
        for (std::size_t count = 2; !is_first[i]; ++count) {
            const std::string ending = "_" + std::to_string(count);
            names[i] = alike.substr(0, rules.longest - std::min(rules.longest, ending.size())) + ending;
            is_first[i] = taken.insert(names[i]).second;
        }
    }
    return names;
}

}  // namespace

NameRules word_rules() { return {.allows = is_of_words, .before_other_than_letters = "s"}; }

std::vector<std::string> distinct_names(std::span<const std::string> wanted, const NameRules& rules) {
    std::set<std::string> taken;
    return distinct_from(taken, wanted, rules);
}

MaterialNames name_materials(const Materials& materials, std::span<const std::string> names,
                             const NameRules& rules) {
    std::vector<std::string> wanted(names.begin(), names.end());
    for (const std::vector<SolidIndex>& solids : materials.solids)
        for (const SolidIndex solid : solids)
            while (wanted.size() <= solid) wanted.push_back("solid_" + std::to_string(wanted.size()));
    std::set<std::string> taken;
    MaterialNames result;
    result.solids = distinct_from(taken, wanted, rules);

    wanted = {"outside"};
    for (const std::vector<SolidIndex>& solids : materials.solids) {
        if (solids.size() < 2) continue;
        std::string& joined = wanted.emplace_back(result.solids[solids[0]]);
        for (std::size_t i = 1; i < solids.size(); ++i) joined += rules.joint + result.solids[solids[i]];
    }
    const std::vector<std::string> others = distinct_from(taken, wanted, rules);
    result.outside = others[0];
    std::size_t overlap = 1;
    for (const std::vector<SolidIndex>& solids : materials.solids)
        result.materials.push_back(solids.empty()       ? result.outside
                                   : solids.size() == 1 ? result.solids[solids[0]]
                                                        : others[overlap++]);
    return result;
}

}  // namespace octavo::mesh
