// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include <octavo/io/face_directions.hpp>
#include <octavo/io/facet_regions.hpp>
#include <octavo/io/format.hpp>
#include <octavo/io/input.hpp>
#include <octavo/io/tetgen.hpp>
#include <octavo/io/text_scanner.hpp>

namespace octavo::io {
namespace {

/// Numbers in lines with comments.
class Rows {
  public:
    Rows(Bytes bytes, const Context& context) : scanner_(text_of(bytes)), pace_(context, bytes.size() + 1) {}

    TextScanner& scanner() { return scanner_; }
    bool goes_on() { return pace_.goes_on(scanner_.remaining()); }

    bool at_end() {
        scanner_.skip_space_and_comments();
        return scanner_.at_end();
    }
    /// Whether the line has another word.
    bool has_more() {
        scanner_.skip_blanks();
        return !scanner_.at_line_end() && scanner_.peek() != '#';
    }
    /// The next whole number, on this line or the next.
    std::optional<std::uint64_t> count() {
        scanner_.skip_space_and_comments();
        return scanner_.count();
    }
    /// The next whole number of this line; 0 where there is none.
    std::optional<std::uint64_t> count_or_zero() {
        if (!has_more()) return 0;
        return scanner_.count();
    }
    Error expected(const std::string& what) {
        scanner_.skip_space_and_comments();
        return scanner_.error_here("expected " + what + ", found " + scanner_.quoted());
    }
    /// A number, then a point; the rest of the line is attributes and markers.
    Result<Vec3> numbered_point(const char* what, std::uint64_t& number) {
        const std::optional<std::uint64_t> found = count();
        if (!found) return expected("the number of " + std::string(what));
        number = *found;
        Vec3 point;
        for (int axis = 0; axis < 3; ++axis) {
            scanner_.skip_blanks();
            const char* const before = scanner_.position();
            const std::optional<double> value = has_more() ? scanner_.number() : std::nullopt;
            if (!value) return scanner_.error_at(before, std::string(what) + " needs three coordinates");
            if (!std::isfinite(*value))
                return scanner_.error_at(before, "a coordinate is not a finite number");
            point[axis] = *value;
        }
        scanner_.skip_line();
        return point;
    }

  private:
    TextScanner scanner_;
    ReadingPace pace_;
};

struct Points {
    std::vector<Vec3> points;
    std::uint64_t first = 0;  ///< the number of the first
};

Result<Points> read_points(Rows& rows) {
    const std::optional<std::uint64_t> count = rows.count();
    if (!count) return rows.expected("the number of points");
    const char* const header = rows.scanner().position();
    if (rows.has_more()) {
        const std::optional<std::uint64_t> dimension = rows.scanner().count();
        if (!dimension) return rows.expected("the dimension");
        if (*dimension != 3) {
            Error error = rows.scanner().error_at(
                header, "has points of " + std::to_string(*dimension) + " dimensions; a solid has 3");
            error.code = ErrorCode::unsupported;
            return error;
        }
    }
    rows.scanner().skip_line();
    // A point takes eight characters at least.
    if (*count > rows.scanner().remaining() / 8 + 1)
        return rows.scanner().error_at(
            header, "announces " + std::to_string(*count) + " points, more than the file can hold");
    if (*count > 0xffffffffu) return Error{ErrorCode::limit, "has more than 4294967295 points", {}};
    Points result;
    result.points.reserve(*count);
    for (std::uint64_t i = 0; i < *count; ++i) {
        rows.scanner().skip_space_and_comments();
        const char* const before = rows.scanner().position();
        std::uint64_t number = 0;
        const Result<Vec3> point = rows.numbered_point("a point", number);
        if (!point) return point.error();
        if (i == 0) result.first = number;
        if (number != result.first + i || result.first > 1)
            return rows.scanner().error_at(
                before, "point " + std::to_string(number) + " stands where " +
                            (i == 0 ? "0 or 1" : std::to_string(result.first + i)) + " is expected");
        result.points.push_back(*point);
        if (!rows.goes_on()) return Context::cancelled_error();
    }
    return result;
}

/// The .node file beside a boundary.
std::string node_file_of(const std::string& boundary) {
    const std::string extension = extension_of(boundary);
    return (extension.empty() ? boundary + "." : boundary.substr(0, boundary.size() - extension.size())) +
           "node";
}

Result<Points> read_node_file(const std::string& path, const Context& context) {
    const auto in_node_file = [&](Error error) {
        error.place.file = path;
        return error;
    };
    const Result<ByteBlock> block = read_bytes(path, context);
    if (!block) return in_node_file(block.error());
    Rows rows(block->bytes(), context);
    Result<Points> points = read_points(rows);
    if (!points) return in_node_file(points.error());
    return points;
}

class BoundaryReader {
  public:
    BoundaryReader(Bytes bytes, bool with_contours, const ReadOptions& options, const Context& context)
        : rows_(bytes, context), with_contours_(with_contours), path_(options.path), context_(context) {}

