// SPDX-License-Identifier: Apache-2.0
#include "program.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include <places.hpp>
#include <sys/wait.h>
#include <unistd.h>

namespace nlohmann {

void PrintTo(const json& value, std::ostream* out) { *out << value.dump(); }

}  // namespace nlohmann

namespace octavo::tests {

nlohmann::json Ran::json() const { return nlohmann::json::parse(out, nullptr, false); }

void ProgramTest::SetUp() {
    const testing::TestInfo* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("octavo-" + std::to_string(getpid()) + "-" + info->test_suite_name() + "-" + info->name());
    std::filesystem::create_directories(folder_);
}

std::string ProgramTest::write(const std::string& name, const std::string& content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
}

std::string ProgramTest::read(const std::string& name) const {
    std::ostringstream content;
    content << std::ifstream(path(name), std::ios::binary).rdbuf();
    return content.str();
}

Ran ProgramTest::octavo(const std::string& arguments) const {
    return run(std::string(program) + " " + arguments + " >.out 2>.err </dev/null");
}

Ran ProgramTest::shell(const std::string& command) const {
    write(".command", command);
    return run("octavo=" + std::string(program) + " bash .command >.out 2>.err");
}

Ran ProgramTest::run(const std::string& command) const {
    const int status = std::system(("cd '" + folder_.string() + "' && " + command).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(".out"), read(".err")};
}

}  // namespace octavo::tests
