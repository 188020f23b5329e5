// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include <octavo/base/counted.hpp>
#include <octavo/io/ply.hpp>
#include <octavo/io/ply_header.hpp>
#include <octavo/io/text_scanner.hpp>

namespace octavo::io {
namespace {

/// The values of a text body.
class TextValues {
  public:
    TextValues(Bytes bytes, std::size_t begin) : scanner_(text_of(bytes)) {
        scanner_.go_to(text_of(bytes).data() + begin);
    }

    std::optional<double> next(PlyType) {
        scanner_.skip_space();
        last_ = scanner_.position();
        return scanner_.number();
    }
    bool skip(PlyType, std::uint64_t count) {
        for (; count > 0; --count)
            if (scanner_.word().empty()) return false;
        return true;
    }
    /// Whether `rows` rows can be there: every value takes a character and a space.
    bool has_room(std::uint64_t rows, const PlyElement& element) const {
        return rows <= (scanner_.remaining() + 1) / (2 * element.properties.size());
    }
    bool has_room(std::uint64_t values, PlyType) const { return values <= (scanner_.remaining() + 1) / 2; }
    std::size_t remaining() const { return scanner_.remaining(); }
    /// Bytes after the last value, less the space before them.
    std::size_t unread() {
        scanner_.skip_space();
        return scanner_.remaining();
    }
    /// An error about the value read last, and one about what follows.
    Error error(std::string sentence) const { return scanner_.error_at(last_, std::move(sentence)); }
    Error error_here(std::string sentence) { return scanner_.error_here(std::move(sentence)); }
    Error missing() {
        scanner_.skip_space();
        return error_here(scanner_.at_end()
                              ? "the file ends before the last element that the header announces"
                              : "expected a number, found " + scanner_.quoted());
    }

  private:
    TextScanner scanner_;
    const char* last_ = nullptr;
};

/// The values of a binary body.
template <std::endian order>
class BinaryValues {
  public:
    BinaryValues(Bytes bytes, std::size_t begin) : bytes_(bytes), at_(begin) {}

    std::optional<double> next(PlyType type) {
        if (remaining() < size_of(type)) return {};
        const std::byte* const from = bytes_.data() + at_;
        last_ = at_;
        at_ += size_of(type);
        switch (type) {
            case PlyType::int8:
                return load<std::int8_t, order>(from);
            case PlyType::uint8:
                return load<std::uint8_t, order>(from);
            case PlyType::int16:
                return load<std::int16_t, order>(from);
            case PlyType::uint16:
                return load<std::uint16_t, order>(from);
            case PlyType::int32:
                return load<std::int32_t, order>(from);
            case PlyType::uint32:
                return load<std::uint32_t, order>(from);
            case PlyType::float32:
                return load<float, order>(from);
            case PlyType::float64:
                return load<double, order>(from);
        }
        return {};
    }
    bool skip(PlyType type, std::uint64_t count) {
        if (!has_room(count, type)) return false;
        at_ += count * size_of(type);
        return true;
    }
    bool has_room(std::uint64_t rows, const PlyElement& element) const {
        return rows <= remaining() / element.least_row_size();
    }
    bool has_room(std::uint64_t values, PlyType type) const { return values <= remaining() / size_of(type); }
    std::size_t remaining() const { return bytes_.size() - at_; }
    std::size_t unread() const { return remaining(); }
    Error error(std::string sentence) const { return error_at(last_, std::move(sentence)); }
    Error error_here(std::string sentence) const { return error_at(at_, std::move(sentence)); }
    Error missing() const {
        return error_here("the file ends before the last element that the header announces");
    }

    template <class T>
    static T load_at(const std::byte* from) {
        return load<T, order>(from);
    }
    const std::byte* position() const { return bytes_.data() + at_; }
    void go_to(const std::byte* position) { at_ = static_cast<std::size_t>(position - bytes_.data()); }

