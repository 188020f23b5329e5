// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <fmt/format.h>

#include "definitions.hpp"
#include "program.hpp"

// `octavo man` prints the man page, octavo(1), made from the program's own definitions.

namespace octavo::cli {
namespace {

/// Text as roff: backslashes and dashes kept, a leading dot or quote not taken for a request.
std::string roff(const std::string& text) {
    std::string result;
    for (const char c : text) {
        if (c == '\\') {
            result += "\\e";
        } else if (c == '-') {
            result += "\\-";
        } else {
            result += c;
        }
        if (c == '\n') result += "\\&";
    }
    return "\\&" + result;
}

std::string roff_names(const OptionDefinition& option) {
    std::string names;
    for (const std::string& name : option.names)
        names += (names.empty() ? "" : ", ") + ("\\fB" + roff(name) + "\\fR");
    if (!option.value.empty()) names += " \\fI" + roff(option.value) + "\\fR";
    return names;
}

std::string roff_options(const std::vector<OptionDefinition>& options) {
    std::string text;
    for (const OptionDefinition& one : options)
        text += fmt::format(".TP\n{}\n{}\n", roff_names(one), roff(one.description));
    return text;
}

/// Without the options that every verb has, which are told once.
std::string roff_verb(VerbDefinition verb) {
    const auto is_for_all = [](const OptionDefinition& one) {
        return one.common || std::count(one.names.begin(), one.names.end(), "--help") > 0;
    };
    verb.options.erase(std::remove_if(verb.options.begin(), verb.options.end(), is_for_all),
                       verb.options.end());
    std::string text =
        fmt::format(".SS \"octavo {}\"\n{}.\n.PP\n.B octavo {}\n", verb.name, roff(verb.summary), verb.name);
    for (const OptionDefinition& one : verb.positionals)
        text += (one.required ? ".I " : "[\\fI") + roff(one.positional) + (one.required ? "\n" : "\\fR]\n");
    for (const OptionDefinition& one : verb.options)
        if (one.required) text += "\\fB" + roff(one.names.back()) + "\\fR \\fI" + roff(one.value) + "\\fR\n";
    text += "[\\fIoptions\\fR]\n";
    for (const OptionDefinition& one : verb.positionals)
        text += fmt::format(".TP\n.I {}\n{}\n", roff(one.positional), roff(one.description));
    return text + roff_options(verb.options);
}

std::string man_page(const Program& program) {
    std::string page = fmt::format(
        ".TH OCTAVO 1 \"\" \"octavo {}\" \"User commands\"\n"
        ".SH NAME\noctavo \\- exact solid modelling on octrees\n"
        ".SH SYNOPSIS\n.B octavo\n.I VERB\n[\\fIinput\\fR ...] [\\fB\\-o\\fR \\fIoutput\\fR] "
        "[\\fIoptions\\fR]\n"
        ".SH DESCRIPTION\nOctavo reads solids (triangle and polygon meshes, OpenSCAD .csg trees, octrees), "
        "checks and "
        "repairs them, turns them into exact octrees and answers questions about them. Every geometric "
        "decision is made "
        "in exact integer arithmetic.\n.SH VERBS\n",
        OCTAVO_VERSION);
    for (const VerbDefinition& verb : definitions_of(program.app())) page += roff_verb(verb);
    page += ".SH COMMON OPTIONS\nThey may also stand before the verb.\n" +
            roff_options(common_definitions(program.app()));
    page += ".SH NOTES\n.nf\n" + roff(program.notes()) + "\n.fi\n";
    return page;
}

}  // namespace

void add_man(Program& program) {
    program.verb("man", "Setting up", "Print the man page, octavo(1), as roff", [&program](Session& session) {
        session.text = man_page(program);
        session.result = {{"page", session.text}};
        return ExitCode::ok;
    });
}

}  // namespace octavo::cli
