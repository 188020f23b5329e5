// SPDX-License-Identifier: Apache-2.0
#include "session.hpp"

#include <algorithm>
#include <cstdlib>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

#include "file_faces.hpp"
#include "interruption.hpp"
#include "printable.hpp"
#include "standard_files.hpp"

namespace octavo::cli {
namespace {

bool is_set(const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value;
}

bool wants_color(const std::string& option, int file) {
    if (option != "auto") return option == "always";
    if (is_set("NO_COLOR")) return false;
    if (is_set("CLICOLOR_FORCE") || is_set("FORCE_COLOR")) return true;
    const char* terminal = std::getenv("TERM");
    return isatty(file) && !(terminal && std::string_view(terminal) == "dumb");
}

/// An option of the library under the name that it has here: max_nodes is --max-nodes.
std::string as_typed(std::string option) {
    std::replace(option.begin(), option.end(), '_', '-');
    return "--" + option;
}

ProgressStyle style_of(const CommonOptions& options) {
    if (options.quiet || options.progress == "none") return ProgressStyle::none;
    if (options.progress == "bar") return ProgressStyle::bar;
    if (options.progress == "plain") return ProgressStyle::plain;
    return isatty(STDERR_FILENO) ? ProgressStyle::bar : ProgressStyle::none;
}

}  // namespace

Context Session::context() {
    if (!bar_)
        bar_ = std::make_unique<ProgressBar>(style_of(options), wants_color(options.color, STDERR_FILENO));
    Context context;
    // More threads than cores are of no use, and oneTBB would say so on stderr.
    context.threads =
        std::min(options.threads, static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
    context.cancel = &interruption();
    context.on_progress = [bar = bar_.get()](std::string_view phase, double done) { bar->show(phase, done); };
    return context;
}

Error Session::usage_error(std::string sentence) {
    usage_is_wrong_ = true;
    return {ErrorCode::bad_input, std::move(sentence), {}};
}

void Session::add_timing(const std::string& phase, double seconds) {
    timings_[phase] = timings_.value(phase, 0.0) + seconds;
}

int Session::finish(Result<ExitCode> outcome) {
    if (bar_) bar_->clear();
    if (!outcome) outcome = in_words_of_users(outcome.error());
    print_messages(outcome);
    std::string data;
    if (options.json && !stdout_taken)
        data = object_of(outcome);
    else if (outcome && !stdout_taken && !options.quiet)
        data = printable(text, "\n\t");
    if (to_stdout(data)) return static_cast<int>(exit_code_of(outcome));
    to_stderr(interruption() ? "octavo: error: cancelled\n" : "octavo: cannot write to stdout\n");
    return static_cast<int>(interruption() ? exit_code_of_interruption() : ExitCode::bad_input);
}

Error Session::in_words_of_users(Error error) const {
    // What fails once the work was asked to stop, fails because of that: not every library knows of calls that were
    // interrupted.
    if (interruption()) return Context::cancelled_error();
    if (error.option) error.option = as_typed(std::move(*error.option));
    return with_faces_of_file(std::move(error), polygon_of_triangle);
}

ExitCode Session::exit_code_of(const Result<ExitCode>& outcome) const {
    if (outcome) return *outcome;
    if (outcome.error().code == ErrorCode::cancelled) return exit_code_of_interruption();
    return usage_is_wrong_ ? ExitCode::usage : cli::exit_code_of(outcome.error().code);
}

Json Session::json_of(const Error& error) const {
    Json json = {{"code", usage_is_wrong_ ? "usage" : name_of(error.code)}, {"message", error.sentence}};
    if (!error.place.file.empty()) json["file"] = error.place.file;
    if (error.place.line) json["line"] = error.place.line;
    if (error.place.column) json["column"] = error.place.column;
    if (error.place.byte != Place::no_byte) json["byte"] = error.place.byte;
    if (!error.place.faces.empty()) json["faces"] = error.place.faces;
    if (error.option) json["option"] = *error.option;
    return json;
}

void Session::print_messages(const Result<ExitCode>& outcome) const {
    const bool colored = wants_color(options.color, STDERR_FILENO);
    if (!options.quiet)
        for (const std::string& warning : warnings_)
            to_stderr(fmt::format("octavo: {}warning:{} {}\n", colored ? "\x1b[33m" : "",
                                  colored ? "\x1b[0m" : "", printable(warning)));
    if (!outcome)
        to_stderr(fmt::format("octavo: {}error:{} {}\n", colored ? "\x1b[31m" : "", colored ? "\x1b[0m" : "",
                              printable(outcome.error().describe())));
    if (usage_is_wrong_)
        to_stderr(fmt::format("Try: octavo {}--help\n", command.empty() ? "" : command + " "));
}

std::string Session::object_of(const Result<ExitCode>& outcome) const {
    Json object = {{"octavo", OCTAVO_VERSION}, {"command", command}, {"inputs", inputs}};
    if (outcome)
        object["result"] = result;
    else
        object["error"] = json_of(outcome.error());
    object["timings"] = timings_;
    object["warnings"] = warnings_;
    return object.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace octavo::cli
