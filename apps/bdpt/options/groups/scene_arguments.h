#pragma once

#include <bdpt/io/gltf.h>

#include <cstdint>
#include <optional>

#include "options/option_list.h"

namespace bdpt::app {

/// Adds --scene, --variant, --frame-time, --animation and --shutter, which select the part of a
/// file to load, --ktx-library, --allow-folder, --ignore-required and --strict, which control
/// loading, and
/// --max-memory [bytes].
void add_scene_options(OptionList& options, io::GltfOptions& scene,
                       std::optional<std::uint64_t>& max_memory);

}  // namespace bdpt::app
