// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include <octavo/base/counted.hpp>
#include <octavo/io/off.hpp>
#include <octavo/io/text_scanner.hpp>

namespace octavo::io {
namespace {

/// What the header word says.
struct Variant {
    bool texture = false, colour = false, normal = false, homogeneous = false, dimension = false;
};

/// The variant that a header word names, and how long that name is: in files of the ModelNet collection the
/// counts follow without a space ("OFF490 518 0").
struct HeaderWord {
    Variant variant;
    std::size_t size = 0;
};

std::optional<HeaderWord> header_word(std::string_view word) {
    std::string_view rest = word;
    Variant variant;
    const auto take = [&](std::string_view prefix) {
        if (!rest.starts_with(prefix)) return false;
        rest.remove_prefix(prefix.size());
        return true;
    };
    variant.texture = take("ST");
    variant.colour = take("C");
    variant.normal = take("N");
    variant.homogeneous = take("4");
    variant.dimension = take("n");
    if (!take("OFF") || (!rest.empty() && !(rest.front() >= '0' && rest.front() <= '9'))) return {};
    return HeaderWord{variant, word.size() - rest.size()};
}

/// Notes what files of this variant hold beside vertices and faces.
void note_what_is_left_behind(const Variant& variant, FileMesh& file) {
    if (variant.normal) file.leave_behind("normals");
    if (variant.colour) file.leave_behind("colours");
    if (variant.texture) file.leave_behind("texture coordinates");
}

std::string ignored_bytes(std::size_t count) {
    return counted(count, "byte after the last announced face is",
                   "bytes after the last announced face are") +
           " ignored";
}

Error not_three_dimensional() {
    return {ErrorCode::unsupported, "has vertices that are not of three dimensions", {}};
}

Error bad_index(std::uint64_t face, const std::string& index, std::size_t vertices) {
    return {ErrorCode::bad_input,
            "face " + std::to_string(face) + " names vertex " + index + " of " + std::to_string(vertices),
            {}};
}

class TextReader {
  public:
    TextReader(TextScanner scanner, Variant variant, const Context& context)
        : scanner_(scanner), variant_(variant), pace_(context, scanner.remaining() + 1) {}

    Result<FileMesh> read() {
        if (variant_.dimension) {
            const std::optional<std::uint64_t> dimension = count();
            if (!dimension) return expected("the dimension");
            if (*dimension != 3 || variant_.homogeneous) return not_three_dimensional();
        }
        const std::optional<std::uint64_t> vertices = count();
        if (!vertices) return expected("the number of vertices");
        const std::optional<std::uint64_t> faces = count();
        if (!faces) return expected("the number of faces");
        scanner_.skip_line();  // The number of edges means nothing and is often missing.

        // A vertex takes six characters at least, a face two.
        if (*vertices > scanner_.remaining() / 6 + 1 || *faces > scanner_.remaining() / 2 + 1)
            return scanner_.error_here("the header announces " + std::to_string(*vertices) +
                                       " vertices and " + std::to_string(*faces) +
                                       " faces, more than the file can hold");
        if (*vertices > 0xffffffffu) return Error{ErrorCode::limit, "has more than 4294967295 vertices", {}};
        result_.vertices.reserve(*vertices);
        result_.faces.reserve_triangles(*faces);
        for (std::uint64_t i = 0; i < *vertices; ++i) {
            if (const std::optional<Error> error = read_vertex()) return *error;
            if (!pace_.goes_on(scanner_.remaining())) return Context::cancelled_error();
        }
        for (std::uint64_t i = 0; i < *faces; ++i) {
            if (const std::optional<Error> error = read_face(i)) return *error;
            if (!pace_.goes_on(scanner_.remaining())) return Context::cancelled_error();
        }
        scanner_.skip_space_and_comments();
        if (!scanner_.at_end()) result_.warnings.push_back(ignored_bytes(scanner_.remaining()));
        note_what_is_left_behind(variant_, result_);
        return std::move(result_);
    }

