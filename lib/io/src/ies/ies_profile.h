#pragma once

#include "file/warnings.h"
#include "ies/ies_file.h"

#include <bdpt/scene_desc.h>

#include <string>

namespace bdpt::io {

/// A light profile and how its axes lie in a luminaire that points down -z [EXT_lights_ies,
/// "Coordinate System Mapping"].
struct IesProfile {
    LightProfile profile;
    Mat3 node_from_profile{1.0f};  ///< rotation
};

/// Completes what symmetry leaves out of a file. Throws `Error` (invalid_input) for angles that its
/// photometry does not have.
[[nodiscard]] IesProfile make_profile(const IesFile& file, const std::string& place,
                                      Warnings& warnings);

}  // namespace bdpt::io
