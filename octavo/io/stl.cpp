// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <optional>

#include <octavo/base/counted.hpp>
#include <octavo/io/stl.hpp>
#include <octavo/io/text_scanner.hpp>
#include <octavo/io/vertex_welder.hpp>

namespace octavo::io {
namespace {

constexpr std::size_t header_size = 84;
constexpr std::size_t facet_size = 50;
constexpr std::size_t most_facets = 0xffffffffu / 3;

Error error_at_byte(std::size_t byte, std::string sentence) {
    Place place;
    place.byte = byte;
    return {ErrorCode::bad_input, std::move(sentence), std::move(place)};
}

Error too_many_facets() { return {ErrorCode::limit, "has more than 1431655765 facets", {}}; }

// ---- binary

struct Corner {
    float x, y, z;
};

Corner corner_at(const std::byte* from) {
    return {load<float>(from), load<float>(from + 4), load<float>(from + 8)};
}

/// Welds the facets in blocks: all corners of a block are hashed, and their slots fetched, before the first
/// is looked up, so that the waits for memory overlap.
Result<FileMesh> read_binary(Bytes bytes, std::size_t facets, const Context& context) {
    constexpr std::size_t block = 16;
    FileMesh result;
    VertexWelder<float> welder(3 * facets);
    ReadingPace pace(context, bytes.size());
    std::vector<mesh::Triangle>& triangles = result.faces.triangles();
    triangles.resize(facets);
    unsigned attributes = 0;
    for (std::size_t first = 0; first < facets; first += block) {
        const std::size_t count = std::min(block, facets - first);
        VertexWelder<float>::Key keys[3 * block];
        for (std::size_t i = 0; i < 3 * count; ++i) {
            const std::size_t byte = header_size + (first + i / 3) * facet_size + 12 + (i % 3) * 12;
            const Corner corner = corner_at(bytes.data() + byte);
            if (!std::isfinite(corner.x) || !std::isfinite(corner.y) || !std::isfinite(corner.z))
                return error_at_byte(byte, "a coordinate is not a finite number");
            keys[i] = welder.prepare(corner.x, corner.y, corner.z);
        }
        for (std::size_t i = 0; i < count; ++i)
            triangles[first + i] = {welder.add(keys[3 * i]), welder.add(keys[3 * i + 1]),
                                    welder.add(keys[3 * i + 2])};
        for (std::size_t i = 0; i < count; ++i)
            attributes |= load<std::uint16_t>(bytes.data() + header_size + (first + i + 1) * facet_size - 2);
        if (!pace.goes_on(bytes.size() - header_size - first * facet_size)) return Context::cancelled_error();
    }
    if (attributes != 0) result.leave_behind("attribute bytes");
    result.vertices = welder.vertices();
    return result;
}

Result<FileMesh> read_binary(Bytes bytes, const Context& context) {
    if (bytes.size() < header_size)
        return error_at_byte(bytes.size(), "ends within the 84 bytes that begin a binary STL file");
    const std::size_t facets = load<std::uint32_t>(bytes.data() + 80);
    const std::size_t room = (bytes.size() - header_size) / facet_size;
    if (facets > room)
        return error_at_byte(bytes.size(), "the header announces " + std::to_string(facets) +
                                               " facets but the file ends after " + std::to_string(room));
    if (facets > most_facets) return too_many_facets();
    // Programs that write while they compute leave the count at 0 when they are stopped.
    if (facets == 0 && bytes.size() > header_size)
        return error_at_byte(header_size, "the header announces no facets, but more bytes follow");
    Result<FileMesh> result = read_binary(bytes, facets, context);
    const std::size_t used = header_size + facets * facet_size;
    if (result && used < bytes.size())
        result->warnings.push_back(counted(bytes.size() - used, "byte after the last announced facet is",
                                           "bytes after the last announced facet are") +
                                   " ignored");
    return result;
}

// ---- text

constexpr std::string_view own_name = "octavo";  ///< of the solids that we write

/// The grammar: any number of `solid NAME`, facets, `endsolid NAME`, each NAME to the end of its line. Some writers put
/// everything on one line: there a NAME goes to the next facet.
class TextReader {
  public:
    TextReader(std::string_view text, const Context& context)
        : scanner_(text), pace_(context, text.size()), welder_(text.size() / 80) {}

