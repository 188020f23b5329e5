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

/// Do both names lead to the same file, whether it is there yet or not?
bool is_same_file(const std::string& a, const std::string& b) {
    if (a == "-" || b == "-") return false;
    std::error_code ignored;
    if (std::filesystem::equivalent(a, b, ignored)) return true;
    const auto whole = [&](const std::string& path) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path, ignored), ignored);
    };
    return !whole(a).empty() && whole(a) == whole(b);
}

Error would_overwrite(Session& session, const std::string& output, const std::string& what) {
    Error error = session.usage_error(fmt::format("the output would overwrite {}; name another file", what));
    error.place.file = output;
    return error;
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

Status settle_further_output(Session& session, const std::vector<std::string>& inputs,
                             const std::string& output) {
    for (const std::string& input : inputs)
        if (is_same_file(input, output)) return would_overwrite(session, output, "the input");
    for (const std::string& other : session.outputs)
        if (is_same_file(other, output)) return would_overwrite(session, output, "the other output");
    session.outputs.push_back(output);
    return Done{};
}

Status check_files_of(Session& session, const std::string& model, const std::vector<std::string>& files) {
    for (const std::string& output : session.outputs)
        for (const std::string& file : files)
            if (is_same_file(file, output))
                return would_overwrite(session, output, fmt::format("a file that {} is read from", model));
    return Done{};
}

Result<std::string> settle_output(Session& session, const std::vector<std::string>& inputs,
                                  const std::string& output, const std::string& format,
                                  const OutputFormats& formats) {
    if (Status status = check_inputs(session, inputs); !status) return std::move(status).error();
    if (output.empty()) return std::string();
    if (Status further = settle_further_output(session, inputs, output); !further)
        return std::move(further).error();
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
