// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <variant>

#include <octavo/base/context.hpp>
#include <octavo/base/result.hpp>
#include <octavo/io/write.hpp>

// Writes answers to queries: named columns of one length, a row for each point that was asked about.
//
//   csv   a line of names, then the rows; numbers as shortest decimals
//   npy   one column: a plain array; several: an array of records, a['distance'] in NumPy
//   ply   binary, an element `vertex` with a property for each column

namespace octavo::io {

struct Column {
    std::string name;
    std::variant<std::span<const double>, std::span<const std::uint32_t>, std::span<const std::int8_t>>
        values;

    std::size_t size() const {
        return std::visit([](const auto& span) { return span.size(); }, values);
    }
};

/// Writes to the file `path`, or to standard output when it is "-". `options.format` is "csv", "npy", "ply" or
/// empty: by extension, and csv for standard output. All columns have one length. Fails as write_mesh does.
Result<WriteReport> write_columns(const std::string& path, std::span<const Column> columns,
                                  const WriteOptions& options = {}, const Context& context = {});

/// The same into memory; `options.format` says what.
Result<WrittenBytes> write_columns(std::span<const Column> columns, const WriteOptions& options);

}  // namespace octavo::io