    Result<FileMesh> read() {
        if (!is("solid")) return unexpected("solid");
        read_name();
        bool inside = true;
        std::size_t facets = 0;
        for (;;) {
            const std::string_view word = scanner_.word();
            if (word.empty()) break;
            if (equals_ignoring_case(word, "facet")) {
                if (++facets > most_facets) return too_many_facets();
                if (const std::optional<Error> error = read_facet()) return *error;
                inside = true;
                if (!pace_.goes_on(scanner_.remaining())) return Context::cancelled_error();
            } else if (equals_ignoring_case(word, "endsolid") || equals_ignoring_case(word, "solid")) {
                inside = word.size() == 5;
                if (inside) result_.leave_behind("solids");
                read_name();
            } else {
                scanner_.go_to(word.data());
                return unexpected("facet");
            }
        }
        if (inside && facets == 0) return unexpected("facet");
        if (inside) result_.warnings.push_back("the last solid does not end with \"endsolid\"");
        result_.vertices = welder_.vertices();
        return std::move(result_);
    }

  private:
    void read_name() {
        TextScanner name = scanner_;
        for (name.skip_blanks(); !name.at_line_end(); name.skip_blanks()) {
            const std::string_view word = name.word();
            if (equals_ignoring_case(word, "facet") && facet_goes_on(name))
                return scanner_.go_to(word.data());
            // The name itself comes twice in most files and once in all.
            if (word != own_name) result_.leave_behind("names of solids");
        }
        scanner_.skip_line();
    }

    /// Whether `normal X Y Z outer loop` follows.
    static bool facet_goes_on(TextScanner ahead) {
        if (!equals_ignoring_case(ahead.word(), "normal")) return false;
        for (int i = 0; i < 3; ++i) ahead.word();
        return equals_ignoring_case(ahead.word(), "outer") && equals_ignoring_case(ahead.word(), "loop");
    }

    /// After the word `facet`: `normal X Y Z outer loop` three vertices `endloop endfacet`. The normal may
    /// be anything, nan too.
    std::optional<Error> read_facet() {
        if (!is("normal")) return unexpected("normal");
        for (int i = 0; i < 3; ++i) scanner_.word();
        if (!is("outer")) return unexpected("outer loop");
        if (!is("loop")) return unexpected("outer loop");
        mesh::Triangle triangle{};
        for (mesh::VertexIndex& corner : triangle) {
            if (!is("vertex")) return unexpected("vertex");
            double point[3];
            for (double& coordinate : point) {
                const char* const before = scanner_.position();
                const std::optional<double> value = scanner_.number();
                if (!value) return unexpected("a coordinate");
                if (!std::isfinite(*value)) {
                    scanner_.go_to(before);
                    return scanner_.error_here("a coordinate is not a finite number");
                }
                coordinate = *value;
            }
            corner = welder_.add(welder_.prepare(point[0], point[1], point[2]));
        }
        if (!is("endloop")) return unexpected("endloop");
        if (!is("endfacet")) return unexpected("endfacet");
        result_.faces.add_triangle(triangle[0], triangle[1], triangle[2]);
        return {};
    }

    /// Steps over `word` when it comes next.
    bool is(std::string_view word) {
        const std::string_view next = scanner_.word();
        if (next == word || equals_ignoring_case(next, word)) return true;
        scanner_.go_to(next.data());
        return false;
    }

    Error unexpected(const char* wanted) {
        return scanner_.error_here("expected " + std::string(wanted) + ", found " + scanner_.quoted());
    }

