// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>

#include "exit_code.hpp"
#include "progress_bar.hpp"

// One run of the program: the options that every verb has, what the verb found, and how both are told. Data goes to
// stdout and messages to stderr; with --json, stdout carries exactly one object whatever happens, so data cannot go
// there too and `-o -` is refused beside it.

namespace octavo::cli {

using Json = nlohmann::ordered_json;

struct CommonOptions {
    bool json = false;
    bool quiet = false;
    int threads = 0;
    std::string progress = "auto";
    std::string color = "auto";
};

class Session {
  public:
    CommonOptions options;

    /// Name and inputs of the verb, for the JSON object.
    std::string command;
    std::vector<std::string> inputs;

    /// The files that it will write.
    std::vector<std::string> outputs;

    /// For each mesh that was read and has polygons: the polygon of each of its triangles. The library numbers
    /// triangles; an error whose place is in such a file is told with the faces of the file.
    std::map<std::string, std::vector<std::uint32_t>> polygon_of_triangle;

    /// What scripts rely on: the keys of the verb's result.
    Json result = Json::object();

    /// What people read instead of the result; ends with a newline, or is empty.
    std::string text;

    /// The verb wrote its data to stdout (`-o -`), so that nothing else may.
    bool stdout_taken = false;

    /// Runs `body`, and adds its wall time in seconds to the timings under `phase`.
    template <class Body>
    auto timed(const std::string& phase, Body&& body) {
        struct Stopwatch {
            Session& session;
            const std::string& phase;
            std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
            ~Stopwatch() {
                const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
                session.add_timing(phase, elapsed.count());
            }
        } stopwatch{*this, phase};
        return std::forward<Body>(body)();
    }

    void warn(std::string sentence) { warnings_.push_back(std::move(sentence)); }
    void warn(const std::vector<std::string>& sentences) {
        for (const std::string& sentence : sentences) warn(sentence);
    }

    /// An error for what is wrong with the command line itself rather than with a file: exit code 2.
    Error usage_error(std::string sentence);

    /// Threads, progress and how the work is stopped, for the library.
    Context context();

    /// Prints result, warnings and error as the options ask, and turns them into the exit code.
    int finish(Result<ExitCode> outcome);

  private:
    void add_timing(const std::string& phase, double seconds);
    Error in_words_of_users(Error error) const;
    ExitCode exit_code_of(const Result<ExitCode>& outcome) const;
    Json json_of(const Error& error) const;
    void print_messages(const Result<ExitCode>& outcome) const;
    /// What --json prints.
    std::string object_of(const Result<ExitCode>& outcome) const;

    Json timings_ = Json::object();
    std::vector<std::string> warnings_;
    bool usage_is_wrong_ = false;
    std::unique_ptr<ProgressBar> bar_;
};

}  // namespace octavo::cli