    Result<FileMesh> read() {
        Result<Points> points = read_points(rows_);
        if (points && points->points.empty() && !has_no_facets()) {
            if (path_.empty())
                return Error{
                    ErrorCode::unsupported,
                    "has no points; they are in a .node file, which is looked for beside a file only",
                    {}};
            result_.beside.push_back(node_file_of(path_));
            points = read_node_file(result_.beside.back(), context_);
        }
        if (!points) return points.error();
        result_.vertices = std::move(points->points);
        first_ = points->first;
        for (const Vec3& vertex : result_.vertices)
            for (int axis = 0; axis < 3; ++axis) reach_ = std::max(reach_, std::fabs(vertex[axis]));
        if (const std::optional<Error> error = read_facets()) return *error;
        if (const std::optional<Error> error = read_hole_points()) return *error;
        direct();
        tell_what_is_left_out();
        return std::move(result_);
    }

  private:
    /// An empty solid needs no points. Before the facets are read.
    bool has_no_facets() const {
        Rows ahead = rows_;
        return ahead.count() == 0U;
    }

    std::optional<Error> read_facets() {
        const std::optional<std::uint64_t> count = rows_.count();
        if (!count) return rows_.expected("the number of facets");
        if (*count > rows_.scanner().remaining() / 4 + 1)
            return rows_.scanner().error_here("announces " + std::to_string(*count) +
                                              " facets, more than the file can hold");
        rows_.scanner().skip_line();
        result_.faces.reserve_triangles(*count);
        for (std::uint64_t facet = 0; facet < *count; ++facet) {
            contours_.clear(), facet_holes_.clear(), hole_lines_.clear();
            if (rows_.at_end())
                return rows_.scanner().error_here("ends before facet " + std::to_string(facet + 1) + " of " +
                                                  std::to_string(*count));
            const char* const begin = rows_.scanner().position();
            if (const std::optional<Error> error = with_contours_ ? read_facet() : read_contour())
                return error;
            if (const std::optional<Error> error = take_facet(facet, begin)) return error;
            if (!rows_.goes_on()) return Context::cancelled_error();
        }
        return {};
    }

    /// A facet of .poly: how many contours and hole points, then these.
    std::optional<Error> read_facet() {
        const std::optional<std::uint64_t> contours = rows_.count();
        if (!contours) return rows_.expected("the number of contours of a facet");
        const std::optional<std::uint64_t> holes = rows_.count_or_zero();
        if (!holes) return rows_.expected("the number of hole points of a facet");
        rows_.scanner().skip_line();
        if (*contours > rows_.scanner().remaining() / 2 + 1 || *holes > rows_.scanner().remaining() / 8 + 1)
            return rows_.scanner().error_here("a facet of " + std::to_string(*contours) + " contours and " +
                                              std::to_string(*holes) +
                                              " hole points runs past the end of the file");
        for (std::uint64_t i = 0; i < *contours; ++i)
            if (const std::optional<Error> error = read_contour()) return error;
        for (std::uint64_t i = 0; i < *holes; ++i) {
            rows_.scanner().skip_space_and_comments();
            hole_lines_.push_back(rows_.scanner().position());
            std::uint64_t number = 0;
            const Result<Vec3> point = rows_.numbered_point("a hole point", number);
            if (!point) return point.error();
            facet_holes_.push_back(*point);
        }
        return {};
    }