    TextScanner scanner_;
    ReadingPace pace_;
    VertexWelder<double> welder_;
    FileMesh result_;
};

bool is_binary(Bytes bytes) {
    if (bytes.size() >= header_size &&
        bytes.size() == header_size + facet_size * std::size_t{load<std::uint32_t>(bytes.data() + 80)})
        return true;
    TextScanner scanner(text_of(bytes));
    if (!equals_ignoring_case(scanner.word(), "solid")) return true;
    // A binary file of a wrong size whose header begins with "solid": text has no NUL so early.
    return text_of(bytes.first(std::min<std::size_t>(bytes.size(), header_size))).find('\0') !=
           std::string_view::npos;
}

// ---- writing

/// What rounding to floats does to a mesh.
struct Rounding {
    double largest = 0;
    std::size_t collapsed = 0;  ///< triangles that had three different corners and have no longer
};

Result<Rounding> rounding_to_floats(const mesh::Mesh& mesh) {
    Rounding rounding;
    for (const mesh::Triangle& triangle : mesh.triangles)
        for (const mesh::VertexIndex corner : triangle)
            for (int axis = 0; axis < 3; ++axis) {
                const double exact = mesh.vertices[corner][axis];
                const auto rounded = static_cast<float>(exact);
                if (!std::isfinite(rounded))
                    return Error{
                        ErrorCode::limit,
                        "the coordinate " + number_text(exact) + " does not fit the floats of binary STL",
                        {}};
                rounding.largest = std::max(rounding.largest, std::abs(double{rounded} - exact));
            }
    if (rounding.largest == 0) return rounding;
    const auto as_floats = [&](mesh::VertexIndex vertex) {
        const Vec3& p = mesh.vertices[vertex];
        return std::array{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
    };
    const auto collapses = [](const auto& a, const auto& b, const auto& c) {
        return a == b || b == c || c == a;
    };
    for (const mesh::Triangle& t : mesh.triangles)
        if (collapses(as_floats(t[0]), as_floats(t[1]), as_floats(t[2])) &&
            !collapses(mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]))
            ++rounding.collapsed;
    return rounding;
}

/// The unit normal, for the programs that want one; zero for a facet without area.
Vec3 normal_of(const mesh::Mesh& mesh, const mesh::Triangle& triangle) {
    const Vec3 a = mesh.vertices[triangle[0]];
    const Vec3 normal = cross(mesh.vertices[triangle[1]] - a, mesh.vertices[triangle[2]] - a);
    const double size = length(normal);
    return size > 0 && std::isfinite(size) ? (1 / size) * normal : Vec3{};
}

void write_binary(Output& output, const mesh::Mesh& mesh) {
    std::string header = "binary STL, written by Octavo";
    header.resize(header_size - 4, ' ');
    output.append(header);
    output.append_binary(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const mesh::Triangle& triangle : mesh.triangles) {
        const Vec3 normal = normal_of(mesh, triangle);
        for (int axis = 0; axis < 3; ++axis) output.append_binary(static_cast<float>(normal[axis]));
        for (const mesh::VertexIndex vertex : triangle)
            for (int axis = 0; axis < 3; ++axis)
                output.append_binary(static_cast<float>(mesh.vertices[vertex][axis]));
        output.append_binary(std::uint16_t{0});
    }
}

void write_text(Output& output, const mesh::Mesh& mesh) {
    const auto append_vector = [&](const Vec3& v) {
        for (int axis = 0; axis < 3; ++axis) output.append(' '), output.append_number(v[axis]);
        output.append('\n');
    };
    output.append("solid " + std::string(own_name) + '\n');
    for (const mesh::Triangle& triangle : mesh.triangles) {
        output.append("facet normal");
        append_vector(normal_of(mesh, triangle));
        output.append(" outer loop\n");
        for (const mesh::VertexIndex vertex : triangle) {
            output.append("  vertex");
            append_vector(mesh.vertices[vertex]);
        }
        output.append(" endloop\nendfacet\n");
    }
    output.append("endsolid " + std::string(own_name) + '\n');
}

}  // namespace

Result<FileMesh> read_stl(Bytes bytes, const Context& context) {
    if (is_binary(bytes)) return read_binary(bytes, context);
    return TextReader(text_of(bytes), context).read();
}

Result<WriteReport> write_stl(Output& output, const mesh::Mesh& mesh, const WriteOptions& options) {
    WriteReport report;
    if (options.encoding == Encoding::ascii) {
        write_text(output, mesh);
        return report;
    }
    if (mesh.triangles.size() > 0xffffffffu)
        return Error{ErrorCode::limit, "binary STL counts facets in 32 bits", {}};
    const Result<Rounding> rounding = rounding_to_floats(mesh);
    if (!rounding) return rounding.error();
    report.largest_displacement = rounding->largest;
    if (rounding->largest > 0)
        report.warnings.push_back("binary STL holds floats: coordinates were moved by up to " +
                                  number_text(rounding->largest));
    if (rounding->collapsed > 0)
        report.warnings.push_back("rounding to floats made " + std::to_string(rounding->collapsed) +
                                  " facets lose their area");
    write_binary(output, mesh);
    return report;
}

}  // namespace octavo::io
