// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <octavo/base/result.hpp>
#include <octavo/base/vec3.hpp>
#include <octavo/mesh/mesh.hpp>

// One XML part of a 3MF file: its objects and its build list as they stand there, with nothing yet put into
// place.

namespace octavo::io {

/// An object put somewhere: a component of another object, or an item of the build.
struct ThreeMfPlacement {
    std::string part;  ///< of the production extension; empty: the same part
    std::uint32_t object = 0;
    Affine transform;
};

struct ThreeMfObject {
    std::uint32_t id = 0;
    std::string type;  ///< "model", "support", …
    std::vector<Vec3> vertices;
    std::vector<mesh::Triangle> triangles;
    std::vector<ThreeMfPlacement> components;  ///< when it has no mesh of its own
};

struct ThreeMfPart {
    std::string name;
    std::string unit;
    std::vector<ThreeMfObject> objects;
    std::vector<ThreeMfPlacement> build;
    std::unordered_map<std::uint32_t, std::size_t> object_of_id;  ///< the first, when several have one id
    std::set<std::string_view> left_behind;  ///< kinds of data that are not read; texts that live for ever

    /// The object of that id; nullptr when there is none.
    const ThreeMfObject* find(std::uint32_t id) const {
        const auto at = object_of_id.find(id);
        return at == object_of_id.end() ? nullptr : &objects[at->second];
    }
};

/// Reads the XML of the part `name`.
Result<ThreeMfPart> read_three_mf_part(std::string_view xml, const std::string& name);

/// The part that the archive's relationships name as the model; empty when they do not.
std::string three_mf_model_part(std::string_view relationships_xml);

/// Millimetres in a unit of 3MF; 0 for an unknown one.
double millimetres_in(std::string_view unit);

}  // namespace octavo::io
