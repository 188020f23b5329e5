// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/io/face_list.hpp>

// What the reader of one format hands to read.cpp, which makes meshes of it: the vertices and faces exactly
// as the file has them.

namespace octavo::io {

struct FileMesh {
    std::vector<Vec3> vertices;
    FaceList faces;
    /// The number in the file of each face; empty when face i is the file's i-th.
    std::vector<std::uint32_t> number_of_face;
    std::vector<std::string> warnings;
    std::vector<std::string> beside;  ///< files beside this one that it was read from too
    std::string unit;                 ///< name of the unit of length, when the file states one
    double millimetres_per_unit = 0;  ///< 0 when it does not

    /// Kinds of data that the file holds and a mesh has no place for, like "normals"; each once.
    std::vector<std::string> left_behind;

    void leave_behind(std::string_view kind) {
        if (std::find(left_behind.begin(), left_behind.end(), kind) == left_behind.end())
            left_behind.emplace_back(kind);
    }
};

/// The comment in the files that we write ourselves; that it is left behind is not worth a word.
inline constexpr std::string_view own_comment = "written by Octavo";

/// Tells the Context now and then how far a reader is, and learns whether to go on.
class ReadingPace {
  public:
    ReadingPace(const Context& context, std::size_t total) : context_(context), total_(total) {}

    /// Call it once a row with the bytes left; false when the caller asked to stop.
    bool goes_on(std::size_t remaining) {
        if ((++rows_ & row_mask) != 0) return true;
        context_.report("read", 1.0 - static_cast<double>(remaining) / static_cast<double>(total_));
        return !context_.cancelled();
    }

  private:
    // A row takes about 50 ns, so this is every few milliseconds.
    static constexpr std::size_t row_mask = (std::size_t{1} << 16) - 1;

    const Context& context_;
    std::size_t total_;
    std::size_t rows_ = 0;
};

}  // namespace octavo::io
