#pragma once

#include <bdpt/part/identity.h>
#include <bdpt/scene_desc.h>

#include <vector>

namespace bdpt {

/// What the bits of a render depend on in its scene.
[[nodiscard]] std::vector<IdentityComponent> identity_components(const SceneDesc& scene);

}  // namespace bdpt
