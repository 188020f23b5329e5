// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/classic/moments.hpp>
#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/validate.hpp>
#include <octavo/mesh/weld.hpp>
#include <octavo/octree/cell.hpp>
#include <octavo/octree/oct_format.hpp>

#include "model.hpp"
#include "octree_facts.hpp"
#include "program.hpp"

// `octavo info FILE`: the facts about a model. Whether it is a solid is `check`'s business.
//
// The volume, centroid and inertia of a mesh are integrals of its winding number, as everywhere in the field: space
// that shells share counts twice. Where that is not the volume of the solid, the space of positive winding number, the
// latter is told besides; the union of the mesh with nothing has it as its integral.

namespace octavo::cli {
namespace {

struct InfoOptions {
    std::string input, format;
};

/// How a surface can meet itself, under the names and with the counts of `check`.
constexpr std::array<mesh::ProblemKind, 3> contacts{
    mesh::ProblemKind::self_intersections, mesh::ProblemKind::penetrations, mesh::ProblemKind::overlaps};

/// What info tells about a mesh, gathered.
struct Facts {
    const io::ReadMesh& read;
    mesh::Report report;
    mesh::Measures measures;
    bool on_lattice = true;              ///< else what needs the lattice is not known
    std::optional<double> solid_volume;  ///< of the space of positive winding number; not of open surfaces

