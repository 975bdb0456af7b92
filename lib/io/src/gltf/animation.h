#pragma once

#include "file/warnings.h"
#include "gltf/data_budget.h"
#include "gltf/model.h"

#include <bdpt/io/gltf.h>

#include <cstddef>
#include <string>
#include <vector>

namespace bdpt::io {

/// Which animations of a file play, by index; none: nodes rest as the file has them. `names` are
/// those of all its animations. Throws `Error` (not_found, usage).
[[nodiscard]] std::vector<std::size_t> select_animations(const std::vector<std::string>& names,
                                                         const GltfOptions& options,
                                                         Warnings& warnings);

/// Puts the nodes of the model where an animation has them at a time [s]: translation, rotation,
/// scale and weights of morph targets. Throws `Error` (invalid_input) for key frames that make no
/// sense.
void apply_animation(GltfModel& model, std::size_t animation, double time, DataBudget& budget,
                     Warnings& warnings);

}  // namespace bdpt::io
