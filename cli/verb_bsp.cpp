// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <octavo/bsp_octree/bso_file.hpp>
#include <octavo/bsp_octree/bso_format.hpp>
#include <octavo/bsp_octree/build.hpp>

#include "bsp_octree_facts.hpp"
#include "bsp_octree_output.hpp"
#include "model.hpp"
#include "program.hpp"

// `octavo bsp FILE -o OUT.bso`: the BSP-octree of a solid, exactly; and from a .bso file back to a mesh.

namespace octavo::cli {
namespace {

struct BspArguments {
    std::string input, output, format, stop = "few-planes";
    std::uint32_t planes = 16;
    int depth = 26;
};

bool holds_a_tree(const BspArguments& arguments) {
    return kind_of(arguments.input, arguments.format) == ModelKind::bsp_octree;
}

/// Options of making a tree, which a file that holds one has no use for.
Status check_use(Session& session, const BspArguments& arguments) {
    if (!holds_a_tree(arguments)) return Done{};
    const BspArguments usual;
    const char* const useless = arguments.planes != usual.planes ? "--planes"
                                : arguments.stop != usual.stop   ? "--stop"
                                : arguments.depth != usual.depth ? "--depth"
                                                                 : nullptr;
    if (!useless) return Done{};
    return session.usage_error(
        fmt::format("{} is for making a tree, and {} holds one already", useless, arguments.input));
}

/// The tree, and how far rounding to the lattice moved a vertex at most.
struct Loaded {
    bsp_octree::BspOctree octree;
    double largest_displacement = 0;
};

Result<Loaded> load(Session& session, const Context& context, const BspArguments& arguments) {
    if (holds_a_tree(arguments)) {
        session.inputs.push_back(arguments.input);
        Result<bsp_octree::BspOctree> octree =
            session.timed("read", [&] { return bsp_octree::read_bso(arguments.input, context); });
        if (!octree) return std::move(octree).error();
        return Loaded{std::move(*octree), 0};
    }
    Result<io::ReadMesh> read = read_operand(session, context, arguments.input, arguments.format);
    if (!read) return std::move(read).error();
    bsp_octree::MeshOptions options;
    options.octree.planes = arguments.planes;
    options.octree.depth = arguments.depth;
    if (arguments.stop == "common-point") options.octree.stop = bsp_octree::StopRule::common_point;
    Result<bsp_octree::Built> built =
        session.timed("build", [&] { return bsp_octree::build(read->mesh, options, context); });
    if (!built) return in_file(std::move(built).error(), arguments.input);
    session.warn(built->report.warnings);
    if (built->octree.is_empty()) session.warn("the solid is empty");
    if (built->report.resolved)
        session.warn("the surface meets itself; the tree is that of where it winds about a point");
    return Loaded{std::move(built->octree), built->report.largest_displacement};
}

Result<ExitCode> make_bsp(Session& session, const BspArguments& arguments) {
    const Context context = session.context();
    const Result<std::string> format =
        settle_output(session, {arguments.input}, arguments.output, "", bsp_octree_outputs());
    if (!format) return format.error();
    if (const Status useful = check_use(session, arguments); !useful) return useful.error();
    const Result<Loaded> loaded = load(session, context, arguments);
    if (!loaded) return loaded.error();
    if (!arguments.output.empty()) {
        const Result<WrittenBspOctree> written =
            write_bsp_octree(session, context, arguments.output, loaded->octree, *format);
        if (!written) return written.error();
    }
    tell(session, loaded->octree, bsp_octree::encode(loaded->octree).size());
    session.result["largest_displacement"] = loaded->largest_displacement;
    session.text += rounding_text(loaded->largest_displacement);
    return ExitCode::ok;
}

}  // namespace

void add_bsp(Program& program) {
    const auto arguments = std::make_shared<BspArguments>();
    Verb* verb = program.verb("bsp", "Trees", "Make the BSP-octree of a solid, exactly, or a mesh of one",
                              [arguments](Session& session) { return make_bsp(session, *arguments); });
    verb->add_option("FILE", arguments->input,
                     "A closed mesh (- is stdin), a .csg tree, or a .bso or .bpo octree")
        ->required()
        ->type_name("FILE");
    verb->add_option(
            "-o,--output", arguments->output,
            "The BSP-octree to write (.bso; - is stdout), or a mesh of it; without it only facts are told")
        ->type_name("FILE");
    verb->add_option("--planes", arguments->planes, "Most planes of a leaf under --stop few-planes")
        ->check(whole_number(1, 1000))
        ->type_name("N")
        ->capture_default_str();
    take_one_of(verb->add_option("--stop", arguments->stop,
                                 "When a cell is a leaf: few planes, or faces with a common point"),
                {"few-planes", "common-point"});
    verb->add_option("--depth", arguments->depth,
                     "Cells of this level are leaves, however many planes they have")
        ->check(whole_number(0, 26))
        ->type_name("N")
        ->capture_default_str();
    add_from_option(verb, arguments->format, "FILE");
}

}  // namespace octavo::cli