  private:
    static Error error_at(std::size_t byte, std::string sentence) {
        Place place;
        place.byte = byte;
        return {ErrorCode::bad_input, std::move(sentence), std::move(place)};
    }

    Bytes bytes_;
    std::size_t at_;
    std::size_t last_ = 0;  ///< where the value read last began
};

/// What a row of an element gives.
enum class Role { vertex, face, strip, other };

Role role_of(const PlyElement& element) {
    if (element.name == "vertex") return Role::vertex;
    if (element.name == "face") return Role::face;
    return element.name == "tristrips" ? Role::strip : Role::other;
}

bool lists_corners(const PlyProperty& property) {
    return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
}

/// What a mesh does not hold of an element in this role: the kind of data, empty for what it does hold.
std::string_view kind_left_behind(Role role, const PlyProperty& property) {
    const auto is_among = [&](std::initializer_list<std::string_view> names) {
        return std::find(names.begin(), names.end(), property.name) != names.end();
    };
    if (role == Role::other) return {};
    if (role == Role::vertex && !property.count_type && is_among({"x", "y", "z"})) return {};
    if (role != Role::vertex && lists_corners(property)) return {};
    if (is_among({"nx", "ny", "nz"})) return "normals";
    if (is_among({"red", "green", "blue", "alpha", "r", "g", "b", "a", "diffuse_red", "diffuse_green",
                  "diffuse_blue"}))
        return "colours";
    if (is_among({"s", "t", "u", "v", "texture_u", "texture_v", "texcoord", "texnumber"}))
        return "texture coordinates";
    return role == Role::vertex ? "other properties of vertices" : "other properties of faces";
}

template <class Values>
class BodyReader {
  public:
    BodyReader(const PlyHeader& header, Values values, const Context& context, NonFinite non_finite)
        : header_(header), values_(values), pace_(context, values.remaining() + 1), non_finite_(non_finite) {}

    Result<FileMesh> read() {
        if (const PlyElement* vertices = header_.element("vertex")) vertex_count_ = vertices->count;
        if (vertex_count_ > 0xffffffffu)
            return Error{ErrorCode::limit, "has more than 4294967295 vertices", {}};
        for (const PlyElement& element : header_.elements) {
            if (element.count == 0) continue;
            // Rows without properties take no bytes, so any number of them fits the file. Only those of vertices
            // matter: faces may name them.
            if (element.properties.empty() && element.name != "vertex") continue;
            if (!element.properties.empty() && !values_.has_room(element.count, element))
                return values_.error_here("the header announces " + std::to_string(element.count) +
                                          " rows of " + element.name +
                                          ", more than the rest of the file can hold");
            if (const std::optional<Error> error = read_element(element)) return *error;
        }
        if (const std::size_t unread = values_.unread(); unread > 0)
            result_.warnings.push_back(counted(unread, "byte after the last announced element is",
                                               "bytes after the last announced element are") +
                                       " ignored");
        note_what_is_left_behind();
        return std::move(result_);
    }

  private:
    void note_what_is_left_behind() {
        for (const PlyElement& element : header_.elements) {
            if (element.count == 0 || element.properties.empty()) continue;
            const Role role = role_of(element);
            if (role == Role::other) result_.leave_behind("other elements");
            if (role == Role::strip) result_.leave_behind("triangle strips");
            for (const PlyProperty& property : element.properties)
                if (const std::string_view kind = kind_left_behind(role, property); !kind.empty())
                    result_.leave_behind(kind);
        }
        if (header_.has_comments) result_.leave_behind("comments");
    }

