// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <octavo/boolean/evaluate.hpp>
#include <octavo/io/read.hpp>

#include "bsp_octree/fingerprint.hpp"
#include "bsp_octree/solid_cases.hpp"
#include "effort.hpp"
#include "models.hpp"

// Set operations on the pairs of real models that are there: BSP-octrees and boolean/ must give the same solid. Both get
// the vertices that are on the joint lattice; an operand that meets itself is resolved first, and both get that. So solids
// are the same exactly, by their fingerprints.

namespace octavo::bsp_octree {
namespace {

/// Triangles of the largest pair that is tried.
std::size_t most_triangles() { return 4000u * static_cast<std::size_t>(tests::effort()); }

std::optional<mesh::Mesh> model(const std::filesystem::path& path) {
    Result<io::ReadMesh> read = io::read_mesh(path.string());
    if (!read || read->mesh.triangles.size() > most_triangles()) return {};
    return std::move(read->mesh);
}

/// Files whose names end in -a and -b.
std::vector<std::pair<std::filesystem::path, std::filesystem::path>> pairs_in(
    const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    if (std::filesystem::exists(folder))
        for (const auto& entry : std::filesystem::directory_iterator(folder)) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    std::vector<std::pair<std::filesystem::path, std::filesystem::path>> pairs;
    for (const auto& first : files)
        for (const auto& second : files) {
            const std::string a = first.stem().string(), b = second.stem().string();
            if (a.size() > 2 && a.substr(a.size() - 2) == "-a" && b == a.substr(0, a.size() - 1) + "b")
                pairs.emplace_back(first, second);
        }
    return pairs;
}

class Pair {
  public:
    Pair(std::string name, std::array<mesh::Mesh, 2> operands)
        : name_(std::move(name)), operands_(std::move(operands)) {
        Box3 bounds;
        for (const mesh::Mesh& mesh : operands_) bounds.add(mesh.bounds());
        lattice_ = *exact::Lattice::fit(bounds);
        for (mesh::Mesh& mesh : operands_)
            for (Vec3& vertex : mesh.vertices) vertex = lattice_.to_world(lattice_.snap(vertex));
    }

    /// Compares union, intersection and differences; false when an operand is no solid.
    bool compare() {
        const Result<Built> first = build(operands_[0], lattice_), second = build(operands_[1], lattice_);
        if (!first || !second) return false;
        take_resolved(0, *first);
        take_resolved(1, *second);
        const std::array<mesh::Mesh, 2> swapped{operands_[1], operands_[0]};
        using boolean::Program;
        check(first->octree.unite(second->octree), operands_, Program::union_of(2), "union");
        check(first->octree.intersect(second->octree), operands_, Program::intersection(2), "intersection");
        check(first->octree.subtract(second->octree), operands_, Program::difference(2), "A - B");
        check(second->octree.subtract(first->octree), swapped, Program::difference(2), "B - A");
        return true;
    }

  private:
    /// An operand that meets itself was resolved and rounded to the lattice: both engines get what came of that, which has
    /// the volume of what boolean/ makes of it, but for the rounding.
    void take_resolved(std::size_t operand, const Built& built) {
        if (!built.report.resolved) return;
        const Result<boolean::Evaluated> expected = boolean::unite(std::span(&operands_[operand], 1));
        Result<ToMesh> resolved = to_mesh(built.octree);
        ASSERT_TRUE(expected && resolved) << name_;
        const mesh::Measures measures = mesh::measure(expected->mesh);
        EXPECT_NEAR(mesh::measure(resolved->mesh).volume, measures.volume,
                    4 * lattice_.unit() * measures.area)
            << name_ << ", operand " << operand;
        operands_[operand] = std::move(resolved->mesh);
    }

    void check(const Result<BspOctree>& ours, std::span<const mesh::Mesh> operands,
               const boolean::Program& program, const std::string& operation) const {
        const std::string what = name_ + ", " + operation;
        const std::array<const mesh::Mesh*, 2> pointers{&operands[0], &operands[1]};
        const Result<boolean::Evaluated> theirs = boolean::evaluate(pointers, program);
        ASSERT_TRUE(ours && theirs) << what;
        EXPECT_TRUE(tests::fingerprint_of(*ours) == tests::fingerprint_of(operands, program)) << what;
        const mesh::Measures expected = mesh::measure(theirs->mesh), found = measure(*ours);
        const double side = std::ldexp(lattice_.unit(), exact::coordinate_bits);
        const double area = std::max(expected.area, found.area), volume_off = 1e-12 * side * area;
        EXPECT_NEAR(found.volume, expected.volume, volume_off) << what;
        EXPECT_NEAR(found.area, expected.area, 1e-9 * area) << what;
        const Result<ToMesh> mesh = to_mesh(*ours);
        ASSERT_TRUE(mesh) << what;
        EXPECT_EQ(tests::manifold_defect(mesh->mesh), "") << what;
        EXPECT_NEAR(mesh::measure(mesh->mesh).volume, expected.volume, volume_off) << what;
    }

    std::string name_;
    std::array<mesh::Mesh, 2> operands_;
    exact::Lattice lattice_;
};

TEST(Pairs, OfModelsGiveWhatBooleansGive) {
    const auto pairs = pairs_in(tests::models_folder() / "boolean-pairs");
    if (pairs.empty()) GTEST_SKIP() << "there are no models on this machine (set OCTAVO_MODELS)";
    int compared = 0;
    for (const auto& [first, second] : pairs) {
        std::optional<mesh::Mesh> a = model(first), b = model(second);
        if (!a || !b) continue;
        const bool is_solid = Pair(first.stem().string(), {std::move(*a), std::move(*b)}).compare();
        if (is_solid)
            ++compared;
        else
            std::printf("%s: an operand is no solid\n", first.stem().c_str());
    }
    EXPECT_GE(compared, 5);
    std::printf("%d pairs compared\n", compared);
}

}  // namespace
}  // namespace octavo::bsp_octree
