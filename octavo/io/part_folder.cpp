// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <system_error>
#include <utility>

#include <unistd.h>

#include <octavo/io/part_folder.hpp>

namespace octavo::io {
namespace {

namespace fs = std::filesystem;

Error trouble(const fs::path& path, const std::string& reason) {
    Error error{ErrorCode::io, "cannot be written: " + reason, {}};
    error.place.file = path.string();
    return error;
}

fs::path with_ending(fs::path path, const std::string& ending) { return path += ending; }

}  // namespace

PartFolder::PartFolder(const fs::path& place)
    : place_(place), path_(with_ending(place_, "." + std::to_string(::getpid()) + ".part")) {}

PartFolder::~PartFolder() {
    if (is_in_place_) return;
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    std::reverse(made_.begin(), made_.end());
    for (const fs::path& path : made_) fs::remove(path, ignored);  // fails where others wrote meanwhile
}

Status PartFolder::make() {
    if (Status above = make_folder(path_.parent_path()); !above) return above;
    std::error_code code;
    fs::create_directory(path_, code);
    if (code) return trouble(path_, code.message());
    return Done{};
}

Status PartFolder::make_folder(const fs::path& folder) {
    std::vector<fs::path> missing;
    std::error_code code;
    for (fs::path above = folder; !above.empty() && !fs::exists(above, code); above = above.parent_path())
        missing.push_back(above);
    std::reverse(missing.begin(), missing.end());
    for (const fs::path& path : missing) {
        fs::create_directory(path, code);
        if (code) return trouble(path, code.message());
        made_.push_back(path);
    }
    return Done{};
}

Result<std::vector<std::string>> PartFolder::commit(
    const std::function<bool(std::string_view name)>& replaces) {
    std::error_code code, ignored;
    const fs::file_status there = fs::symlink_status(place_, ignored);
    const bool is_taken = fs::exists(there);
    if (is_taken && !fs::is_directory(there) && !fs::is_symlink(there))
        return trouble(place_, "it is a file, not a folder");
    const fs::path old = with_ending(path_, ".old");
    if (is_taken) fs::rename(place_, old, code);
    if (code) return trouble(place_, code.message());
    fs::rename(path_, place_, code);
    if (code) {
        if (is_taken) fs::rename(old, place_, ignored);
        return trouble(place_, code.message());
    }
    is_in_place_ = true;
    return is_taken ? take_over(old, replaces) : std::vector<std::string>();
}

Result<std::vector<std::string>> PartFolder::take_over(
    const fs::path& old, const std::function<bool(std::string_view)>& replaces) {
    std::vector<std::string> names;
    std::error_code code;
    if (fs::is_symlink(fs::symlink_status(old, code))) {
        fs::remove(old, code);
        return names;
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(old, code))
        if (std::string name = entry.path().filename().string(); !replaces(name))
            names.push_back(std::move(name));
    std::sort(names.begin(), names.end());
    for (const std::string& name : names)
        if (!code) fs::rename(old / name, place_ / name, code);
    if (code) return trouble(old, "what others put beside the old content stays there: " + code.message());
    fs::remove_all(old, code);
    return names;
}

}  // namespace octavo::io