    bool is_open() const { return report.count(mesh::ProblemKind::open_edges) > 0; }
    /// Has every point a winding number?
    bool bounds_space() const { return !is_open() && report.oriented; }
    bool may_wind_twice() const {
        const auto meets = [&](mesh::ProblemKind kind) { return report.count(kind) > 0; };
        return std::any_of(contacts.begin(), contacts.end(), meets) || report.nested_bodies > 0 ||
               report.count(mesh::ProblemKind::duplicate_facets) > 0 ||
               report.count(mesh::ProblemKind::inside_out_shells) > 0;
    }
};

/// The report, without what needs the lattice where the mesh does not fit one.
Result<mesh::Report> validate(Session& session, const Context& context, const mesh::Mesh& mesh,
                              bool& on_lattice) {
    mesh::ValidateOptions options;
    Result<mesh::Report> report = mesh::validate(mesh, options, context);
    on_lattice = report || report.error().code != ErrorCode::limit;
    if (on_lattice) return report;
    session.warn(report.error().sentence + "; only what needs no exact geometry is told");
    options.topology_only = true;
    return mesh::validate(mesh, options, context);
}

/// Measures are double numbers, which coordinates near 1e300 exceed when they are multiplied.
void warn_of_overflow(Session& session, const mesh::Measures& measures) {
    const auto is_finite_row = [](const auto& row) {
        return std::all_of(row.begin(), row.end(), [](double entry) { return std::isfinite(entry); });
    };
    std::vector<std::string> names;
    if (!std::isfinite(measures.volume)) names.emplace_back("the volume");
    if (!std::isfinite(measures.area)) names.emplace_back("the area");
    if (!is_finite(measures.centroid)) names.emplace_back("the centroid");
    if (!std::all_of(measures.inertia.begin(), measures.inertia.end(), is_finite_row))
        names.emplace_back("the inertia");
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i)
        list += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    if (!names.empty()) session.warn("too large for double numbers: " + list);
}

Result<Facts> gather(Session& session, const Context& context, const io::ReadMesh& read) {
    bool on_lattice = true;
    Result<mesh::Report> report =
        session.timed("validate", [&] { return validate(session, context, read.mesh, on_lattice); });
    if (!report) return std::move(report).error();
    // Seams and soups have one surface, however often a position is stored.
    if (context.cancelled()) return Context::cancelled_error();
    const mesh::Mesh welded = session.timed("weld", [&] { return mesh::weld(read.mesh); });
    Facts facts{read, std::move(*report), {}, on_lattice, {}};
    if (context.cancelled()) return Context::cancelled_error();
    facts.measures = session.timed("measure", [&] { return mesh::measure(welded); });
    if (context.cancelled()) return Context::cancelled_error();
    warn_of_overflow(session, facts.measures);
    if (!on_lattice || !facts.bounds_space()) return facts;
    facts.solid_volume = facts.measures.volume;
    if (!facts.may_wind_twice()) return facts;
    const Result<boolean::Evaluated> solid = session.timed("unite", [&] {
        return boolean::unite({&welded, 1}, {}, context);
    });
    if (!solid && solid.error().code == ErrorCode::cancelled) return solid.error();
    facts.solid_volume.reset();
    if (solid) facts.solid_volume = mesh::moments(solid->mesh).volume;
    return facts;
}

Json result_of(const Facts& facts) {
    const mesh::Measures& m = facts.measures;
    Json inertia = Json::array();
    for (const auto& row : m.inertia) inertia.push_back(row);
    const auto count = [&](mesh::ProblemKind kind) {
        return facts.on_lattice ? Json(facts.report.count(kind)) : Json();
    };
    Json json = {{"format", facts.read.format},
                 {"vertices", facts.report.vertices},
                 {"triangles", facts.report.facets},
                 {"components", facts.report.merged_components},
                 {"closed", facts.report.closed},
                 {"oriented", facts.report.oriented},
                 {"manifold", facts.report.manifold},
                 {"self_intersections", count(mesh::ProblemKind::self_intersections)},
                 {"penetrations", count(mesh::ProblemKind::penetrations)},
                 {"overlaps", count(mesh::ProblemKind::overlaps)},
                 {"volume", m.volume},
                 {"solid_volume", facts.solid_volume ? Json(*facts.solid_volume) : Json()},
                 {"area", m.area},
                 {"centroid", json_of(m.centroid)},
                 {"inertia", inertia},
                 {"euler_number", m.euler_number},
                 {"bounds", Json()}};
    if (!m.bounds.empty()) json["bounds"] = Json::array({json_of(m.bounds.low), json_of(m.bounds.high)});
    if (m.genus) json["genus"] = *m.genus;
    if (!facts.read.unit.empty()) json["unit"] = facts.read.unit;
    return json;
}

std::string line(const std::string& name, const std::string& value) {
    return fmt::format("  {:<18}  {}\n", name, value);
}

/// A matrix in columns, rounded at the digits of its largest entry.
std::string matrix_text(const std::array<std::array<double, 3>, 3>& matrix) {
    double largest = 0;
    for (const auto& row : matrix)
        for (const double entry : row) largest = std::max(largest, std::fabs(entry));
    std::string text;
    for (std::size_t row = 0; row < 3; ++row)
        text +=
            line("", fmt::format("{:>14} {:>14} {:>14}", number_text(matrix[row][0], largest),
                                 number_text(matrix[row][1], largest), number_text(matrix[row][2], largest)));
    return text;
}

std::string bounds_text(const Box3& bounds) {
    if (bounds.empty()) return line("bounds", "none");
    double largest = 0;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max({largest, std::fabs(bounds.low[axis]), std::fabs(bounds.high[axis])});
    return line("bounds", vector_text(bounds.low, largest)) + line("", vector_text(bounds.high, largest));
}

/// Behind a number that the surface gives no meaning.
std::string remark(const Facts& facts) {
    if (facts.bounds_space()) return "";
    return fmt::format(" (of an {} surface: means nothing)",
                       facts.is_open() ? "open" : "inconsistently oriented");
}

std::string volume_text(const Facts& facts) {
    const double volume = facts.measures.volume;
    if (!facts.bounds_space()) return line("volume", number_text(volume) + remark(facts));
    // The union rounds the points that it constructs.
    const bool agrees = facts.solid_volume && std::fabs(*facts.solid_volume - volume) <= 1e-9 * volume;
    if (!facts.may_wind_twice() || agrees) return line("volume", number_text(volume));
    std::string text =
        line("volume", number_text(volume) + " (space counts as often as the surface winds round it)");
    if (facts.solid_volume) text += line("volume of solid", number_text(*facts.solid_volume));
    return text;
}

/// Crossings always, the rarer kinds only where there are some.
std::string contacts_text(const Facts& facts) {
    if (!facts.on_lattice) return line("self-intersections", "not known");
    std::string text;
    for (const mesh::ProblemKind kind : contacts) {
        const std::uint64_t count = facts.report.count(kind);
        std::string name(mesh::name_of(kind));
        std::replace(name.begin(), name.end(), '_', '-');
        if (count > 0 || kind == mesh::ProblemKind::self_intersections) text += line(name, grouped(count));
    }
    return text;
}

std::string table_of(const Facts& facts, const std::string& name) {
    const mesh::Measures& m = facts.measures;
    const auto yes_or_no = [](bool yes) { return yes ? "yes" : "no"; };
    const double reach = m.bounds.empty() ? 0 : std::max(length(m.bounds.low), length(m.bounds.high));
    std::string text = fmt::format("{} ({})\n", name, facts.read.format);
    text += line("vertices", grouped(facts.report.vertices));
    text += line("triangles", grouped(facts.report.facets));
    text += line("components", grouped(facts.report.merged_components));
    text += line("closed", yes_or_no(facts.report.closed));
    text += line("oriented", yes_or_no(facts.report.oriented));
    text += contacts_text(facts);
    text += line("Euler number",
                 fmt::format("{}{}", m.euler_number, m.genus ? fmt::format(" (genus {})", *m.genus) : ""));
    text += volume_text(facts);
    text += line("area", number_text(m.area));
    text += line("centroid", vector_text(m.centroid, reach) + remark(facts));
    text += line("inertia", "about the centroid, at density 1" + remark(facts));
    text += matrix_text(m.inertia);
    text += bounds_text(m.bounds);
    if (!facts.read.unit.empty()) text += line("unit", facts.read.unit);
    return text;
}

Result<ExitCode> mesh_info(Session& session, const Context& context, const InfoOptions& options) {
    Result<io::ReadMesh> read = read_surface(session, context, options.input, options.format);
    if (!read) return std::move(read).error();
    Result<Facts> facts = gather(session, context, *read);
    if (!facts) return in_file(std::move(facts).error(), options.input);
    session.result = result_of(*facts);
    session.text = table_of(*facts, options.input);
    return ExitCode::ok;
}

/// Bounds of the black and the gray cells.
Box3 bounds_of(const octree::Octree& tree) {
    Box3 bounds;
    tree.for_each_leaf([&](octree::CellKey key, octree::Color color) {
        if (color == octree::Color::white) return;
        const octree::Cell cell = octree::Cell::of(key);
        bounds.add(tree.lattice().to_world(cell.low));
        bounds.add(tree.lattice().to_world(cell.high()));
    });
    return bounds;
}

Result<ExitCode> octree_info(Session& session, const Context& context, const InfoOptions& options) {
    Result<octree::Octree> tree = read_octree(session, context, options.input, options.format);
    if (!tree) return std::move(tree).error();
    const TreeFile file{"oct", octree::encode(*tree).size()};
    const Box3 bounds = bounds_of(*tree);
    const classic::Moments black = classic::moments(*tree);
    session.result = json_of(*tree, file);
    session.text =
        fmt::format("{} (octree of depth {})\n", options.input, tree->depth()) + text_of(*tree, file);
    if (bounds.empty()) return ExitCode::ok;
    session.result["bounds"] = Json::array({json_of(bounds.low), json_of(bounds.high)});
    session.result["centroid"] = json_of(black.centroid);
    session.text +=
        fmt::format("bounds     {}   to   {}\n", vector_text(bounds.low), vector_text(bounds.high));
    session.text += fmt::format("centroid   {} (of the black cells)\n",
                                vector_text(black.centroid, length(bounds.high) + length(bounds.low)));
    return ExitCode::ok;
}

Result<ExitCode> info(Session& session, const InfoOptions& options) {
    const Context context = session.context();
    return kind_of(options.input, options.format) == ModelKind::octree
               ? octree_info(session, context, options)
               : mesh_info(session, context, options);
}

}  // namespace

void add_info(Program& program) {
    const auto options = std::make_shared<InfoOptions>();
    Verb* verb =
        program.verb("info", "Inspect", "Tell the facts about a model: counts, volume, inertia, topology",
                     [options](Session& session) { return info(session, *options); });
    verb->add_option(
            "FILE", options->input,
            "A mesh, a CSG tree (.csg; its polyhedron is measured), or an octree (.oct, .bpo or .bso); - "
            "is stdin")
        ->required()
        ->type_name("FILE");
    add_from_option(verb, options->format, "FILE");
}

}  // namespace octavo::cli
