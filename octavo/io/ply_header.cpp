// SPDX-License-Identifier: Apache-2.0
#include <unordered_set>

#include <octavo/io/file_mesh.hpp>
#include <octavo/io/ply_header.hpp>
#include <octavo/io/text_scanner.hpp>

namespace octavo::io {
namespace {

std::optional<PlyType> type_named(std::string_view name) {
    struct Name {
        std::string_view text;
        PlyType type;
    };
    static constexpr Name names[] = {
        {"char", PlyType::int8},      {"int8", PlyType::int8},       {"uchar", PlyType::uint8},
        {"uint8", PlyType::uint8},    {"short", PlyType::int16},     {"int16", PlyType::int16},
        {"ushort", PlyType::uint16},  {"uint16", PlyType::uint16},   {"int", PlyType::int32},
        {"int32", PlyType::int32},    {"uint", PlyType::uint32},     {"uint32", PlyType::uint32},
        {"float", PlyType::float32},  {"float32", PlyType::float32}, {"double", PlyType::float64},
        {"float64", PlyType::float64}};
    for (const Name& candidate : names)
        if (candidate.text == name) return candidate.type;
    return {};
}

/// Reads line by line; every line is a keyword and words.
class HeaderReader {
  public:
    explicit HeaderReader(Bytes bytes) : bytes_(bytes), scanner_(text_of(bytes)) {}

    Result<PlyHeader> read() {
        if (scanner_.word() != "ply")
            return scanner_.error_at(scanner_.position(), "does not begin with \"ply\"");
        // A lone CR after "ply" says that the header's lines end so; then an LF after it belongs to the body.
        const bool lone_cr =
            scanner_.peek() == '\r' && !text_of(bytes_).substr(scanner_.offset()).starts_with("\r\n");
        bool has_format = false;
        for (;;) {
            scanner_.skip_space();
            const std::string_view keyword = scanner_.word();
            line_ = keyword.data();
            if (keyword.empty()) return error("the header does not end with \"end_header\"");
            if (keyword == "end_header") break;
            std::optional<Error> trouble;
            if (keyword == "format") {
                has_format = true;
                trouble = read_format();
            } else if (keyword == "element") {
                trouble = read_element();
            } else if (keyword == "property") {
                trouble = read_property();
            } else if (keyword == "comment" || keyword == "obj_info") {
                if (scanner_.rest_of_line() != own_comment) header_.has_comments = true;
            } else {
                scanner_.go_to(line_);
                return error("the header holds the unknown word " + scanner_.quoted());
            }
            if (trouble) return *trouble;
            scanner_.skip_line();
        }
        if (!has_format) return error("the header names no format");
        scanner_.skip_line();
        if (scanner_.peek() == '\r' && scanner_.remaining() > 0) scanner_.advance();
        if (!lone_cr && scanner_.peek() == '\n') scanner_.advance();
        header_.size = scanner_.offset();
        return std::move(header_);
    }

  private:
    /// An error in this line.
    Error error(std::string sentence) const { return scanner_.error_at(line_, std::move(sentence)); }

    /// The next word of this line.
    std::string_view word_in_line() {
        scanner_.skip_blanks();
        return scanner_.at_line_end() ? std::string_view{} : scanner_.word();
    }

    std::optional<Error> read_format() {
        const std::string_view name = word_in_line();
        if (name == "ascii") {
            header_.encoding = PlyEncoding::ascii;
        } else if (name == "binary_little_endian") {
            header_.encoding = PlyEncoding::little_endian;
        } else if (name == "binary_big_endian") {
            header_.encoding = PlyEncoding::big_endian;
        } else {
            return error("the format is none of ascii, binary_little_endian and binary_big_endian");
        }
        return {};
    }

    std::optional<Error> read_element() {
        PlyElement element;
        element.name = word_in_line();
        scanner_.skip_blanks();
        const std::optional<std::uint64_t> count =
            scanner_.at_line_end() ? std::optional<std::uint64_t>{} : scanner_.count();
        if (element.name.empty() || !count) return error("an element needs a name and a count");
        if (!elements_.insert(element.name).second)
            return error("the element " + element.name + " is announced twice");
        properties_.clear();
        element.count = *count;
        header_.elements.push_back(std::move(element));
        return {};
    }

    std::optional<Error> read_property() {
        if (header_.elements.empty()) return error("a property stands before any element");
        PlyProperty property;
        std::string_view type_name = word_in_line();
        if (type_name == "list") {
            const std::string_view count_name = word_in_line();
            property.count_type = type_named(count_name);
            if (!property.count_type) return unknown_type(count_name);
            type_name = word_in_line();
        }
        const std::optional<PlyType> type = type_named(type_name);
        if (!type) return unknown_type(type_name);
        property.type = *type;
        property.name = word_in_line();
        if (property.name.empty()) return error("a property has no name");
        if (!properties_.insert(property.name).second)
            return error("the property " + property.name + " of the element " + header_.elements.back().name +
                         " is announced twice");
        header_.elements.back().properties.push_back(std::move(property));
        return {};
    }

    Error unknown_type(std::string_view name) {
        return error("a property has the unknown type \"" + std::string(name.substr(0, 32)) + '"');
    }

    Bytes bytes_;
    TextScanner scanner_;
    const char* line_ = nullptr;  ///< its keyword
    PlyHeader header_;
    // What was announced so far; of properties those of the last element.
    std::unordered_set<std::string> elements_, properties_;
};

}  // namespace

std::size_t size_of(PlyType type) {
    switch (type) {
        case PlyType::int8:
        case PlyType::uint8:
            return 1;
        case PlyType::int16:
        case PlyType::uint16:
            return 2;
        case PlyType::int32:
        case PlyType::uint32:
        case PlyType::float32:
            return 4;
        case PlyType::float64:
            return 8;
    }
    return 0;
}

std::optional<std::size_t> PlyElement::scalar(std::string_view property) const {
    for (std::size_t i = 0; i < properties.size(); ++i)
        if (properties[i].name == property && !properties[i].count_type) return i;
    return {};
}

std::size_t PlyElement::least_row_size() const {
    std::size_t size = 0;
    for (const PlyProperty& property : properties)
        size += size_of(property.count_type.value_or(property.type));
    return size;
}

bool PlyElement::has_lists() const {
    for (const PlyProperty& property : properties)
        if (property.count_type) return true;
    return false;
}

const PlyElement* PlyHeader::element(std::string_view name) const {
    for (const PlyElement& candidate : elements)
        if (candidate.name == name) return &candidate;
    return nullptr;
}

Result<PlyHeader> read_ply_header(Bytes bytes) { return HeaderReader(bytes).read(); }

}  // namespace octavo::io
