#pragma once

#include "file/load_context.h"
#include "gltf/document/prepass.h"

#include <bdpt/io/gltf.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace bdpt::io {

/// Selects the scene that the user named or indexed, else the default one, else the first; none if
/// the document has no scenes. Throws `Error` (not_found) that lists the available scenes.
[[nodiscard]] std::optional<std::size_t> select_scene(const Json& document,
                                                      const std::optional<std::string>& wanted);

/// Selected parts of a document, by index.
struct SceneChoice {
    std::optional<std::size_t> scene;     ///< none: all root nodes
    std::optional<std::size_t> variant;   ///< none: the materials of the primitives
    std::vector<std::size_t> animations;  ///< played one after the other; empty: nodes rest
    double time = 0.0;                    ///< time in the animations [s]
    Shutter shutter{};                    ///< relative to `time`
};

/// Converts one scene of a document to a description and cameras; meshes, materials and images that
/// it does not use are left out. Throws `Error`.
[[nodiscard]] LoadedScene build_scene(CheckedGltf checked, const SceneChoice& choice,
                                      const std::function<void(const LoadProgress&)>& on_progress,
                                      LoadContext& context);

}  // namespace bdpt::io
