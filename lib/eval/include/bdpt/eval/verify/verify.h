#pragma once

/// @file
/// Tests whether all strategies and integrators agree on a scene.
///
/// @code{.cpp}
/// bool agree(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     const bdpt::eval::VerifyOptions options = {.max_depth = 4, .seconds = 30.0};
///     const bdpt::eval::VerifyReport report = bdpt::eval::verify(scene, camera, options);
///     return report.verdict == bdpt::eval::Verdict::pass;
/// }
/// @endcode

#include <bdpt/eval/verify/verify_options.h>
#include <bdpt/eval/verify/verify_report.h>
#include <bdpt/export.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

namespace bdpt::eval {

/// Verifies the estimators on a scene: renders it by all integrators and compares each strategy of
/// bdpt with all that find the same paths, and the other integrators with bdpt, for each path
/// length, in the whole image and in tiles. docs/verify.md describes the method. Blocks until the
/// result is sharp enough, the time is up or a stop is requested; at least eight batches are
/// rendered. Results are bit-identical for equal options and numbers of batches. Throws `Error`:
/// usage for options out of range, invalid_input for an unusable camera.
[[nodiscard]] BDPT_EXPORT VerifyReport verify(const Scene& scene, const CameraDesc& camera,
                                              const VerifyOptions& options,
                                              const VerifyControl& control = {});

}  // namespace bdpt::eval
