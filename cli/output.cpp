// SPDX-License-Identifier: Apache-2.0
#include "output.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include <octavo/io/format.hpp>

namespace octavo::cli {
namespace {

std::vector<std::string> mesh_format_list() {
    std::vector<std::string> names;
    for (const io::Format& format : io::mesh_formats()) names.emplace_back(format.name);
    return names;
}

/// Do both names lead to the same existing file? Then writing would destroy the input.
bool is_same_file(const std::string& a, const std::string& b) {
    std::error_code ignored;
    return a != "-" && b != "-" && std::filesystem::equivalent(a, b, ignored);
}

}  // namespace

const OutputFormats& mesh_outputs() {
    static const OutputFormats formats{"meshes", mesh_format_list(), ""};
    return formats;
}

const OutputFormats& octree_outputs() {
    static const OutputFormats formats{"octrees", {"oct", "vtu", "htg"}, "oct"};
    return formats;
}

const OutputFormats& answer_outputs() {
    static const OutputFormats formats{"answers", {"csv", "txt", "npy", "ply"}, "csv"};
    return formats;
}

const OutputFormats& picture_outputs() {
    static const OutputFormats formats{"pictures", {"png", "svg", "pdf"}, "png"};
    return formats;
}

std::string one_of(const std::vector<std::string>& names) {
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i)
        list += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
    return list;
}

void add_to_option(Verb* verb, std::string& format, const OutputFormats& formats) {
    std::string words;
    for (const std::string& name : formats.names) words += (words.empty() ? "" : "|") + name;
    verb->add_option("--to", format, "Format of the output, instead of by its extension")->type_name(words);
}

Status check_inputs(Session& session, const std::vector<std::string>& inputs) {
    if (std::count(inputs.begin(), inputs.end(), "-") > 1)
        return session.usage_error("only one input can be -, because stdin is read once");
    return Done{};
}

Result<std::string> settle_output(Session& session, const std::vector<std::string>& inputs,
                                  const std::string& output, const std::string& format,
                                  const OutputFormats& formats) {
    if (Status status = check_inputs(session, inputs); !status) return std::move(status).error();
    if (output.empty()) return std::string();
    for (const std::string& input : inputs)
        if (is_same_file(input, output)) {
            Error error = session.usage_error("the output would overwrite the input; name another file");
            error.place.file = output;
            return error;
        }
    if (output == "-" && session.options.json)
        return session.usage_error(
            "--json prints its object on stdout, so the data cannot go there too; name a file");
    std::string name = io::extension_of("." + format);
    if (format.empty()) name = output == "-" ? formats.for_stdout : io::extension_of(output);
    if (std::find(formats.names.begin(), formats.names.end(), name) != formats.names.end()) return name;
    const std::string known = fmt::format("{} are written as {}", formats.things, one_of(formats.names));
    if (!format.empty()) return session.usage_error(fmt::format("{}, not as {}", known, format));
    if (output == "-")
        return session.usage_error(known + "; say which with --to, as stdout has no extension");
    return session.usage_error(fmt::format("{}, and the extension of {} is none of them", known, output));
}

}  // namespace octavo::cli
