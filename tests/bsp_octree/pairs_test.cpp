// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include <nlohmann/json.hpp>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/io/read.hpp>
#include <octavo/mesh/disjoint_sets.hpp>
#include <octavo/mesh/snap.hpp>
#include <octavo/mesh/transform.hpp>
#include <octavo/mesh/used_vertices.hpp>

#include "bsp_octree/fingerprint.hpp"
#include "bsp_octree/solid_cases.hpp"
#include "effort.hpp"
#include "models.hpp"

// Set operations on all operands for Booleans that are there: BSP-octrees and boolean/ must give the same solid,
// exactly, by fingerprints of vertices that nobody rounds. Both get the vertices that are on the joint lattice, and
// nothing else is done to operands first, also to those that cross, cover or nest themselves.

namespace octavo::bsp_octree {
namespace {

using boolean::Program;
using Path = std::filesystem::path;

/// Triangles of the largest case that is tried, judged by its files; with OCTAVO_TEST_EFFORT = 60 all are.
constexpr std::uintmax_t bytes_per_triangle = 20;
std::size_t most_triangles() { return 4000u * static_cast<std::size_t>(tests::effort()); }

/// An operand that looks inwards winds about nothing; its user would turn it.
mesh::Mesh looking_outwards(mesh::Mesh mesh) {
    return mesh::measure(mesh).volume < 0 ? mesh::flipped(std::move(mesh)) : mesh;
}

std::vector<mesh::Mesh> read_operand(const Path& path) {
    Result<io::ReadMesh> read = io::read_mesh(path.string());
    EXPECT_TRUE(read) << path;
    if (!read) return {};
    return {looking_outwards(std::move(read->mesh))};
}

/// The parts of a mesh that share no vertices, as operands.
std::vector<mesh::Mesh> read_parts(const Path& path) {
    const std::vector<mesh::Mesh> whole = read_operand(path);
    if (whole.empty()) return {};
    mesh::DisjointSets sets(whole[0].vertices.size());
    for (const mesh::Triangle& t : whole[0].triangles) sets.unite(t[0], t[1]), sets.unite(t[0], t[2]);
    std::map<std::uint32_t, mesh::Mesh> by_set;
    for (const mesh::Triangle& t : whole[0].triangles) {
        mesh::Mesh& part = by_set[sets.find(t[0])];
        part.vertices = whole[0].vertices;
        part.triangles.push_back(t);
    }
    std::vector<mesh::Mesh> parts;
    for (auto& [set, part] : by_set) parts.push_back(looking_outwards(std::move(part)));
    return parts;
}

bool has_parts(const Path& path) { return read_parts(path).size() > 1; }

/// A mesh and its copy, moved by a fifth of its longest side.
std::vector<mesh::Mesh> with_copy(std::vector<mesh::Mesh> operands) {
    const Vec3 extents = operands.at(0).bounds().extents();
    const double by = 0.2 * std::max({extents.x, extents.y, extents.z});
    operands.push_back(mesh::transform(operands[0], mesh::translation({by, 0, 0})));
    return operands;
}

struct Case {
    std::string name;
    std::vector<Path> files;  ///< that it is made from
    std::function<std::vector<mesh::Mesh>()> operands;
};

Case case_of(const std::string& name, const std::vector<Path>& files) {
    return {name, files, [files] {
                std::vector<mesh::Mesh> operands;
                for (const Path& file : files)
                    for (mesh::Mesh& mesh : read_operand(file)) operands.push_back(std::move(mesh));
                return operands;
            }};
}

/// Two models, placed by matrices that a file gives as columns.
std::vector<Case> ember_cases(const Path& folder) {
    std::vector<Case> cases;
    std::ifstream file(folder / "ember-cases.json");
    if (!file) return cases;
    const nlohmann::json listed = nlohmann::json::parse(file);
    for (const nlohmann::json& one : listed) {
        std::vector<Path> files;
        std::vector<Affine> maps;
        for (const std::string side : {"a", "b"}) {
            files.push_back(folder / (std::to_string(one["id_" + side].get<int>()) + ".ply"));
            Affine map;
            const std::string axes[] = {"x", "y", "z"};
            for (std::size_t row = 0; row < 3; ++row)
                for (std::size_t column = 0; column < 4; ++column)
                    map.m[row][column] = one["transform_" + side]["col" + std::to_string(column)][axes[row]];
            maps.push_back(map);
        }
        cases.push_back({"ember " + std::to_string(cases.size() + 1), files, [files, maps] {
                             std::vector<mesh::Mesh> operands;
                             for (std::size_t i = 0; i < 2; ++i)
                                 for (const mesh::Mesh& mesh : read_operand(files[i]))
                                     operands.push_back(looking_outwards(mesh::transform(mesh, maps[i])));
                             return operands;
                         }});
    }
    return cases;
}

std::vector<Path> files_in(const Path& folder) {
    std::vector<Path> files;
    if (std::filesystem::exists(folder))
        for (const auto& entry : std::filesystem::directory_iterator(folder))
            if (entry.is_regular_file() && entry.path().extension() != ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

/// All files of the folder are in some case.
std::vector<Case> all_cases(const Path& models) {
    const Path folder = models / "boolean-pairs";
    std::vector<Case> cases = ember_cases(folder / "ember");
    if (const std::vector<Path> spheres = files_in(folder / "spheres"); !spheres.empty())
        cases.push_back(case_of("spheres", spheres));
    const auto add = [&](const std::string& name, const std::vector<std::string>& files) {
        std::vector<Path> paths;
        for (const std::string& file : files) paths.push_back(models / file);
        if (std::all_of(paths.begin(), paths.end(), [](const Path& p) { return std::filesystem::exists(p); }))
            cases.push_back(case_of(name, paths));
    };
    const std::string here = "boolean-pairs/";
    add("carve spheres", {here + "carve-sphere-a.ply", here + "carve-sphere-one-point-moved-b.ply"});
    add("carve cones", {here + "carve-cone-up.ply", here + "carve-cone-down.ply"});
    add("carve cylinders",
        {here + "carve-cylinder-x.ply", here + "carve-cylinder-y.ply", here + "carve-cylinder-z.ply"});
    add("blobby and eight", {here + "cgal-blobby-a.off", here + "cgal-eight-b.off"});
    add("knots", {here + "cgal-knot2-two-knots.off", "mechanical/knot.off"});
    add("bunny, cactus and cow",
        {here + "imrb-bunny-25k.ply", here + "imrb-cactus-25k.ply", here + "imrb-cow-25k.ply"});
    add("cow and bunny", {here + "imrb-cow-100k.ply", "classic/bunny-closed-100k.ply"});
    for (const Path& file : files_in(folder)) {
        const std::string name = file.stem().string();
        if (name.size() > 2 && name.substr(name.size() - 2) == "-a") {
            const std::string pair = name.substr(0, name.size() - 2);
            add(pair, {here + file.filename().string(), here + pair + "-b" + file.extension().string()});
        } else if (name.rfind("multi-", 0) == 0 && has_parts(file)) {
            cases.push_back({name + ", parts", {file}, [file] { return read_parts(file); }});
            cases.push_back(case_of(name + ", as it is", {file}));
        }
    }
    std::set<Path> used;
    for (const Case& one : cases) used.insert(one.files.begin(), one.files.end());
    for (const Path& file : files_in(folder))
        if (!used.contains(file))
            cases.push_back({file.stem().string() + " and its copy", {file}, [file] {
                                 return with_copy(read_operand(file));
                             }});
    return cases;
}

class Comparison {
  public:
    Comparison(std::string name, std::vector<mesh::Mesh> operands)
        : name_(std::move(name)), operands_(std::move(operands)) {
        Box3 bounds;
        for (const mesh::Mesh& mesh : operands_) bounds.add(mesh::bounds_of_facets(mesh));
        const Result<exact::Lattice> lattice = exact::Lattice::fit(bounds);
        if (!lattice) return;
        lattice_ = *lattice;
        for (mesh::Mesh& mesh : operands_) {
            const Result<mesh::Snapped> snapped = mesh::snap(mesh, lattice_);
            EXPECT_TRUE(snapped) << name_;
            for (std::size_t i = 0; snapped && i < mesh.vertices.size(); ++i)
                mesh.vertices[i] = lattice_.to_world(snapped->mesh.points[i]);
        }
    }

    /// Unites all, intersects all, takes all others from the first, and where there are two, the first from the second.
    /// What is no solid to one engine must be none to the other; false then.
    bool compare() {
        std::vector<BspOctree> octrees;
        for (std::size_t i = 0; i < operands_.size(); ++i) {
            const std::span<const mesh::Mesh> operand(&operands_[i], 1);
            const Result<Built> built =
                build(operands_[i], lattice_, {}, {}, octrees.empty() ? nullptr : octrees[0].shared_store());
            if (!built) {
                std::printf("%s, operand %zu is no solid: %s\n", name_.c_str(), i,
                            built.error().describe().c_str());
                EXPECT_FALSE(boolean::unite(operand)) << name_ << ", operand " << i;
                return false;
            }
            EXPECT_TRUE(tests::fingerprint_of(built->octree) ==
                        tests::fingerprint_of(operand, Program::union_of(1)))
                << name_ << ", operand " << i;
            octrees.push_back(built->octree);
        }
        const auto count = static_cast<std::uint32_t>(octrees.size());
        BspOctree all = octrees[0], common = octrees[0], rest = octrees[0];
        for (std::size_t i = 1; i < count; ++i) {
            all = *all.unite(octrees[i]);
            common = *common.intersect(octrees[i]);
            rest = *rest.subtract(octrees[i]);
        }
        check(all, operands_, Program::union_of(count), "union");
        if (count == 1) return true;
        check(common, operands_, Program::intersection(count), "intersection");
        check(rest, operands_, Program::difference(count), "difference");
        if (count > 2) return true;
        const std::array<mesh::Mesh, 2> swapped{operands_[1], operands_[0]};
        check(*octrees[1].subtract(octrees[0]), swapped, Program::difference(2), "difference the other way");
        return true;
    }

  private:
    void check(const BspOctree& ours, std::span<const mesh::Mesh> operands, const Program& program,
               const std::string& operation) const {
        const std::string what = name_ + ", " + operation;
        std::vector<const mesh::Mesh*> pointers;
        for (const mesh::Mesh& operand : operands) pointers.push_back(&operand);
        const Result<boolean::Evaluated> theirs = boolean::evaluate(pointers, program);
        ASSERT_TRUE(theirs) << what;
        EXPECT_TRUE(tests::fingerprint_of(ours) == tests::fingerprint_of(operands, program)) << what;
        const mesh::Moments expected = mesh::moments(theirs->mesh), found = measure(ours);
        const double side = std::ldexp(lattice_.unit(), exact::coordinate_bits);
        const double area = std::max(expected.area, found.area), volume_off = 1e-12 * side * area;
        EXPECT_NEAR(found.volume, expected.volume, volume_off) << what;
        EXPECT_NEAR(found.area, expected.area, 1e-9 * area) << what;
        const Result<ToMesh> mesh = to_mesh(ours);
        ASSERT_TRUE(mesh) << what;
        EXPECT_EQ(tests::manifold_defect(mesh->mesh), "") << what;
        EXPECT_NEAR(mesh::measure(mesh->mesh).volume, expected.volume, volume_off) << what;
    }

    std::string name_;
    std::vector<mesh::Mesh> operands_;
    exact::Lattice lattice_;
};

TEST(Pairs, OfModelsGiveWhatBooleansGive) {
    const std::vector<Case> cases = all_cases(tests::models_folder());
    if (cases.empty()) GTEST_SKIP() << "there are no models on this machine (set OCTAVO_MODELS)";
    int compared = 0;
    for (const Case& one : cases) {
        std::uintmax_t bytes = 0;
        for (const Path& file : one.files) bytes += std::filesystem::file_size(file);
        if (bytes / bytes_per_triangle > most_triangles()) {
            std::printf("%s is too large for this effort\n", one.name.c_str());
            continue;
        }
        std::vector<mesh::Mesh> operands = one.operands();
        compared += Comparison(one.name, std::move(operands)).compare();
    }
    EXPECT_GE(compared, 5);
    std::printf("%d of %zu cases compared\n", compared, cases.size());
}

}  // namespace
}  // namespace octavo::bsp_octree
