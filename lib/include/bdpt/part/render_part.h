#pragma once

/// @file
/// Adds up samples of one render that were rendered separately.
///
/// @code{.cpp}
/// void render_in_two(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     bdpt::RenderOptions options{.sampling = {.samples = {0, 32}}};
///     bdpt::RenderPart sum = bdpt::render_part(scene, camera, options, {}).part;
///     options.sampling.samples = {32, 64};
///     bdpt::merge(sum, bdpt::render_part(scene, camera, options, {}).part);
///     std::cout << sum.samples.text() << '\n';  // 0:64
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/film/aov_film.h>
#include <bdpt/film/film.h>
#include <bdpt/film/id_film.h>
#include <bdpt/film/strategy_film.h>
#include <bdpt/part/identity.h>
#include <bdpt/part/sample_set.h>
#include <bdpt/render_stats.h>

namespace bdpt {

/// The sums of some samples of a render, and the set of these samples. Parts of one render can be
/// merged in any order with bit-identical results: a part is a checkpoint, the result of one
/// machine of a farm, or the whole render.
struct RenderPart {
    Identity identity;  ///< identity of the render
    SampleSet samples;  ///< samples of every pixel that the films hold
    Film film;
    AovFilm aovs;             ///< empty if none were requested
    IdFilm ids;               ///< empty if none were requested
    StrategyFilm strategies;  ///< empty if none were requested
    RenderStats stats;
    double cpu_seconds = 0.0;  ///< CPU time of the process while it rendered these samples [s]
};

/// Adds the samples of `other` to `part`. Throws `Error` (invalid_input) if they belong to another
/// render (the message names the difference), or if `part` already has some of them.
BDPT_EXPORT void merge(RenderPart& part, const RenderPart& other);

}  // namespace bdpt
