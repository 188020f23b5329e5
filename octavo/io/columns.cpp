// SPDX-License-Identifier: Apache-2.0
#include <type_traits>

#include <octavo/io/columns.hpp>
#include <octavo/io/format.hpp>
#include <octavo/io/npy.hpp>
#include <octavo/io/output.hpp>

namespace octavo::io {
namespace {

void write_csv(Output& output, std::span<const Column> columns) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        if (i > 0) output.append(',');
        output.append(columns[i].name);
    }
    output.append('\n');
    const auto append = [&](const auto& values, std::size_t row) {
        using Value = typename std::remove_cvref_t<decltype(values)>::value_type;
        if constexpr (std::is_same_v<Value, std::uint32_t>) {
            output.append_number(std::uint64_t{values[row]});
        } else {
            output.append_number(static_cast<double>(values[row]));
        }
    };
    const std::size_t rows = columns[0].size();
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t i = 0; i < columns.size(); ++i) {
            std::visit([&](const auto& values) { append(values, row); }, columns[i].values);
            output.append(i + 1 < columns.size() ? ',' : '\n');
        }
}

void write_ply_columns(Output& output, std::span<const Column> columns) {
    static constexpr const char* types[] = {"double", "uint", "char"};
    const std::size_t rows = columns[0].size();
    output.append("ply\nformat binary_little_endian 1.0\ncomment written by Octavo\nelement vertex ");
    output.append_number(std::uint64_t{rows});
    for (const Column& column : columns)
        output.append(std::string("\nproperty ") + types[column.values.index()] + ' ' + column.name);
    output.append("\nend_header\n");
    for (std::size_t row = 0; row < rows; ++row)
        for (const Column& column : columns)
            std::visit([&](const auto& values) { output.append_binary(values[row]); }, column.values);
}

Result<WriteReport> write_to(Output& output, std::span<const Column> columns, const std::string& format) {
    OCTAVO_CHECK(!columns.empty(), "there is a column to write");
    for (const Column& column : columns)
        OCTAVO_CHECK(column.size() == columns[0].size(), "all columns have one length");
    if (format == "csv" || format == "txt") {
        write_csv(output, columns);
    } else if (format == "npy") {
        write_npy(output, columns);
    } else if (format == "ply") {
        write_ply_columns(output, columns);
    } else {
        return Error{ErrorCode::unsupported,
                     "cannot write the format \"" + format + "\"; Octavo writes tables as csv, npy, ply",
                     {}};
    }
    WriteReport report;
    report.format = format;
    report.bytes = output.size();
    return report;
}

}  // namespace

Result<WriteReport> write_columns(const std::string& path, std::span<const Column> columns,
                                  const WriteOptions& options, const Context& context) {
    std::string format = options.format;
    if (format.empty()) format = path == "-" ? "csv" : extension_of(path);
    Result<Output> output = Output::to_file(path, context);
    if (!output) return output.error();
    Result<WriteReport> report = write_to(*output, columns, format);
    if (!report) {
        Error error = std::move(report).error();
        error.place.file = path;
        return error;
    }
    if (context.cancelled()) return Context::cancelled_error();
    if (Status status = output->commit(); !status) return status.error();
    return report;
}

Result<WrittenBytes> write_columns(std::span<const Column> columns, const WriteOptions& options) {
    Output output = Output::to_memory();
    Result<WriteReport> report = write_to(output, columns, options.format);
    if (!report) return report.error();
    return WrittenBytes{std::move(output).take_memory(), std::move(*report)};
}

}  // namespace octavo::io
