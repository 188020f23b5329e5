// SPDX-License-Identifier: Apache-2.0
#include <optional>

#include <octavo/io/npy.hpp>
#include <octavo/io/text_scanner.hpp>

namespace octavo::io {
namespace {

constexpr std::string_view magic = "\x93NUMPY";

Error bad(std::size_t byte, std::string sentence) {
    Place place;
    place.byte = byte;
    return {ErrorCode::bad_input, std::move(sentence), std::move(place)};
}

Error unsupported(std::string sentence) { return {ErrorCode::unsupported, std::move(sentence), {}}; }

/// The text after `'key':` in the header's dictionary. NumPy writes the keys plainly and each once, so no parser
/// of Python is needed.
std::string_view value_of(std::string_view dictionary, std::string_view key) {
    for (const char quote : {'\'', '"'}) {
        const std::string quoted = quote + std::string(key) + quote;
        const std::size_t at = dictionary.find(quoted);
        if (at == std::string_view::npos) continue;
        TextScanner scanner(dictionary.substr(at + quoted.size()));
        scanner.skip_space();
        if (scanner.peek() != ':') continue;
        scanner.advance();
        scanner.skip_space();
        return {scanner.position(), scanner.remaining()};
    }
    return {};
}

/// The n of a shape "(n, 3)".
std::optional<std::uint64_t> rows_of(std::string_view shape) {
    std::uint64_t numbers[2]{};
    std::size_t at = 0;
    const auto skip = [&](char wanted) {
        while (at < shape.size() && shape[at] == ' ') ++at;
        if (at == shape.size() || shape[at] != wanted) return false;
        return ++at, true;
    };
    if (!skip('(')) return {};
    for (int i = 0; i < 2; ++i) {
        if (i == 1 && !skip(',')) return {};
        while (at < shape.size() && shape[at] == ' ') ++at;
        const std::size_t begin = at;
        for (; at < shape.size() && shape[at] >= '0' && shape[at] <= '9' && at - begin < 18; ++at)
            numbers[i] = 10 * numbers[i] + static_cast<std::uint64_t>(shape[at] - '0');
        if (at == begin) return {};
    }
    skip(',');
    if (!skip(')') || numbers[1] != 3) return {};
    return numbers[0];
}

/// Coordinate `axis` of row `row` stands at index 3 row + axis, or by columns in Fortran's order.
template <class T, std::endian order>
std::vector<Vec3> points_in(Bytes data, std::size_t rows, bool by_columns) {
    std::vector<Vec3> points(rows);
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::size_t index = by_columns ? axis * rows + row : 3 * row + axis;
            points[row][static_cast<int>(axis)] =
                static_cast<double>(load<T, order>(data.data() + index * sizeof(T)));
        }
    return points;
}

template <class T>
std::vector<Vec3> points_in(Bytes data, std::size_t rows, bool by_columns, char byte_order) {
    return byte_order == '>' ? points_in<T, std::endian::big>(data, rows, by_columns)
                             : points_in<T, std::endian::little>(data, rows, by_columns);
}

std::string_view type_of(const Column& column) {
    static constexpr std::string_view names[] = {"<f8", "<u4", "|i1"};
    return names[column.values.index()];
}

}  // namespace

Result<std::vector<Vec3>> read_npy_points(Bytes bytes) {
    if (bytes.size() < 10 || !text_of(bytes).starts_with(magic))
        return bad(0, "does not begin as an NPY file");
    const int version = std::to_integer<int>(bytes[6]);
    if (version < 1 || version > 3)
        return unsupported("is of version " + std::to_string(version) + " of NPY");
    const std::size_t begin = version == 1 ? 10 : 12;
    if (bytes.size() < begin) return bad(bytes.size(), "ends within its header");
    const std::size_t size =
        version == 1 ? load<std::uint16_t>(bytes.data() + 8) : load<std::uint32_t>(bytes.data() + 8);
    if (bytes.size() - begin < size) return bad(bytes.size(), "ends within its header");
    const std::string_view header = text_of(bytes).substr(begin, size);

    const std::string_view type = value_of(header, "descr");
    if (type.size() < 5 || (type[0] != '\'' && type[0] != '"'))
        return unsupported("holds records, not plain numbers");
    const std::string_view kind = type.substr(2, 2);
    const char byte_order = type[1];
    if (type[4] != type[0] || (byte_order != '<' && byte_order != '>'))
        return unsupported("holds numbers of a type that is no float or integer of 32 or 64 bits");
    const std::optional<std::uint64_t> rows = rows_of(value_of(header, "shape"));
    if (!rows) return bad(begin, "is no array of shape (n, 3)");
    const bool by_columns = value_of(header, "fortran_order").starts_with("True");

    const Bytes data = bytes.subspan(begin + size);
    const std::size_t width = kind.ends_with('8') ? 8 : 4;
    if (*rows > data.size() / (3 * width))
        return bad(bytes.size(), "announces " + std::to_string(*rows) + " points but the file ends after " +
                                     std::to_string(data.size() / (3 * width)));
    if (kind == "f8") return points_in<double>(data, *rows, by_columns, byte_order);
    if (kind == "f4") return points_in<float>(data, *rows, by_columns, byte_order);
    if (kind == "i8") return points_in<std::int64_t>(data, *rows, by_columns, byte_order);
    if (kind == "i4") return points_in<std::int32_t>(data, *rows, by_columns, byte_order);
    return unsupported("holds numbers of a type that is no float or integer of 32 or 64 bits");
}

void write_npy(Output& output, std::span<const Column> columns) {
    std::string type;
    if (columns.size() == 1) {
        type = "'" + std::string(type_of(columns[0])) + "'";
    } else {
        for (const Column& column : columns)
            type +=
                (type.empty() ? "[('" : ", ('") + column.name + "', '" + std::string(type_of(column)) + "')";
        type += "]";
    }
    const std::size_t rows = columns[0].size();
    std::string header =
        "{'descr': " + type + ", 'fortran_order': False, 'shape': (" + std::to_string(rows) + ",), }";
    // The array begins at a multiple of 64 bytes, the header ends with a line end.
    const std::size_t preamble = 10;
    header.resize((preamble + header.size() + 1 + 63) / 64 * 64 - preamble - 1, ' ');
    header += '\n';
    output.append(magic);
    output.append_binary(std::uint8_t{1});
    output.append_binary(std::uint8_t{0});
    output.append_binary(static_cast<std::uint16_t>(header.size()));
    output.append(header);
    for (std::size_t row = 0; row < rows; ++row)
        for (const Column& column : columns)
            std::visit([&](const auto& values) { output.append_binary(values[row]); }, column.values);
}

}  // namespace octavo::io
