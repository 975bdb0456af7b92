#pragma once

#include <bdpt/part/identity.h>
#include <bdpt/shared_scene_desc.h>

#include <array>
#include <tuple>
#include <vector>

namespace bdpt {

/// What the bits of a render depend on in its scene, by the members of the description.
using SceneComponents =
    std::array<std::vector<IdentityComponent>,
               std::tuple_size_v<std::remove_cv_t<decltype(fields<SceneDesc>)>>>;

/// `known` are those of `before`: what both descriptions share is not hashed again.
[[nodiscard]] SceneComponents scene_components(const SharedSceneDesc& scene,
                                               const SharedSceneDesc& before,
                                               const SceneComponents& known);

/// All of them, in order.
[[nodiscard]] std::vector<IdentityComponent> joined(const SceneComponents& components);

/// The same of a scene that shares nothing.
[[nodiscard]] std::vector<IdentityComponent> identity_components(const SharedSceneDesc& scene);

}  // namespace bdpt