    std::optional<Error> read_element(const PlyElement& element) {
        const Role role = role_of(element);
        axis_of_.assign(element.properties.size(), -1);
        list_ = element.properties.size();
        if (role == Role::vertex) {
            for (int axis = 0; axis < 3; ++axis) {
                const char name[] = {static_cast<char>('x' + axis), '\0'};
                const std::optional<std::size_t> property = element.scalar(name);
                if (!property)
                    return values_.error_here(std::string("the vertices have no property ") + name);
                axis_of_[*property] = axis;
            }
            result_.vertices.reserve(element.count);
        } else if (role != Role::other) {
            for (std::size_t i = 0; i < element.properties.size(); ++i)
                if (lists_corners(element.properties[i])) list_ = i;
            if (list_ == element.properties.size())
                return values_.error_here("the element " + element.name + " has no list vertex_indices");
            if (role == Role::face) result_.faces.reserve_triangles(element.count);
        }
        std::uint64_t done = 0;
        if constexpr (!std::is_same_v<Values, TextValues>) {
            if (role == Role::vertex) done = read_plain_vertices(element);
            if (role == Role::face) done = read_plain_triangles(element);
        }
        for (; done < element.count; ++done) {
            if (const std::optional<Error> error = read_row(element, role)) return error;
            if (!pace_.goes_on(values_.remaining())) return Context::cancelled_error();
        }
        return {};
    }

    std::optional<Error> read_row(const PlyElement& element, Role role) {
        Vec3 point;
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (property.count_type) {
                if (const std::optional<Error> error = read_list(property, role, i == list_)) return error;
            } else if (axis_of_[i] < 0) {
                if (!values_.skip(property.type, 1)) return values_.missing();
            } else {
                const std::optional<double> value = values_.next(property.type);
                if (!value) return values_.missing();
                if (!std::isfinite(*value) && non_finite_ == NonFinite::refuse)
                    return values_.error("a coordinate of vertex " + std::to_string(result_.vertices.size()) +
                                         " is not a finite number");
                point[axis_of_[i]] = *value;
            }
        }
        if (role == Role::vertex) result_.vertices.push_back(point);
        if (role == Role::face) result_.faces.add(corners_);
        return {};
    }

    std::optional<Error> read_list(const PlyProperty& property, Role role, bool holds_corners) {
        const std::optional<double> count = values_.next(*property.count_type);
        if (!count) return values_.missing();
        if (!(*count >= 0 && *count == std::floor(*count)))
            return values_.error("the length " + number_text(*count) + " of a list is no whole number");
        // A double beyond 2^64 would not convert; 2^53 is beyond any file.
        const auto length = static_cast<std::uint64_t>(std::min(*count, 0x1p53));
        if (!values_.has_room(length, property.type))
            return values_.error("a list of " + number_text(*count) +
                                 " values runs past the end of the file");
        if (!holds_corners) {
            if (!values_.skip(property.type, length)) return values_.missing();
            return {};
        }
        corners_.clear();
        for (std::uint64_t i = 0; i < length; ++i) {
            const std::optional<double> index = values_.next(property.type);
            if (!index) return values_.missing();
            if (role == Role::strip && *index == -1) {
                add_strip();
                continue;
            }
            if (!(*index >= 0 && *index < static_cast<double>(vertex_count_) && *index == std::floor(*index)))
                return values_.error("face " + std::to_string(result_.faces.size()) + " names vertex " +
                                     number_text(*index) + " of " + std::to_string(vertex_count_));
            corners_.push_back(static_cast<mesh::VertexIndex>(*index));
        }
        if (role == Role::strip) add_strip();
        return {};
    }

    /// Every corner after the second makes a triangle with the two before it, each second one turned. Those
    /// with a repeated corner only lead from one strip to the next.
    void add_strip() {
        for (std::size_t i = 2; i < corners_.size(); ++i) {
            const mesh::VertexIndex a = corners_[i - 2], b = corners_[i - 1], c = corners_[i];
            if (a == b || b == c || c == a) continue;
            if (i % 2 == 0) {
                result_.faces.add_triangle(a, b, c);
            } else {
                result_.faces.add_triangle(b, a, c);
            }
        }
        corners_.clear();
    }