  private:
    std::optional<std::uint64_t> count() {
        scanner_.skip_space_and_comments();
        return scanner_.count();
    }
    Error expected(const char* what) {
        return scanner_.error_here("expected " + std::string(what) + ", found " + scanner_.quoted());
    }

    /// Whether something other than a comment follows in this line.
    bool more_in_line() {
        scanner_.skip_blanks();
        return !scanner_.at_line_end() && scanner_.peek() != '#';
    }

    std::optional<Error> read_vertex() {
        Vec3 point;
        for (int axis = 0; axis < 3; ++axis) {
            scanner_.skip_space_and_comments();
            const char* const before = scanner_.position();
            const std::optional<double> value = scanner_.number();
            if (!value) return expected("a coordinate");
            if (!std::isfinite(*value))
                return scanner_.error_at(before, "a coordinate is not a finite number");
            point[axis] = *value;
        }
        if (variant_.homogeneous) {
            const char* const before = scanner_.position();
            const std::optional<double> weight = scanner_.number();
            if (!weight) return expected("a fourth coordinate");
            if (*weight != 1) {
                Error error = scanner_.error_at(before, "a fourth coordinate is not 1");
                error.code = ErrorCode::unsupported;
                return error;
            }
        }
        const bool announced = variant_.normal || variant_.colour || variant_.texture;
        if (!announced && more_in_line()) result_.leave_behind("numbers behind coordinates");
        scanner_.skip_line();
        result_.vertices.push_back(point);
        return {};
    }

    std::optional<Error> read_face(std::uint64_t face) {
        const std::optional<std::uint64_t> size = count();
        if (!size) return expected("the number of corners of a face");
        if (*size > scanner_.remaining() / 2 + 1)
            return scanner_.error_here("a face of " + std::to_string(*size) +
                                       " corners runs past the end of the file");
        corners_.clear();
        for (std::uint64_t i = 0; i < *size; ++i) {
            scanner_.skip_space_and_comments();
            const char* const before = scanner_.position();
            const std::optional<std::uint64_t> index = scanner_.count();
            if (!index) return expected("the index of a vertex");
            if (*index >= result_.vertices.size())
                return scanner_.error_at(
                    before, bad_index(face, std::to_string(*index), result_.vertices.size()).sentence);
            corners_.push_back(static_cast<mesh::VertexIndex>(*index));
        }
        if (more_in_line()) result_.leave_behind("colours");
        scanner_.skip_line();
        result_.faces.add(corners_);
        return {};
    }

    TextScanner scanner_;
    Variant variant_;
    ReadingPace pace_;
    FileMesh result_;
    std::vector<mesh::VertexIndex> corners_;
};

class BinaryReader {
  public:
    BinaryReader(Bytes bytes, std::size_t begin, Variant variant, const Context& context)
        : bytes_(bytes), at_(begin), variant_(variant), pace_(context, bytes.size()) {}

    Result<FileMesh> read() {
        if (variant_.dimension || variant_.homogeneous) return not_three_dimensional();
        if (words() < 3) return ends_early();
        const std::uint32_t vertices = integer(), faces = integer();
        integer();  // edges
        const std::size_t vertex_words =
            3 + (variant_.normal ? 3u : 0u) + (variant_.colour ? 4u : 0u) + (variant_.texture ? 2u : 0u);
        if (vertices > words() / vertex_words || faces > words())
            return error("the header announces " + std::to_string(vertices) + " vertices and " +
                         std::to_string(faces) + " faces, more than the file can hold");
        result_.vertices.reserve(vertices);
        for (std::uint32_t i = 0; i < vertices; ++i) {
            Vec3 point;
            for (int axis = 0; axis < 3; ++axis)
                point[axis] =
                    load<float, std::endian::big>(bytes_.data() + at_ + 4 * static_cast<std::size_t>(axis));
            if (!is_finite(point)) return error("a coordinate is not a finite number");
            at_ += 4 * vertex_words;
            result_.vertices.push_back(point);
        }
        for (std::uint32_t i = 0; i < faces; ++i) {
            if (const std::optional<Error> trouble = read_face(i)) return *trouble;
            if (!pace_.goes_on(bytes_.size() - at_)) return Context::cancelled_error();
        }
        if (at_ < bytes_.size()) result_.warnings.push_back(ignored_bytes(bytes_.size() - at_));
        note_what_is_left_behind(variant_, result_);
        return std::move(result_);
    }

