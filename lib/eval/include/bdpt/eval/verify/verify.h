#pragma once

#include <bdpt/eval/verify/verify_options.h>
#include <bdpt/eval/verify/verify_report.h>
#include <bdpt/export.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

namespace bdpt::eval {

/// Proves the estimators on a scene: renders it by all integrators, holds each strategy of bdpt
/// against all that find the same paths, and the other integrators against bdpt, for each length of
/// paths, in the whole image and in tiles. docs/verify.md tells how. Blocks until the result is
/// sharp enough, the time is up or a stop is requested; at least eight batches are rendered. Equal
/// to the bit for equal options and number of batches. Throws `Error`: usage for options out of
/// range, invalid_input for a camera that is not usable.
[[nodiscard]] BDPT_EXPORT VerifyReport verify(const Scene& scene, const CameraDesc& camera,
                                              const VerifyOptions& options,
                                              const VerifyControl& control = {});

}  // namespace bdpt::eval
