#pragma once

#include "gltf/document/prepass.h"

#include <bdpt/io/gltf.h>

namespace bdpt::io {

/// Collects the facts about a document, without the index of the loaded scene. The document has an
/// "asset".
[[nodiscard]] GltfFacts collect_facts(const CheckedGltf& checked);

}  // namespace bdpt::io
