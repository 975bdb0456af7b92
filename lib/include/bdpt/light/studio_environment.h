#pragma once

#include <bdpt/export.h>
#include <bdpt/light_desc.h>

namespace bdpt {

/// A photographer's studio, for objects that are seen from the front as `frame_scene` does: a large
/// soft box high on the left, a weaker and narrow one on the right, a strip high behind, a floor
/// that reflects them and grey walls. Its radiance is 1 nit on average, as that of
/// `default_environment`; the same bits on all machines.
[[nodiscard]] BDPT_EXPORT EnvironmentLightDesc studio_environment();

}  // namespace bdpt
