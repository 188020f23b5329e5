// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <places.hpp>
#include <sys/wait.h>

// Runs the real program in a folder of its own, as a shell would.

namespace octavo::tests {

struct Ran {
    int exit_code = -1;
    std::string out, err;

    nlohmann::json json() const { return nlohmann::json::parse(out, nullptr, false); }
};

class ProgramTest : public testing::Test {
  protected:
    void SetUp() override {
        const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() /
                  ("octavo-" + std::to_string(getpid()) + "-" + info->test_suite_name() + "-" + info->name());
        std::filesystem::create_directories(folder_);
    }
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    std::string write(const std::string& name, const std::string& content) const {
        std::ofstream(path(name), std::ios::binary) << content;
        return path(name);
    }
    std::string read(const std::string& name) const {
        std::ostringstream content;
        content << std::ifstream(path(name), std::ios::binary).rdbuf();
        return content.str();
    }

    /// `arguments` as typed in a shell, in the test's folder, without a terminal.
    Ran octavo(const std::string& arguments) const {
        const std::string command =
            "cd '" + folder_.string() + "' && " + program + " " + arguments + " >.out 2>.err </dev/null";
        const int status = std::system(command.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(".out"), read(".err")};
    }
    /// A command for bash in which $octavo is the program.
    Ran shell(const std::string& command) const {
        const std::string whole =
            "cd '" + folder_.string() + "' && octavo=" + program + " bash .command >.out 2>.err";
        write(".command", command);
        const int status = std::system(whole.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(".out"), read(".err")};
    }

  private:
    std::filesystem::path folder_;
};

}  // namespace octavo::tests
