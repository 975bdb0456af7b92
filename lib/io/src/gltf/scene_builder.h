#pragma once

#include "file/warnings.h"
#include "gltf/prepass.h"

#include <bdpt/io/gltf.h>

#include <cstddef>
#include <optional>
#include <string>

namespace bdpt::io {

/// The scene that a user asked for by name or index, else the default one, else the first; none if
/// the document has no scenes. Throws `Error` (not_found) that lists the scenes there are.
[[nodiscard]] std::optional<std::size_t> select_scene(const Json& document,
                                                      const std::optional<std::string>& wanted);

/// Turns one scene of a document (none: all its root nodes) into a description and cameras; meshes,
/// materials and pictures that it does not use are left out. Throws `Error`.
[[nodiscard]] LoadedScene build_scene(CheckedGltf checked, std::optional<std::size_t> scene,
                                      const ReadLimits& limits, Warnings& warnings);

}  // namespace bdpt::io
