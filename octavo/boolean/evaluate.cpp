// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include <octavo/base/counted.hpp>
#include <octavo/base/parallel.hpp>
#include <octavo/boolean/assemble.hpp>
#include <octavo/boolean/evaluate.hpp>
#include <octavo/boolean/rounding_faults.hpp>
#include <octavo/boolean/simplify.hpp>
#include <octavo/boolean/stars.hpp>
#include <octavo/boolean/thin_shells.hpp>
#include <octavo/exact/counters.hpp>

namespace octavo::boolean {
namespace {

/// Notes how long the phases take and tells the caller about them.
class Phases {
  public:
    Phases(const Context& context, Report& report) : context_(context), report_(report) {}
    void begin(const char* name, double done) {
        end();
        context_.report(name, done);
        name_ = name;
        start_ = std::chrono::steady_clock::now();
    }
    void end() {
        if (name_) {
            const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start_;
            report_.phases.push_back({name_, time.count()});
        }
        name_ = nullptr;
    }

  private:
    const Context& context_;
    Report& report_;
    const char* name_ = nullptr;
    std::chrono::steady_clock::time_point start_;
};

void note_input(const Soup& soup, Report& report) {
    report.operands = soup.first_triangle.size() - 1;
    report.input_triangles = soup.first_triangle.back();
    report.coincident_facets = soup.coincident_facets;
    report.flat_facets = soup.flat_facets;
    report.moved_vertices = soup.moved_vertices;
    report.largest_displacement = soup.largest_displacement;
    report.closing_facets = soup.closing_facets;
    report.warnings = soup.warnings;
}

/// A tolerance that reaches farther than this joins the operands into nothing much.
constexpr double most_units = exact::universe_side / 16.0;

Result<double> lattice_units(const Tolerance& tolerance, const Soup& soup) {
    double units = tolerance.value;
    if (tolerance.unit == Tolerance::Of::length) units /= soup.lattice.unit();
    if (tolerance.unit == Tolerance::Of::size) {
        exact::Point low{exact::universe_side, exact::universe_side, exact::universe_side}, high{};
        for (const exact::Point point : soup.points) {
            low = {std::min(low.x, point.x), std::min(low.y, point.y), std::min(low.z, point.z)};
            high = {std::max(high.x, point.x), std::max(high.y, point.y), std::max(high.z, point.z)};
        }
        units *= std::max({high.x - low.x, high.y - low.y, high.z - low.z, 0});
    }
    if (!(units >= 0 && units <= most_units))
        return Error{ErrorCode::bad_input,
                     "the tolerance must lie between 0 and a sixteenth of the operands' size",
                     {}};
    return units;
}

void note_flush(const FlushReport& flush, Report& report) {
    if (flush.folded_facets > 0)
        report.warnings.push_back(std::to_string(flush.folded_facets) +
                                  " facets lie near others within the tolerance but could not be joined to "
                                  "them; slivers may remain");
    if (flush.left_alone > 0)
        report.warnings.push_back(counted(flush.left_alone, "facet lies", "facets lie") +
                                  " near others within the tolerance but could not be joined to them; " +
                                  (flush.settled ? "those stay as they were" : "nothing was made flush"));
}

Numbers usable_numbers(const exact::Lattice& lattice, Numbers asked, Report& report) {
    if (hold_shapes(lattice, asked)) return asked;
    report.warnings.push_back(
        "so far from the origin floats are too coarse for shapes of this size; the result is made for "
        "doubles");
    return Numbers::doubles;
}

/// Facets at fault that go with their shells are none any more.
void drop_thin(Assembled& assembled, RoundingFaults& faults, FlushReport& flush) {
    const ThinShells thin = drop_thin_shells(assembled.mesh, flush.tolerance);
    if (thin.shells == 0) return;
    flush.removed_shells = thin.shells;
    RoundingFaults left;
    left.moved_points = faults.moved_points, left.farthest_move = faults.farthest_move;
    for (const std::uint32_t facet : faults.inverted)
        if (thin.number[facet] != no_index) left.inverted.push_back(thin.number[facet]);
    for (const auto& [first, second] : faults.crossing)
        if (thin.number[first] != no_index && thin.number[second] != no_index)
            left.crossing.push_back({thin.number[first], thin.number[second]});
    faults = std::move(left);
}

/// ", the first near (1.5, 2, 0.25)".
std::string place_of(const mesh::Mesh& mesh, std::uint32_t facet) {
    const mesh::Triangle& t = mesh.triangles[facet];
    const Vec3 middle = (1.0 / 3) * (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
    char text[128];
    std::snprintf(text, sizeof text, ", the first near (%.7g, %.7g, %.7g)", middle.x, middle.y, middle.z);
    return text;
}

void note_faults(const RoundingFaults& faults, const mesh::Mesh& mesh, Numbers numbers, Report& report) {
    constexpr std::size_t named = 8;
    report.mended_points = faults.moved_points;
    report.inverted_facets = faults.inverted.size();
    report.crossing_facets = faults.crossing.size();
    for (std::size_t i = 0; i < std::min(named, faults.inverted.size()); ++i)
        report.first_inverted.push_back(faults.inverted[i]);
    for (std::size_t i = 0; i < std::min(named, faults.crossing.size()); ++i)
        report.first_crossing.push_back(faults.crossing[i]);
    const std::string rounding = numbers == Numbers::floats ? "rounding to floats" : "rounding to doubles";
    const auto warn = [&](std::size_t count, std::size_t listed, std::string sentence, std::uint32_t first,
                          const auto& name) {
        if (count == 0) return;
        for (std::size_t i = 0; i < listed; ++i) sentence += (i ? ", " : "") + name(i);
        report.warnings.push_back(sentence + (count > listed ? ", …" : "") + place_of(mesh, first));
    };
    warn(report.inverted_facets, report.first_inverted.size(),
         rounding + " turned over or flattened " +
             counted(report.inverted_facets, "facet of the result: ", "facets of the result: "),
         faults.inverted.empty() ? 0 : faults.inverted[0],
         [&](std::size_t i) { return std::to_string(report.first_inverted[i]); });
    warn(report.crossing_facets, report.first_crossing.size(),
         rounding + " made " +
             counted(report.crossing_facets,
                     "pair of facets of the result cross: ", "pairs of facets of the result cross: "),
         faults.crossing.empty() ? 0 : faults.crossing[0].first, [&](std::size_t i) {
             return std::to_string(report.first_crossing[i].first) + " and " +
                    std::to_string(report.first_crossing[i].second);
         });
}

}  // namespace

Result<Evaluated> evaluate(std::span<const mesh::Mesh* const> operands, const Program& program,
                           const Options& options, const Context& context) {
    Evaluated result;
    Report& report = result.report;
    Phases phases(context, report);
    const std::uint64_t exact_before = exact::predicate_counts().exact();

    phases.begin("snap", 0.0);
    Result<Soup> soup = make_soup(operands, options.open, options.names, context);
    if (!soup) return soup.error();
    note_input(*soup, report);

    if (options.tolerance.value != 0) {
        phases.begin("flush", 0.1);
        const Result<double> tolerance = lattice_units(options.tolerance, *soup);
        if (!tolerance) return tolerance.error();
        report.flush = make_flush(*soup, *tolerance, context);
        if (context.cancelled()) return Context::cancelled_error();
        note_flush(report.flush, report);
    }

    phases.begin("index", 0.15);
    const Numbers numbers = usable_numbers(soup->lattice, options.numbers, report);
    const double reach = contact_reach(soup->lattice, numbers);
    Stars stars = find_stars(*soup, reach, context);
    if (context.cancelled()) return Context::cancelled_error();
    FacetTree tree(*soup, context, reach, stars.is_spread);

    phases.begin("meet", 0.25);
    PointTable points(*soup);
    const Contacts contacts = find_contacts(*soup, tree, points, context);
    if (context.cancelled()) return Context::cancelled_error();
    report.pairs_tested = contacts.near.size();
    tree.forget_pairs();

    phases.begin("cut", 0.5);
    const Complex complex = arrange(*soup, contacts, points, context);
    if (context.cancelled()) return Context::cancelled_error();
    report.pieces = complex.pieces.size();
    for (const char cut : complex.is_cut) report.cut_facets += cut != 0;
    report.constructed_points = points.size() - soup->points.size();

    phases.begin("connect", 0.65);
    const Result<Patches> patches = find_patches(complex, stars, points, context);
    if (!patches) return patches.error();
    report.patches = patches->count;
    stars = {};

    phases.begin("classify", 0.8);
    const Result<Classification> classification =
        classify(complex, points, tree, *patches, program, options.dangling, context);
    if (!classification) return classification.error();
    report.components = classification->components;

    phases.begin("assemble", 0.85);
    Surface surface;
    // Giving back the memory of the tree takes as long as choosing the triangles.
    parallel_chunks(context, 2, 1, [&](std::size_t task, std::size_t) {
        if (task == 0)
            tree = {};
        else
            surface = select(complex, *patches, *classification, context);
    });
    if (context.cancelled()) return Context::cancelled_error();
    report.dropped_facets =
        soup->facets.size() - report.cut_facets + report.pieces - surface.triangles.size();
    if (options.simplify == Simplify::coplanar)
        surface = merge_coplanar(std::move(surface), *soup, contacts.faces, points, context);
    RoundedPoints rounded(*soup, points, numbers, context);
    if (context.cancelled()) return Context::cancelled_error();
    RoundingFaults faults;
    if (options.faults == Faults::mended)
        faults = mend_rounding(surface, *soup, contacts.near, rounded, context);
    if (context.cancelled()) return Context::cancelled_error();
    Assembled assembled =
        assemble(surface, *soup, points, rounded, special_points(surface, *patches), context);
    if (context.cancelled()) return Context::cancelled_error();
    if (report.flush.tolerance > 0) drop_thin(assembled, faults, report.flush);
    if (options.dangling == Dangling::kept) {
        Surface dangling = select_dangling(complex, *patches, *classification, context);
        if (context.cancelled()) return Context::cancelled_error();
        if (options.simplify == Simplify::coplanar)
            dangling = merge_coplanar(std::move(dangling), *soup, contacts.faces, points, context);
        if (context.cancelled()) return Context::cancelled_error();
        append_dangling(dangling, *soup, rounded, assembled);
        report.dangling_facets = dangling.triangles.size();
        report.closed = dangling.triangles.empty();
    }
    phases.end();
    report.largest_rounding = rounded.largest_rounding() + faults.farthest_move * soup->lattice.unit();
    report.duplicated_vertices = assembled.duplicated_vertices;
    if (assembled.mesh.triangles.empty()) report.warnings.push_back("the result is empty");
    note_faults(faults, assembled.mesh, numbers, report);
    report.exact_fallbacks = exact::predicate_counts().exact() - exact_before;
    result.mesh = std::move(assembled.mesh);
    return result;
}

namespace {

Result<Evaluated> evaluate_all(std::span<const mesh::Mesh> operands, const Program& program,
                               const Options& options, const Context& context) {
    std::vector<const mesh::Mesh*> pointers;
    for (const mesh::Mesh& operand : operands) pointers.push_back(&operand);
    return evaluate(pointers, program, options, context);
}

}  // namespace

Result<Evaluated> unite(std::span<const mesh::Mesh> operands, const Options& options,
                        const Context& context) {
    return evaluate_all(operands, Program::union_of(static_cast<std::uint32_t>(operands.size())), options,
                        context);
}

Result<Evaluated> intersect(std::span<const mesh::Mesh> operands, const Options& options,
                            const Context& context) {
    OCTAVO_CHECK(!operands.empty(), "the intersection of no operands is all of space");
    return evaluate_all(operands, Program::intersection(static_cast<std::uint32_t>(operands.size())), options,
                        context);
}

Result<Evaluated> subtract(std::span<const mesh::Mesh> operands, const Options& options,
                           const Context& context) {
    OCTAVO_CHECK(!operands.empty(), "a difference needs a first operand");
    return evaluate_all(operands, Program::difference(static_cast<std::uint32_t>(operands.size())), options,
                        context);
}

Result<Evaluated> symmetric_difference(std::span<const mesh::Mesh> operands, const Options& options,
                                       const Context& context) {
    return evaluate_all(operands, Program::symmetric_difference(static_cast<std::uint32_t>(operands.size())),
                        options, context);
}

}  // namespace octavo::boolean