    /// The usual case, rows of scalars with x, y, z all float or all double, without a branch per property.
    /// Reads rows up to the first that needs care and returns their number.
    std::uint64_t read_plain_vertices(const PlyElement& element) {
        if (element.has_lists()) return 0;
        std::size_t offset = 0, offsets[3]{};
        PlyType types[3]{};
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            if (axis_of_[i] >= 0) {
                offsets[axis_of_[i]] = offset;
                types[axis_of_[i]] = element.properties[i].type;
            }
            offset += size_of(element.properties[i].type);
        }
        if (types[0] != types[1] || types[1] != types[2]) return 0;
        if (types[0] == PlyType::float32) return read_scalars<float>(element.count, offset, offsets);
        if (types[0] == PlyType::float64) return read_scalars<double>(element.count, offset, offsets);
        return 0;
    }

    template <class Real>
    std::uint64_t read_scalars(std::uint64_t count, std::size_t row_size, const std::size_t (&offsets)[3]) {
        const std::byte* row = values_.position();
        std::uint64_t done = 0;
        for (; done < count; ++done, row += row_size) {
            const Vec3 point{Values::template load_at<Real>(row + offsets[0]),
                             Values::template load_at<Real>(row + offsets[1]),
                             Values::template load_at<Real>(row + offsets[2])};
            if (!is_finite(point) && non_finite_ == NonFinite::refuse) break;
            result_.vertices.push_back(point);
        }
        values_.go_to(row);
        return done;
    }

    /// The usual case of faces: nothing but the list, with a byte that says three and 32-bit indices that are
    /// in range (a negative one is not, as unsigned). Reads rows up to the first other one.
    std::uint64_t read_plain_triangles(const PlyElement& element) {
        constexpr std::size_t row_size = 1 + 3 * sizeof(std::uint32_t);
        const PlyProperty& list = element.properties[0];
        if (element.properties.size() != 1 || !list.count_type || size_of(*list.count_type) != 1) return 0;
        if (list.type != PlyType::int32 && list.type != PlyType::uint32) return 0;
        const std::byte* row = values_.position();
        const std::uint64_t most = std::min<std::uint64_t>(element.count, values_.remaining() / row_size);
        std::uint64_t done = 0;
        for (; done < most && *row == std::byte{3}; ++done, row += row_size) {
            const auto a = Values::template load_at<std::uint32_t>(row + 1);
            const auto b = Values::template load_at<std::uint32_t>(row + 5);
            const auto c = Values::template load_at<std::uint32_t>(row + 9);
            if (a >= vertex_count_ || b >= vertex_count_ || c >= vertex_count_) break;
            result_.faces.add_triangle(a, b, c);
        }
        values_.go_to(row);
        return done;
    }

    const PlyHeader& header_;
    Values values_;
    ReadingPace pace_;
    NonFinite non_finite_;
    std::uint64_t vertex_count_ = 0;
    std::vector<int> axis_of_;  ///< of each property of the element: 0, 1, 2, or -1
    std::size_t list_ = 0;      ///< the property that lists corners
    std::vector<mesh::VertexIndex> corners_;
    FileMesh result_;
};

template <class Values>
Result<FileMesh> read_body(Bytes bytes, const PlyHeader& header, const Context& context,
                           NonFinite non_finite) {
    return BodyReader<Values>(header, Values(bytes, header.size), context, non_finite).read();
}

}  // namespace

Result<FileMesh> read_ply(Bytes bytes, const Context& context, NonFinite non_finite) {
    const Result<PlyHeader> header = read_ply_header(bytes);
    if (!header) return header.error();
    switch (header->encoding) {
        case PlyEncoding::ascii:
            return read_body<TextValues>(bytes, *header, context, non_finite);
        case PlyEncoding::little_endian:
            return read_body<BinaryValues<std::endian::little>>(bytes, *header, context, non_finite);
        case PlyEncoding::big_endian:
            return read_body<BinaryValues<std::endian::big>>(bytes, *header, context, non_finite);
    }
    return Error{ErrorCode::internal, "an encoding of PLY without a reader", {}};
}

}  // namespace octavo::io
