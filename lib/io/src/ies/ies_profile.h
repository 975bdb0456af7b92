#pragma once

#include "file/warnings.h"
#include "ies/ies_file.h"

#include <bdpt/scene_desc.h>

#include <string>

namespace bdpt::io {

/// A light profile and the rotation of its axes in a luminaire that points down -z [EXT_lights_ies,
/// "Coordinate System Mapping"].
struct IesProfile {
    LightProfile profile;
    Mat3 node_from_profile{1.0f};  ///< rotation
};

/// Converts a file to a profile, completing it by its symmetry. Throws `Error` (invalid_input) for
/// angles that its photometry does not have.
[[nodiscard]] IesProfile make_profile(const IesFile& file, const std::string& place,
                                      Warnings& warnings);

}  // namespace bdpt::io
