#pragma once

/// @file
/// Makes the light of a photographer's studio.
///
/// @code{.cpp}
/// const bdpt::Scene scene(bdpt::io::load_gltf("shoe.glb").scene);
/// const bdpt::Scene lit = scene.with_environment(bdpt::studio_environment());
/// @endcode

#include <bdpt/export.h>
#include <bdpt/light_desc.h>

namespace bdpt {

/// Returns a photographic studio for objects seen from the front, as by `frame_scene`: a large soft
/// box high on the left, a weaker and narrow one on the right, a strip high behind, a floor that
/// reflects them and grey walls. Its mean radiance is 1 nit, like that of `default_environment`;
/// bit-identical on all machines.
[[nodiscard]] BDPT_EXPORT EnvironmentLightDesc studio_environment();

}  // namespace bdpt