  private:
    std::optional<Error> read_face(std::uint32_t face) {
        if (words() < 1) return ends_early();
        const std::uint32_t size = integer();
        if (size > words()) return ends_early();
        corners_.clear();
        for (std::uint32_t i = 0; i < size; ++i) {
            const std::uint32_t index = integer();
            if (index >= result_.vertices.size())
                return error(bad_index(face, std::to_string(index), result_.vertices.size()).sentence);
            corners_.push_back(index);
        }
        if (words() < 1) return ends_early();
        const std::uint32_t colours = integer();
        if (colours > words()) return ends_early();
        at_ += std::size_t{4} * colours;
        if (colours > 0) result_.leave_behind("colours");
        result_.faces.add(corners_);
        return {};
    }

    std::size_t words() const { return (bytes_.size() - at_) / 4; }
    std::uint32_t integer() {
        const auto value = load<std::uint32_t, std::endian::big>(bytes_.data() + at_);
        at_ += 4;
        return value;
    }
    Error error(std::string sentence) const {
        Place place;
        place.byte = at_;
        return {ErrorCode::bad_input, std::move(sentence), std::move(place)};
    }
    Error ends_early() const { return error("the file ends before the last face that the header announces"); }

    Bytes bytes_;
    std::size_t at_;
    Variant variant_;
    ReadingPace pace_;
    FileMesh result_;
    std::vector<mesh::VertexIndex> corners_;
};

}  // namespace

bool looks_like_off(Bytes bytes) {
    TextScanner scanner(text_of(bytes));
    scanner.skip_space_and_comments();
    return header_word(scanner.word()).has_value();
}

Result<FileMesh> read_off(Bytes bytes, const Context& context) {
    TextScanner scanner(text_of(bytes));
    scanner.skip_space_and_comments();
    const char* const begin = scanner.position();
    const std::optional<HeaderWord> word = header_word(scanner.word());
    if (!word) {
        // The header word is optional; then the counts come first.
        scanner.go_to(begin);
        if (!(scanner.peek() >= '0' && scanner.peek() <= '9'))
            return scanner.error_here("expected a header word like OFF or COFF, found " + scanner.quoted());
        return TextReader(scanner, {}, context).read();
    }
    scanner.go_to(begin + word->size);
    const TextScanner after_word = scanner;
    scanner.skip_blanks();
    if (!scanner.at_line_end() && scanner.word() == "BINARY") {
        scanner.skip_line();
        if (scanner.peek() == '\r') scanner.advance();
        if (scanner.peek() == '\n') scanner.advance();
        return BinaryReader(bytes, scanner.offset(), word->variant, context).read();
    }
    return TextReader(after_word, word->variant, context).read();
}

Result<WriteReport> write_off(Output& output, const mesh::Mesh& mesh, const WriteOptions&) {
    output.append("OFF\n");
    output.append_number(std::uint64_t{mesh.vertices.size()});
    output.append(' ');
    output.append_number(std::uint64_t{mesh.triangles.size()});
    output.append(" 0\n");
    for (const Vec3& vertex : mesh.vertices)
        for (int axis = 0; axis < 3; ++axis) {
            output.append_number(vertex[axis]);
            output.append(axis < 2 ? ' ' : '\n');
        }
    for (const mesh::Triangle& triangle : mesh.triangles) {
        output.append('3');
        for (const mesh::VertexIndex vertex : triangle)
            output.append(' '), output.append_number(std::uint64_t{vertex});
        output.append('\n');
    }
    return WriteReport{};
}

}  // namespace octavo::io
