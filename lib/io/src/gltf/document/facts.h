#pragma once

#include "gltf/document/prepass.h"

#include <bdpt/io/gltf.h>

namespace bdpt::io {

/// What a checked document says and holds; without the index of the loaded scene.
[[nodiscard]] GltfFacts collect_facts(const CheckedGltf& checked);

}  // namespace bdpt::io
