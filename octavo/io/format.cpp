// SPDX-License-Identifier: Apache-2.0
#include <octavo/io/format.hpp>
#include <octavo/io/obj.hpp>
#include <octavo/io/off.hpp>
#include <octavo/io/ply.hpp>
#include <octavo/io/stl.hpp>
#include <octavo/io/tetgen.hpp>
#include <octavo/io/text_scanner.hpp>
#include <octavo/io/three_mf.hpp>

namespace octavo::io {
namespace {

template <Result<FileMesh> (*read)(Bytes, const Context&)>
Result<FileMesh> without_options(Bytes bytes, const ReadOptions&, const Context& context) {
    return read(bytes, context);
}

Result<FileMesh> read_ply_mesh(Bytes bytes, const ReadOptions&, const Context& context) {
    return read_ply(bytes, context);
}

constexpr Format formats[] = {
    {"stl", "STL, binary or text", false, without_options<read_stl>, write_stl},
    {"obj", "Wavefront OBJ", true, without_options<read_obj>, write_obj},
    {"ply", "PLY, text or binary of either byte order", true, read_ply_mesh, write_ply},
    {"off", "Geomview OFF, text or binary", true, without_options<read_off>, write_off},
    {"3mf", "3D Manufacturing Format", false, read_three_mf, write_three_mf},
    {"poly", "TetGen boundary, facets with holes", true, read_poly, write_poly},
    {"smesh", "TetGen boundary, facets of one contour", true, read_smesh, write_smesh},
};

bool looks_like_obj(Bytes bytes) {
    TextScanner scanner(text_of(bytes));
    scanner.skip_space_and_comments();
    const std::string_view word = scanner.word();
    for (const std::string_view keyword : {"v", "vt", "vn", "o", "g", "s", "f", "mtllib", "usemtl"})
        if (word == keyword) return true;
    return false;
}

bool looks_like_stl(Bytes bytes) {
    constexpr std::size_t header = 84;
    if (bytes.size() >= header &&
        bytes.size() == header + 50 * std::size_t{load<std::uint32_t>(bytes.data() + header - 4)})
        return true;
    return equals_ignoring_case(TextScanner(text_of(bytes)).word(), "solid");
}

}  // namespace

std::span<const Format> mesh_formats() { return formats; }

const Format* mesh_format_named(std::string_view name) {
    if (name.starts_with('.')) name.remove_prefix(1);
    for (const Format& format : formats)
        if (equals_ignoring_case(name, format.name)) return &format;
    return nullptr;
}

std::string mesh_format_names() {
    std::string names;
    for (const Format& format : formats) names += (names.empty() ? "" : ", ") + std::string(format.name);
    return names;
}

std::string extension_of(std::string_view path) {
    const std::size_t slash = path.rfind('/');
    if (slash != std::string_view::npos) path.remove_prefix(slash + 1);
    const std::size_t dot = path.rfind('.');
    if (dot == std::string_view::npos) return {};
    std::string extension(path.substr(dot + 1));
    for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return extension;
}

const Format* sniff_mesh_format(Bytes bytes) {
    const std::string_view text = text_of(bytes);
    if (text.starts_with("ply") && text.size() > 3 && TextScanner::is_space(text[3]))
        return mesh_format_named("ply");
    if (text.starts_with("PK\x03\x04")) return mesh_format_named("3mf");
    if (looks_like_stl(bytes)) return mesh_format_named("stl");
    if (looks_like_off(bytes)) return mesh_format_named("off");
    if (looks_like_obj(bytes)) return mesh_format_named("obj");
    return nullptr;
}

}  // namespace octavo::io
