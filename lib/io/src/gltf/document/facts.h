#pragma once

#include "gltf/document/prepass.h"

#include <bdpt/io/gltf.h>

namespace bdpt::io {

/// What a document says and holds; without the index of the loaded scene. It has an "asset".
[[nodiscard]] GltfFacts collect_facts(const CheckedGltf& checked);

}  // namespace bdpt::io
