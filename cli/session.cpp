// SPDX-License-Identifier: Apache-2.0
#include "session.hpp"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>
#include <unistd.h>

#include "file_faces.hpp"
#include "to_stderr.hpp"

namespace octavo::cli {
namespace {

std::atomic<bool> interrupted{false};

/// The first Ctrl-C asks the work to stop; a second one, from an impatient user, ends the program at once.
extern "C" void on_interrupt(int) {
    interrupted.store(true, std::memory_order_relaxed);
    std::signal(SIGINT, SIG_DFL);
}

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
    std::signal(SIGINT, on_interrupt);
    if (!bar_)
        bar_ = std::make_unique<ProgressBar>(style_of(options), wants_color(options.color, STDERR_FILENO));
    Context context;
    context.threads = options.threads;
    context.cancel = &interrupted;
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
    if (options.json && !stdout_taken) {
        print_json(outcome);
    } else if (outcome && !stdout_taken && !options.quiet) {
        std::fwrite(text.data(), 1, text.size(), stdout);
    }
    // What does not fit the buffer is written before; that it failed is remembered, flushing then succeeds.
    if (std::fflush(stdout) != 0 || std::ferror(stdout)) {
        to_stderr("octavo: cannot write to stdout\n");
        return static_cast<int>(ExitCode::bad_input);
    }
    return static_cast<int>(exit_code_of(outcome));
}

Error Session::in_words_of_users(Error error) const {
    if (error.option) error.option = as_typed(std::move(*error.option));
    return with_faces_of_file(std::move(error), polygon_of_triangle);
}

ExitCode Session::exit_code_of(const Result<ExitCode>& outcome) const {
    if (outcome) return *outcome;
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
                                  colored ? "\x1b[0m" : "", warning));
    if (!outcome)
        to_stderr(fmt::format("octavo: {}error:{} {}\n", colored ? "\x1b[31m" : "", colored ? "\x1b[0m" : "",
                              outcome.error().describe()));
    if (usage_is_wrong_)
        to_stderr(fmt::format("Try: octavo {}--help\n", command.empty() ? "" : command + " "));
}

void Session::print_json(const Result<ExitCode>& outcome) const {
    Json object = {{"octavo", OCTAVO_VERSION}, {"command", command}, {"inputs", inputs}};
    if (outcome)
        object["result"] = result;
    else
        object["error"] = json_of(outcome.error());
    object["timings"] = timings_;
    object["warnings"] = warnings_;
    const std::string dumped = object.dump(2, ' ', false, Json::error_handler_t::replace);
    std::fwrite(dumped.data(), 1, dumped.size(), stdout);
    std::fputc('\n', stdout);
}

}  // namespace octavo::cli
