#pragma once

#include "verify/evidence.h"

#include <bdpt/eval/verify.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <cstdint>

namespace bdpt::eval {

/// Renders batch `number` on the calling thread: a pure function of its arguments.
[[nodiscard]] Batch render_batch(const Scene& scene, const CameraDesc& camera,
                                 const VerifyOptions& options, const TileGrid& grid,
                                 std::int64_t number);

}  // namespace bdpt::eval
