#pragma once

#include <bdpt/part/identity.h>
#include <bdpt/shared_scene_desc.h>

#include <array>
#include <tuple>
#include <vector>

namespace bdpt {

/// Identity components of a scene, by the members of the description.
using SceneComponents =
    std::array<std::vector<IdentityComponent>,
               std::tuple_size_v<std::remove_cv_t<decltype(fields<SceneDesc>)>>>;

/// Returns the components of `scene`. `known` are those of `before`: lists that both descriptions
/// share are not hashed again.
[[nodiscard]] SceneComponents scene_components(const SharedSceneDesc& scene,
                                               const SharedSceneDesc& before,
                                               const SceneComponents& known);

/// Returns all components, in order.
[[nodiscard]] std::vector<IdentityComponent> joined(const SceneComponents& components);

/// Returns the components of a scene that shares nothing.
[[nodiscard]] std::vector<IdentityComponent> identity_components(const SharedSceneDesc& scene);

}  // namespace bdpt
