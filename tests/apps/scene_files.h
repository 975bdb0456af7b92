#pragma once

#include <filesystem>
#include <string>

#include "scratch_folder.h"

namespace bdpt::test {

/// Cameras 0 and 1: 2:1 with a field of view of 0.8 rad, and square with 0.4 rad.
inline const std::string plain_cameras = R"(
    {"type": "perspective", "perspective": {"yfov": 0.8, "aspectRatio": 2, "znear": 0.01}},
    {"type": "perspective", "perspective": {"yfov": 0.4, "aspectRatio": 1, "znear": 0.01}})";

/// Camera 0 sees 6 m x 3 m in parallel, camera 1 has a lens.
inline const std::string special_cameras = R"(
    {"type": "orthographic",
     "orthographic": {"xmag": 3, "ymag": 1.5, "znear": 0.01, "zfar": 100}},
    {"type": "perspective", "perspective": {"yfov": 0.4, "aspectRatio": 1, "znear": 0.01},
     "extras": {"lensRadius": 0.5, "focusDistance": 4}})";

/// What a scene file of the tests has beside its one cube (from -1 to 1 on all axes).
struct CubeFile {
    std::string material = R"({"pbrMetallicRoughness": {"metallicFactor": 0}})";
    std::string cameras{};    ///< elements of "nodes" that refer to cameras, each with a comma
    bool inside_out = false;  ///< faces look inwards, as the walls of a room do
    std::string camera_kinds = plain_cameras;
    std::string more{};    ///< further members of the file's object, each with a comma
    int camera_nodes = 2;  ///< elements of `cameras`, lights among them
};

/// A grey room whose walls shine, seen from within (camera 0) and from its middle (1).
CubeFile shining_room();

/// A cube as NAME.gltf with NAME.bin beside it.
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
