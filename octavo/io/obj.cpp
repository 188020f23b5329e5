// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <optional>

#include <octavo/base/counted.hpp>
#include <octavo/io/obj.hpp>
#include <octavo/io/text_scanner.hpp>

namespace octavo::io {
namespace {

class ObjReader {
  public:
    ObjReader(std::string_view text, const Context& context)
        : text_(text), scanner_(text), pace_(context, text.size() + 1) {
        // A guess from below: a face and half a vertex in a hundred bytes.
        result_.vertices.reserve(text.size() / 200);
        result_.faces.reserve_triangles(text.size() / 100);
    }

    Result<FileMesh> read() {
        for (scanner_.skip_space(); !scanner_.at_end(); scanner_.skip_space()) {
            const std::string_view keyword = scanner_.word();
            std::optional<Error> error;
            if (keyword == "v") {
                error = read_vertex();
            } else if (keyword == "f" || keyword == "fo") {
                error = read_face();
            } else if (keyword == "curv" || keyword == "surf") {
                ++free_form_;
            } else {
                note_what_is_left_behind(keyword);
            }
            if (error) return *error;
            skip_line();
            if (!pace_.goes_on(scanner_.remaining())) return Context::cancelled_error();
        }
        if (greatest_ >= result_.vertices.size() && greatest_at_) {
            return scanner_.error_at(greatest_at_, "the face names vertex " + std::to_string(greatest_ + 1) +
                                                       " of " + std::to_string(result_.vertices.size()));
        }
        if (is_no_obj_ && result_.vertices.empty() && result_.faces.size() == 0)
            return Error{ErrorCode::bad_input, "has no vertices, but statements that are none of OBJ", {}};
        if (free_form_ > 0)
            result_.warnings.push_back(
                counted(free_form_, "free-form curve or surface is", "free-form curves and surfaces are") +
                " left out");
        return std::move(result_);
    }

  private:
    /// Skips blanks, and line ends behind a backslash.
    void skip_blanks() {
        for (;;) {
            scanner_.skip_blanks();
            if (scanner_.peek() != '\\') return;
            const char* const before = scanner_.position();
            scanner_.advance();
            scanner_.skip_blanks();
            if (!scanner_.at_line_end()) return scanner_.go_to(before);
            skip_line_end();
        }
    }
    void skip_line_end() {
        if (scanner_.peek() == '\r') scanner_.advance();
        if (scanner_.peek() == '\n') scanner_.advance();
    }
    void skip_line() {
        for (;;) {
            const char* const begin = scanner_.position();
            scanner_.skip_line();
            const char* last = scanner_.position();
            while (last != begin && TextScanner::is_space(last[-1])) --last;
            if (last == begin || last[-1] != '\\' || scanner_.at_end()) return;
            skip_line_end();
        }
    }

    void note_what_is_left_behind(std::string_view keyword) {
        struct Statement {
            std::string_view keyword, kind;
        };
        static constexpr Statement statements[] = {{"vn", "normals"},
                                                   {"vt", "texture coordinates"},
                                                   {"mtllib", "materials"},
                                                   {"usemtl", "materials"},
                                                   {"o", "objects"},
                                                   {"g", "groups"},
                                                   {"s", "smoothing groups"},
                                                   {"l", "lines"},
                                                   {"p", "points"}};
        TextScanner ahead = scanner_;
        if (keyword.front() == '#') {
            if (keyword != "#" || ahead.rest_of_line() != own_comment) result_.leave_behind("comments");
            return;
        }
        if (keyword == "s") {
            const std::string_view group = ahead.rest_of_line();
            if (group == "off" || group == "0") return;
        }
        for (const Statement& statement : statements)
            if (statement.keyword == keyword) return result_.leave_behind(statement.kind);
        is_no_obj_ = true;
        result_.leave_behind("other statements");
    }

