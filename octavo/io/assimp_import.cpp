// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <exception>
#include <new>
#include <optional>
#include <set>
#include <utility>

#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/scene.h>

#include <octavo/io/assimp_import.hpp>
#include <octavo/io/vertex_welder.hpp>

namespace octavo::io {
namespace {

Affine affine_of(const aiMatrix4x4& m) {
    Affine result;
    for (unsigned row = 0; row < 3; ++row)
        for (unsigned column = 0; column < 4; ++column) result.m[row][column] = double{m[row][column]};
    return result;
}

/// Gathers the meshes of a scene.
class SceneReader {
  public:
    SceneReader(const aiScene& scene, const ReadOptions& options, const Context& context)
        : scene_(scene), options_(options), context_(context) {}

    Result<FileMesh> read() {
        std::vector<std::pair<const aiNode*, Affine>> waiting;
        if (scene_.mRootNode) waiting.emplace_back(scene_.mRootNode, Affine{});
        while (!waiting.empty()) {
            const auto [node, outer] = waiting.back();
            waiting.pop_back();
            const Affine transform = compose(outer, affine_of(node->mTransformation));
            for (unsigned i = 0; i < node->mNumMeshes; ++i)
                if (std::optional<Error> trouble = add(*scene_.mMeshes[node->mMeshes[i]], transform))
                    return *trouble;
            // The last child first, so that the first is the next to be taken.
            for (unsigned i = node->mNumChildren; i-- > 0;)
                waiting.emplace_back(node->mChildren[i], transform);
        }
        note_what_is_left_behind();
        result_.vertices = welder_.vertices();
        result_.warnings.push_back("read through assimp, which rounds coordinates to floats");
        return std::move(result_);
    }

  private:
    void note_what_is_left_behind() {
        for (unsigned i = 0; i < scene_.mNumMeshes; ++i) {
            const aiMesh& mesh = *scene_.mMeshes[i];
            if (mesh.HasNormals()) result_.leave_behind("normals");
            if (mesh.HasTextureCoords(0)) result_.leave_behind("texture coordinates");
            if (mesh.HasVertexColors(0)) result_.leave_behind("colours");
            if (mesh.HasBones()) result_.leave_behind("bones");
        }
        if (scene_.mNumMeshes > 1) result_.leave_behind("objects");
        // Where a file has no material, assimp adds one of its own.
        if (scene_.mNumMaterials > 1) result_.leave_behind("materials");
        if (scene_.HasTextures()) result_.leave_behind("textures");
        if (scene_.HasAnimations()) result_.leave_behind("animations");
        if (scene_.HasCameras()) result_.leave_behind("cameras");
        if (scene_.HasLights()) result_.leave_behind("lights");
    }

    std::optional<Error> add(const aiMesh& mesh, const Affine& transform) {
        if (context_.cancelled()) return Context::cancelled_error();
        faces_ += mesh.mNumFaces;
        if (faces_ > options_.max_triangles)
            return Error{
                ErrorCode::limit, "has more than " + std::to_string(options_.max_triangles) + " facets", {}};
        std::vector<mesh::VertexIndex> index;
        index.reserve(mesh.mNumVertices);
        for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
            const aiVector3D& v = mesh.mVertices[i];
            const Vec3 point = transform(Vec3{double{v.x}, double{v.y}, double{v.z}});
            if (!is_finite(point))
                return Error{ErrorCode::bad_input, "a coordinate is not a finite number", {}};
            index.push_back(welder_.add(welder_.prepare(point.x, point.y, point.z)));
        }
        const bool mirrors = transform.mirrors();
        std::vector<mesh::VertexIndex> corners;
        for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
            const aiFace& face = mesh.mFaces[i];
            corners.clear();
            for (unsigned k = 0; k < face.mNumIndices; ++k) {
                if (face.mIndices[k] >= mesh.mNumVertices)
                    return Error{ErrorCode::bad_input,
                                 "face " + std::to_string(i) + " names vertex " +
                                     std::to_string(face.mIndices[k]) + " of " +
                                     std::to_string(mesh.mNumVertices),
                                 {}};
                corners.push_back(index[face.mIndices[k]]);
            }
            if (mirrors) std::reverse(corners.begin(), corners.end());
            result_.faces.add(corners);
        }
        return {};
    }

    const aiScene& scene_;
    const ReadOptions& options_;
    const Context& context_;
    VertexWelder<double> welder_{0};
    std::uint64_t faces_ = 0;
    FileMesh result_;
};

constexpr std::array<std::string_view, 10> formats{"3ds", "amf",  "dae", "dxf", "fbx",
                                                   "glb", "gltf", "lwo", "x",   "x3d"};

/// Leaves the importers of these formats alone. Where the extension does not decide, assimp asks all that it has.
void keep_listed(Assimp::Importer& importer) {
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        Assimp::BaseImporter* const one = importer.GetImporter(i);
        std::set<std::string> extensions;
        one->GetExtensionList(extensions);
        if (std::any_of(extensions.begin(), extensions.end(), assimp_reads)) continue;
        importer.UnregisterLoader(one);
        delete one;  // who unregisters it owns it
    }
}

/// Runs an import and reads its scene; whatever assimp throws is its opinion of the file.
template <class Import>
Result<FileMesh> imported(const ReadOptions& options, const Context& context, const Import& import) try {
    Assimp::Importer importer;
    keep_listed(importer);
    const aiScene* const scene = import(importer);
    if (!scene) return Error{ErrorCode::bad_input, std::string("assimp: ") + importer.GetErrorString(), {}};
    return SceneReader(*scene, options, context).read();
} catch (const std::bad_alloc&) {
    return Error{ErrorCode::limit, "does not fit into memory", {}};
} catch (const std::exception& exception) {
    return Error{ErrorCode::bad_input, std::string("assimp: ") + exception.what(), {}};
}

}  // namespace

std::span<const std::string_view> assimp_formats() { return formats; }

bool assimp_reads(const std::string& extension) {
    return std::find(formats.begin(), formats.end(), extension) != formats.end();
}

Result<FileMesh> read_by_assimp(const std::string& path, const ReadOptions& options, const Context& context) {
    return imported(options, context, [&](Assimp::Importer& importer) { return importer.ReadFile(path, 0); });
}

Result<FileMesh> read_by_assimp(Bytes bytes, const std::string& extension, const ReadOptions& options,
                                const Context& context) {
    return imported(options, context, [&](Assimp::Importer& importer) {
        return importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, extension.c_str());
    });
}

}  // namespace octavo::io
