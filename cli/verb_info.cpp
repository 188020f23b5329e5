// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "model.hpp"
#include "program.hpp"
#include <octavo/mesh/measure.hpp>
#include <octavo/mesh/validate.hpp>
#include <octavo/mesh/weld.hpp>

// `octavo info FILE`: the facts about a mesh. Whether it is a solid is `check`'s business.

namespace octavo::cli {
namespace {

struct InfoOptions {
    std::string input, format;
};

/// What info tells, gathered.
struct Facts {
    const io::ReadMesh& read;
    const mesh::Report& report;
    const mesh::Measures& measures;

    std::uint64_t self_intersections() const {
        return report.count(mesh::ProblemKind::self_intersections) +
               report.count(mesh::ProblemKind::penetrations) + report.count(mesh::ProblemKind::overlaps);
    }
};

Json result_of(const Facts& facts) {
    const mesh::Measures& m = facts.measures;
    Json inertia = Json::array();
    for (const auto& row : m.inertia) inertia.push_back(row);
    Json json = {{"format", facts.read.format},
                 {"vertices", facts.report.vertices},
                 {"triangles", facts.report.facets},
                 {"components", facts.report.merged_components},
                 {"closed", facts.report.closed},
                 {"oriented", facts.report.oriented},
                 {"manifold", facts.report.manifold},
                 {"self_intersections", facts.self_intersections()},
                 {"volume", m.volume},
                 {"area", m.area},
                 {"centroid", json_of(m.centroid)},
                 {"inertia", inertia},
                 {"euler_number", m.euler_number},
                 {"bounds", Json::array({json_of(m.bounds.low), json_of(m.bounds.high)})}};
    if (m.genus) json["genus"] = *m.genus;
    if (!facts.read.unit.empty()) json["unit"] = facts.read.unit;
    return json;
}

std::string text_of(const Facts& facts, const std::string& name) {
    const mesh::Measures& m = facts.measures;
    const auto yes_or_no = [](bool yes) { return yes ? "yes" : "no"; };
    const auto triple = [](Vec3 v) { return fmt::format("{:.6g}, {:.6g}, {:.6g}", v.x, v.y, v.z); };
    std::string text = fmt::format("{} ({})\n", name, facts.read.format);
    text += fmt::format("  vertices            {}\n", grouped(facts.report.vertices));
    text += fmt::format("  triangles           {}\n", grouped(facts.report.facets));
    text += fmt::format("  components          {}\n", grouped(facts.report.merged_components));
    text += fmt::format("  closed              {}\n", yes_or_no(facts.report.closed));
    text += fmt::format("  oriented            {}\n", yes_or_no(facts.report.oriented));
    text += fmt::format("  self-intersections  {}\n", grouped(facts.self_intersections()));
    text += fmt::format("  Euler number        {}{}\n", m.euler_number,
                        m.genus ? fmt::format(" (genus {})", *m.genus) : "");
    text += fmt::format("  volume              {:.10g}{}\n", m.volume,
                        facts.report.closed ? "" : " (of an open surface: means nothing)");
    text += fmt::format("  area                {:.10g}\n", m.area);
    text += fmt::format("  centroid            {}\n", triple(m.centroid));
    text += "  inertia             ";
    for (int row = 0; row < 3; ++row)
        text += (row ? "                      " : "") + fmt::format("{:>14.6g} {:>14.6g} {:>14.6g}\n",
                                                                    m.inertia[row][0], m.inertia[row][1],
                                                                    m.inertia[row][2]);
    text += fmt::format("  bounds              {}\n                      {}\n", triple(m.bounds.low),
                        triple(m.bounds.high));
    if (!facts.read.unit.empty()) text += fmt::format("  unit                {}\n", facts.read.unit);
    return text;
}

Result<ExitCode> info(Session& session, const InfoOptions& options) {
    const Context context = session.context();
    Result<io::ReadMesh> read = read_mesh(session, context, options.input, options.format);
    if (!read) return std::move(read).error();
    Result<mesh::Report> report =
        session.timed("validate", [&] { return mesh::validate(read->mesh, {}, context); });
    if (!report) return in_file(std::move(report).error(), options.input);
    // Seams and soups have one surface, however often a position is stored.
    const mesh::Measures measures =
        session.timed("measure", [&] { return mesh::measure(mesh::weld(read->mesh)); });
    const Facts facts{*read, *report, measures};
    session.result = result_of(facts);
    session.text = text_of(facts, options.input);
    return ExitCode::ok;
}

}  // namespace

void add_info(Program& program) {
    const auto options = std::make_shared<InfoOptions>();
    CLI::App* verb =
        program.verb("info", "Inspect", "Tell the facts about a mesh: counts, volume, inertia, topology",
                     [options](Session& session) { return info(session, *options); });
    verb->add_option("FILE", options->input, "The mesh; - is stdin")->required()->type_name("FILE");
    verb->add_option("--format", options->format, "Format of FILE, instead of by its extension")
        ->type_name("FORMAT");
}

}  // namespace octavo::cli
