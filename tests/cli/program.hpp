// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

// Runs the real program in a folder of its own, as a shell would. What takes the JSON library long to compile is in
// the source file.

namespace nlohmann {
/// For GoogleTest's messages.
void PrintTo(const json& value, std::ostream* out);
}  // namespace nlohmann

namespace octavo::tests {

struct Ran {
    int exit_code = -1;
    std::string out, err;

    /// What it wrote, parsed; discarded if that is not JSON.
    nlohmann::json json() const;
};

class ProgramTest : public testing::Test {
  protected:
    void SetUp() override;
    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    std::string write(const std::string& name, const std::string& content) const;
    std::string read(const std::string& name) const;

    /// `arguments` as typed in a shell, in the test's folder, without a terminal.
    Ran octavo(const std::string& arguments) const;
    /// A command for bash in which $octavo is the program.
    Ran shell(const std::string& command) const;

  private:
    /// `command` for the system's shell, in the folder.
    Ran run(const std::string& command) const;

    std::filesystem::path folder_;
};

}  // namespace octavo::tests