    /// Behind the coordinates: one number is a weight, three are a colour.
    void note_more_numbers() {
        skip_blanks();
        if (scanner_.at_line_end() || scanner_.peek() == '#') return;
        TextScanner rest = scanner_;
        rest.word();
        rest.skip_blanks();
        result_.leave_behind(rest.at_line_end() ? "weights" : "colours");
    }

    std::optional<Error> read_vertex() {
        Vec3 point;
        for (int axis = 0; axis < 3; ++axis) {
            skip_blanks();
            const char* const before = scanner_.position();
            const std::optional<double> value =
                scanner_.at_line_end() ? std::optional<double>{} : scanner_.number();
            if (!value) return scanner_.error_at(before, "a vertex needs three numbers");
            if (!std::isfinite(*value))
                return scanner_.error_at(before, "a coordinate is not a finite number");
            point[axis] = *value;
        }
        if (result_.vertices.size() == 0xffffffffu)
            return Error{ErrorCode::limit, "has more than 4294967295 vertices", {}};
        result_.vertices.push_back(point);
        note_more_numbers();
        return {};
    }

    std::optional<Error> read_face() {
        corners_.clear();
        for (skip_blanks(); !scanner_.at_line_end() && scanner_.peek() != '#'; skip_blanks()) {
            const char* const before = scanner_.position();
            const bool backwards = scanner_.peek() == '-';
            if (backwards) scanner_.advance();
            std::uint64_t index = 0;
            const char* const digits = scanner_.position();
            for (; scanner_.peek() >= '0' && scanner_.peek() <= '9'; scanner_.advance())
                if (index <= 0xffffffffu)
                    index = 10 * index + static_cast<std::uint64_t>(scanner_.peek() - '0');
            const std::string_view number(before, static_cast<std::size_t>(scanner_.position() - before));
            // What follows a slash numbers texture coordinates and normals.
            const char end = scanner_.peek();
            if (scanner_.position() == digits || (end != '/' && end != '\\' && !TextScanner::is_space(end))) {
                scanner_.go_to(before);
                return scanner_.error_here("expected the number of a vertex, found " + scanner_.quoted());
            }
            while (!TextScanner::is_space(scanner_.peek()) && scanner_.peek() != '\\') scanner_.advance();
            const std::uint64_t vertices = result_.vertices.size();
            if (index == 0 || (backwards && index > vertices) || index > 0xffffffffu)
                return scanner_.error_at(before, "the face names vertex " + std::string(number) + " of " +
                                                     std::to_string(vertices));
            corners_.push_back(static_cast<mesh::VertexIndex>(backwards ? vertices - index : index - 1));
            // Vertices may follow the faces that use them, so the end of the file judges the greatest.
            if (corners_.back() > greatest_ || !greatest_at_) {
                greatest_ = corners_.back();
                greatest_at_ = before;
            }
        }
        result_.faces.add(corners_);
        return {};
    }

    std::string_view text_;
    TextScanner scanner_;
    ReadingPace pace_;
    FileMesh result_;
    std::vector<mesh::VertexIndex> corners_;
    bool is_no_obj_ = false;             ///< there are statements that are not known
    mesh::VertexIndex greatest_ = 0;     ///< the greatest vertex that a face names
    const char* greatest_at_ = nullptr;  ///< where
    std::size_t free_form_ = 0;
};

}  // namespace

Result<FileMesh> read_obj(Bytes bytes, const Context& context) {
    return ObjReader(text_of(bytes), context).read();
}

Result<WriteReport> write_obj(Output& output, const mesh::Mesh& mesh, const WriteOptions&) {
    output.append("# " + std::string(own_comment) + '\n');
    for (const Vec3& vertex : mesh.vertices) {
        output.append('v');
        for (int axis = 0; axis < 3; ++axis) output.append(' '), output.append_number(vertex[axis]);
        output.append('\n');
    }
    for (const mesh::Triangle& triangle : mesh.triangles) {
        output.append('f');
        for (const mesh::VertexIndex vertex : triangle)
            output.append(' '), output.append_number(std::uint64_t{vertex} + 1);
        output.append('\n');
    }
    return WriteReport{};
}

}  // namespace octavo::io