    std::optional<Error> read_contour() {
        const std::optional<std::uint64_t> size = rows_.count();
        if (!size) return rows_.expected("the number of corners of a contour");
        if (*size > rows_.scanner().remaining() / 2 + 1)
            return rows_.scanner().error_here("a contour of " + std::to_string(*size) +
                                              " corners runs past the end of the file");
        std::vector<mesh::VertexIndex> corners;
        corners.reserve(*size);
        for (std::uint64_t i = 0; i < *size; ++i) {
            rows_.scanner().skip_space_and_comments();
            const char* const before = rows_.scanner().position();
            const std::optional<std::uint64_t> number = rows_.scanner().count();
            if (!number) return rows_.expected("the number of a point");
            if (*number < first_ || *number - first_ >= result_.vertices.size())
                return rows_.scanner().error_at(before, "the contour names point " + std::to_string(*number) +
                                                            " of " + std::to_string(result_.vertices.size()) +
                                                            ", which are numbered from " +
                                                            std::to_string(first_));
            corners.push_back(static_cast<mesh::VertexIndex>(*number - first_));
        }
        rows_.scanner().skip_line();
        if (corners.size() < 3)
            ++loose_;
        else
            contours_.push_back(std::move(corners));
        return {};
    }

    std::optional<Error> take_facet(std::uint64_t facet, const char* begin) {
        if (contours_.empty()) return {};
        FacetRegions::Taken taken = regions_.take(result_.vertices, contours_, facet_holes_, result_.faces);
        const std::string name = "facet " + std::to_string(facet + 1) + " ";
        if (taken.trouble) {
            const std::size_t hole = taken.trouble->hole_point;
            return rows_.scanner().error_at(hole == FacetRegions::Trouble::none ? begin : hole_lines_[hole],
                                            name + taken.trouble->sentence);
        }
        if (!(regions_.deviation() <= most_deviation * reach_))
            return rows_.scanner().error_at(begin, name + "is not flat: a corner is " +
                                                       number_text(regions_.deviation()) +
                                                       " off the plane of the others");
        const auto number = static_cast<std::uint32_t>(facet);
        result_.number_of_face.resize(result_.number_of_face.size() + taken.faces, number);
        return {};
    }

    std::optional<Error> read_hole_points() {
        if (rows_.at_end()) return {};
        const std::optional<std::uint64_t> count = rows_.count();
        if (!count) return rows_.expected("the number of hole points");
        rows_.scanner().skip_line();
        for (std::uint64_t i = 0; i < *count; ++i) {
            if (rows_.at_end())
                return rows_.scanner().error_here("ends before hole point " + std::to_string(i + 1) + " of " +
                                                  std::to_string(*count));
            std::uint64_t number = 0;
            const Result<Vec3> point = rows_.numbered_point("a hole point", number);
            if (!point) return point.error();
            hole_points_.push_back(*point);
        }
        return {};
    }

    void direct() {
        const FaceDirections directions =
            directions_away_from_solid(result_.vertices, result_.faces, hole_points_);
        const std::size_t faces = result_.faces.size();
        if (directions.turned > 0 || directions.inner > 0) {
            result_.faces = with_directions(result_.faces, directions);
            std::size_t kept = 0;
            for (std::size_t face = 0; face < faces; ++face)
                if (!directions.drops[face]) result_.number_of_face[kept++] = result_.number_of_face[face];
            result_.number_of_face.resize(kept);
        }
        const auto remark = [&](std::size_t count, const char* what) {
            if (count) result_.warnings.push_back(std::to_string(count) + what);
        };
        remark(directions.turned, " facets were turned over to look away from the solid");
        remark(directions.inner, " facets between two parts of the solid, or in a hole, are left out");
        remark(directions.lost_holes, " hole points lie outside of everything");
    }

    void tell_what_is_left_out() {
        if (loose_ > 0)
            result_.warnings.push_back(std::to_string(loose_) +
                                       " contours of fewer than three corners are left out");
        bool in_order = true;
        for (std::size_t face = 0; face < result_.number_of_face.size(); ++face)
            in_order = in_order && result_.number_of_face[face] == face;
        if (in_order) result_.number_of_face.clear();
    }

    Rows rows_;
    bool with_contours_;
    std::string path_;
    const Context& context_;
    FileMesh result_;
    FacetRegions regions_;
    std::uint64_t first_ = 0;
    double reach_ = 0;  ///< the largest coordinate
    std::size_t loose_ = 0;
    FacetRegions::Contours contours_;  ///< of the facet at hand
    std::vector<Vec3> facet_holes_, hole_points_;
    std::vector<const char*> hole_lines_;
};

}  // namespace

Result<FileMesh> read_poly(Bytes bytes, const ReadOptions& options, const Context& context) {
    return BoundaryReader(bytes, true, options, context).read();
}

Result<FileMesh> read_smesh(Bytes bytes, const ReadOptions& options, const Context& context) {
    return BoundaryReader(bytes, false, options, context).read();
}

}  // namespace octavo::io
