// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <functional>
#include <iterator>
#include <map>
#include <random>
#include <set>

#include <pugixml.hpp>
#include <zlib.h>

#include <octavo/io/hyper_tree_grid.hpp>
#include <octavo/io/oct.hpp>
#include <octavo/io/vtu.hpp>

#include "folder.hpp"
#include "from_text.hpp"

namespace octavo::io {
namespace {

/// A random tree, mostly split near the root, on a lattice away from the origin.
octree::Octree random_octree(unsigned seed, int depth) {
    std::mt19937 random(seed);
    octree::DfCode code;
    const std::function<void(int)> grow = [&](int level) {
        const bool split = level < depth && random() % 8 < (level < 2 ? 7u : 3u);
        code.append(split ? octree::Node::split : static_cast<octree::Node>(random() % 3));
        if (split)
            for (int i = 0; i < 8; ++i) grow(level + 1);
    };
    grow(0);
    return {*exact::Lattice::from_parts(-20, {1 << 20, -5, 77}), depth, std::move(code)};
}

std::string text_of_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// An independent reader of VTK XML files with appended raw data: the XML, and arrays by name.
class VtkFile {
  public:
    explicit VtkFile(const std::string& path) : text_(text_of_file(path)) {
        const std::size_t data = text_.find("<AppendedData encoding=\"raw\">\n_");
        EXPECT_NE(data, std::string::npos);
        begin_ = text_.find('_', data) + 1;
        const std::string xml = text_.substr(0, data) + "</VTKFile>";
        EXPECT_TRUE(document_.load_string(xml.c_str())) << xml;
        EXPECT_TRUE(text_.ends_with("\n</AppendedData>\n</VTKFile>\n"));
    }
    pugi::xml_node root() const { return document_.child("VTKFile"); }

    template <class T>
    std::vector<T> array(const char* name) const {
        const pugi::xpath_node node =
            document_.select_node(("//DataArray[@Name='" + std::string(name) + "']").c_str());
        EXPECT_TRUE(node) << name;
        std::size_t at = begin_ + node.node().attribute("offset").as_ullong();
        const auto next = [&] {
            const auto value = load<std::uint64_t>(bytes_of(text_).data() + at);
            at += 8;
            return value;
        };
        const std::uint64_t blocks = next(), block_size = next(), last = next();
        std::vector<std::uint64_t> sizes;
        for (std::uint64_t i = 0; i < blocks; ++i) sizes.push_back(next());
        std::string raw;
        for (std::uint64_t i = 0; i < blocks; ++i) {
            std::string block(block_size, '\0');
            uLongf size = block.size();
            EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(block.data()), &size,
                                 reinterpret_cast<const Bytef*>(text_.data() + at), sizes[i]),
                      Z_OK);
            EXPECT_EQ(size, i + 1 == blocks && last > 0 ? last : block_size);
            raw += block.substr(0, size);
            at += sizes[i];
        }
        std::vector<T> values(raw.size() / sizeof(T));
        for (std::size_t i = 0; i < values.size(); ++i)
            values[i] = load<T>(bytes_of(raw).data() + i * sizeof(T));
        return values;
    }

  private:
    std::string text_;
    std::size_t begin_ = 0;
    pugi::xml_document document_;
};

TEST(OctFile, ComesBackAsItWas) {
    const Folder folder;
    for (unsigned seed = 0; seed < 20; ++seed) {
        const octree::Octree octree = random_octree(seed, 6);
        const Result<WriteReport> report = write_octree(folder / "a.oct", octree);
        ASSERT_TRUE(report);
        EXPECT_EQ(report->bytes, std::filesystem::file_size(folder / "a.oct"));
        const Result<octree::Octree> read = read_octree(folder / "a.oct");
        ASSERT_TRUE(read) << read.error().describe();
        EXPECT_EQ(*read, octree);
    }
    EXPECT_EQ(folder.files(), 1u);
}

TEST(OctFile, NamesTheFileThatIsWrong) {
    const Folder folder;
    EXPECT_EQ(read_octree(folder / "missing.oct").error().code, ErrorCode::io);
    ASSERT_TRUE(write_mesh(folder / "m.off", awkward_mesh()));
    const Result<octree::Octree> read = read_octree(folder / "m.off");
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::bad_input);
    EXPECT_EQ(read.error().place.file, folder / "m.off");
}

