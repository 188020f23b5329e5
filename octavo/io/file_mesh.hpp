// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <octavo/base/context.hpp>
#include <octavo/io/face_list.hpp>

// What the reader of one format hands to read.cpp, which makes meshes of it: the vertices and faces exactly
// as the file has them.

namespace octavo::io {

struct FileMesh {
    std::vector<Vec3> vertices;
    FaceList faces;
    std::vector<std::string> warnings;
    std::string unit;                 ///< name of the unit of length, when the file states one
    double millimetres_per_unit = 0;  ///< 0 when it does not
};

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
