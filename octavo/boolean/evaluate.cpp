// SPDX-License-Identifier: Apache-2.0
#include <chrono>

#include <octavo/boolean/assemble.hpp>
#include <octavo/boolean/evaluate.hpp>
#include <octavo/boolean/simplify.hpp>
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

void note_output(const Assembled& assembled, Report& report) {
    report.largest_rounding = assembled.largest_rounding;
    report.inverted_facets = assembled.inverted_facets;
    report.first_inverted = assembled.first_inverted;
    report.duplicated_vertices = assembled.duplicated_vertices;
    if (assembled.mesh.triangles.empty()) report.warnings.push_back("the result is empty");
    if (assembled.inverted_facets > 0) {
        std::string ids;
        for (const std::uint32_t facet : assembled.first_inverted)
            ids += (ids.empty() ? "" : ", ") + std::to_string(facet);
        report.warnings.push_back("rounding to doubles turned over or flattened " +
                                  std::to_string(assembled.inverted_facets) +
                                  " facets of the result: " + ids +
                                  (assembled.inverted_facets > assembled.first_inverted.size() ? ", …" : ""));
    }
}

}  // namespace

Result<Evaluated> evaluate(std::span<const mesh::Mesh* const> operands, const Program& program,
                           const Options& options, const Context& context) {
    Evaluated result;
    Report& report = result.report;
    Phases phases(context, report);
    const std::uint64_t exact_before = exact::predicate_counts().exact();

    phases.begin("snap", 0.0);
    Result<Soup> soup = make_soup(operands, options.open, context);
    if (!soup) return soup.error();
    note_input(*soup, report);

    phases.begin("index", 0.15);
    const FacetTree tree(*soup, context);

    phases.begin("meet", 0.25);
    PointTable points(*soup);
    const Contacts contacts = find_contacts(*soup, tree, points, context);
    if (context.cancelled()) return Context::cancelled_error();
    report.pairs_tested = contacts.pairs_tested;

    phases.begin("cut", 0.5);
    const Complex complex = arrange(*soup, contacts, points, context);
    if (context.cancelled()) return Context::cancelled_error();
    report.pieces = complex.pieces.size();
    for (const char cut : complex.is_cut) report.cut_facets += cut != 0;
    report.constructed_points = points.size() - soup->points.size();

    phases.begin("connect", 0.65);
    const Result<Patches> patches = find_patches(complex, points, context);
    if (!patches) return patches.error();
    report.patches = patches->count;

    phases.begin("classify", 0.8);
    const Result<Classification> classification = classify(complex, points, tree, *patches, program, context);
    if (!classification) return classification.error();
    report.components = classification->components;

    phases.begin("assemble", 0.85);
    Surface surface = select(complex, *patches, *classification);
    if (options.simplify == Simplify::coplanar) surface = merge_coplanar(surface, *soup, points, context);
    Assembled assembled =
        assemble(surface, *soup, points, special_points(surface, *patches, points.size()), context);
    phases.end();
    note_output(assembled, report);
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