TEST(Vtu, HoldsTheChosenLeavesAsHexahedra) {
    const Folder folder;
    const octree::Octree octree = random_octree(3, 5);
    const octree::OctreeStats stats = octree.stats();
    for (const LeafChoice& choice : {LeafChoice{}, LeafChoice{.white = true}, LeafChoice{.gray = false}}) {
        ASSERT_TRUE(write_vtu(folder / "a.vtu", octree, choice));
        const VtkFile file(folder / "a.vtu");
        EXPECT_STREQ(file.root().attribute("header_type").value(), "UInt64");
        const auto points = file.array<double>("Points");
        const auto connectivity = file.array<std::int64_t>("connectivity");
        const auto offsets = file.array<std::int64_t>("offsets");
        const auto types = file.array<std::uint8_t>("types");
        const auto colors = file.array<std::uint8_t>("color");
        const auto levels = file.array<std::uint8_t>("level");
        const std::uint64_t cells = stats.gray * choice.gray + stats.black + stats.white * choice.white;
        const pugi::xml_node piece = file.root().child("UnstructuredGrid").child("Piece");
        EXPECT_EQ(piece.attribute("NumberOfCells").as_ullong(), cells);
        EXPECT_EQ(piece.attribute("NumberOfPoints").as_ullong(), points.size() / 3);
        ASSERT_EQ(connectivity.size(), 8 * cells);
        ASSERT_EQ(offsets.size(), cells);
        EXPECT_EQ(types, std::vector<std::uint8_t>(cells, 12));
        ASSERT_EQ(colors.size(), cells);
        std::set<std::array<double, 3>> distinct;
        for (std::size_t i = 0; i < points.size(); i += 3)
            distinct.insert({points[i], points[i + 1], points[i + 2]});
        EXPECT_EQ(distinct.size(), points.size() / 3) << "corners are shared";

        std::size_t cell = 0;
        octree.for_each_leaf([&](octree::CellKey key, octree::Color color) {
            if (!choice.takes(color)) return;
            EXPECT_EQ(offsets[cell], static_cast<std::int64_t>(8 * cell + 8));
            EXPECT_EQ(colors[cell], static_cast<std::uint8_t>(color));
            EXPECT_EQ(levels[cell], key.level());
            const exact::Point low = key.low();
            const int side = key.side();
            constexpr int corners[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                           {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
            for (std::size_t i = 0; i < 8; ++i) {
                const auto& [x, y, z] = corners[i];
                const Vec3 expected =
                    octree.lattice().to_world({low.x + x * side, low.y + y * side, low.z + z * side});
                const auto point = static_cast<std::size_t>(3 * connectivity[8 * cell + i]);
                EXPECT_EQ((Vec3{points[point], points[point + 1], points[point + 2]}), expected);
            }
            ++cell;
        });
        EXPECT_EQ(cell, cells);
    }
}

/// Rebuilds the DF code from the arrays of a hyper tree grid, as a reader of VTK would walk them.
octree::DfCode code_in(const VtkFile& file, std::size_t bits) {
    const auto descriptor = file.array<std::uint8_t>("Descriptor");
    const auto counts = file.array<std::int64_t>("NbVerticesByLevel");
    const auto colors = file.array<std::uint8_t>("color");
    EXPECT_EQ(descriptor.size(), (bits + 7) / 8);
    std::vector<std::size_t> next{0};  // the node of each level that comes next, level after level
    for (const std::int64_t count : counts) next.push_back(next.back() + static_cast<std::size_t>(count));
    octree::DfCode code;
    const std::function<void(std::size_t)> walk = [&](std::size_t level) {
        const std::size_t node = next[level]++;
        const bool split = node < bits && (descriptor[node / 8] >> (7 - node % 8) & 1) != 0;
        code.append(split ? octree::Node::split : static_cast<octree::Node>(colors[node]));
        if (split)
            for (int i = 0; i < 8; ++i) walk(level + 1);
    };
    walk(0);
    return code;
}

TEST(HyperTreeGrid, HoldsTheTreeLevelByLevel) {
    const Folder folder;
    for (unsigned seed = 0; seed < 20; ++seed) {
        const octree::Octree octree = random_octree(seed, 5);
        ASSERT_TRUE(write_hyper_tree_grid(folder / "a.htg", octree));
        const VtkFile file(folder / "a.htg");
        const pugi::xml_node grid = file.root().child("HyperTreeGrid");
        const pugi::xml_node tree = grid.child("Trees").child("Tree");
        EXPECT_EQ(tree.attribute("NumberOfVertices").as_ullong(), octree.code().size());
        const pugi::xml_node descriptor = tree.find_child_by_attribute("DataArray", "Name", "Descriptor");
        EXPECT_EQ(code_in(file, descriptor.attribute("NumberOfTuples").as_ullong()), octree.code());
        const Vec3 low = octree.lattice().to_world({0, 0, 0});
        EXPECT_EQ(file.array<double>("YCoordinates"),
                  (std::vector<double>{low.y, low.y + octree.lattice().unit() * exact::universe_side}));
    }
}

TEST(HyperTreeGrid, MasksTheLeavesThatAreNotChosen) {
    const Folder folder;
    const octree::Octree octree = random_octree(4, 5);
    for (const LeafChoice& choice : {LeafChoice{}, LeafChoice{.white = true}, LeafChoice{.black = false}}) {
        ASSERT_TRUE(write_hyper_tree_grid(folder / "a.htg", octree, choice));
        std::uint64_t masked = 0;
        for (const std::uint8_t byte : VtkFile(folder / "a.htg").array<std::uint8_t>("Mask"))
            masked += static_cast<std::uint64_t>(std::popcount(byte));
        const octree::OctreeStats stats = octree.stats();
        EXPECT_EQ(masked,
                  stats.white * !choice.white + stats.black * !choice.black + stats.gray * !choice.gray);
    }
}

TEST(Vtu, HoldsNothingWhenNothingIsChosen) {
    const Folder folder;
    ASSERT_TRUE(write_vtu(folder / "a.vtu", octree::Octree()));
    const VtkFile file(folder / "a.vtu");
    EXPECT_TRUE(file.array<double>("Points").empty());
    EXPECT_TRUE(file.array<std::int64_t>("connectivity").empty());
}

}  // namespace
}  // namespace octavo::io
