// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <octavo/base/bytes.hpp>
#include <octavo/base/result.hpp>

// The header of a PLY file: what the body holds, in which order and types.

namespace octavo::io {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a value in a binary body.
std::size_t size_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type{};                     ///< of the value, or of each value of a list
    std::optional<PlyType> count_type;  ///< set for a list
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;

    /// Index of the scalar property `name`.
    std::optional<std::size_t> scalar(std::string_view property) const;
    /// Bytes that a row takes at least: exactly, when there are no lists.
    std::size_t least_row_size() const;
    bool has_lists() const;
};

enum class PlyEncoding : std::uint8_t { ascii, little_endian, big_endian };

struct PlyHeader {
    PlyEncoding encoding{};
    std::vector<PlyElement> elements;
    std::size_t size = 0;  ///< where the body begins
    bool has_comments = false;

    const PlyElement* element(std::string_view name) const;
};

/// Reads the header at the start of a file. Whether the counts are true is for the reader of the body to see.
Result<PlyHeader> read_ply_header(Bytes bytes);

}  // namespace octavo::io
