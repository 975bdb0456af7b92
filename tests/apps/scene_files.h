#pragma once

#include <filesystem>
#include <string>

#include "scratch_folder.h"

namespace bdpt::test {

/// What a scene file of the tests has beside its one cube (from -1 to 1 on all axes).
struct CubeFile {
    std::string material = R"({"pbrMetallicRoughness": {"metallicFactor": 0}})";
    std::string cameras{};    ///< elements of "nodes" that refer to cameras, each with a comma
    bool inside_out = false;  ///< faces look inwards, as the walls of a room do
    std::string more{};       ///< further members of the file's object, each with a comma
};

/// A cube as NAME.gltf with NAME.bin beside it. Camera 0 is 2:1 with a field of view of 0.8 rad,
/// camera 1 a square one of 0.4 rad.
std::filesystem::path write_cube(const ScratchFolder& folder, const std::string& name,
                                 const CubeFile& cube);

/// A cube that shines with 1 nit.
inline const std::string emissive_material = R"({"emissiveFactor": [1, 1, 1]})";

/// Nodes with cameras 0 "front", which looks at the cube from z = 5, and 1 "side", from x = 5.
inline const std::string two_cameras =
    R"({"name": "front", "camera": 0, "translation": [0, 0, 5]},
       {"name": "side", "camera": 1, "translation": [5, 0, 0],
        "rotation": [0, 0.70710678, 0, 0.70710678]},)";

}  // namespace bdpt::test
