// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <octavo/base/result.hpp>

// A folder that appears whole or not at all, as Output does it for a file: it is filled under another name beside its
// place and renamed. What else is made on the way, folders above it or files near it, is removed again where it does
// not come to that.

namespace octavo::io {

class PartFolder {
  public:
    /// `place` is where it will be.
    explicit PartFolder(const std::filesystem::path& place);
    PartFolder(const PartFolder&) = delete;
    PartFolder& operator=(const PartFolder&) = delete;
    ~PartFolder();

    /// What to fill: a folder until commit().
    const std::filesystem::path& path() const { return path_; }

    /// Makes it, with the folders above. Error: io.
    Status make();

    /// Makes another folder, with those above, unless it is there. Error: io.
    Status make_folder(const std::filesystem::path& folder);
    /// Remembers a file that was made near it.
    void made(std::filesystem::path file) { made_.push_back(std::move(file)); }

    /// Puts the folder to its place, where a link is replaced and another folder gives way. Of that `replaces` says
    /// which names belong to the old content; whatever else is in it was put there by others and is moved over, and the
    /// names of these are returned, sorted. Error: io; then what was there still is.
    Result<std::vector<std::string>> commit(const std::function<bool(std::string_view name)>& replaces);

  private:
    Result<std::vector<std::string>> take_over(const std::filesystem::path& old,
                                               const std::function<bool(std::string_view)>& replaces);

    std::filesystem::path place_, path_;
    std::vector<std::filesystem::path> made_;  ///< in the order in which it was made
    bool is_in_place_ = false;
};

}  // namespace octavo::io
