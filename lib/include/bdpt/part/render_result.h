#pragma once

/// @file
/// The samples of a render: what render() returns, and what adds up to one render.
///
/// @code{.cpp}
/// void render_in_two(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     bdpt::RenderOptions options{.sampling = {.samples = {0, 32}}};
///     bdpt::RenderResult sum = bdpt::render(scene, camera, options);
///     options.sampling.samples = {32, 64};
///     bdpt::merge(sum, bdpt::render(scene, camera, options));
///     std::cout << sum.samples.text() << '\n';  // 0:64
///     bdpt::io::write_exr("sum.exr", sum.image(), {});
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/film/aov_film.h>
#include <bdpt/film/film.h>
#include <bdpt/film/id_film.h>
#include <bdpt/film/strategy_film.h>
#include <bdpt/image.h>
#include <bdpt/part/identity.h>
#include <bdpt/part/sample_set.h>
#include <bdpt/render_stats.h>

#include <optional>

namespace bdpt {

/// The sums of samples of a render, and the set of these samples: of all of them, or of a part,
/// such as a checkpoint or the share of one machine of a farm. Parts of one render can be merged in
/// any order with bit-identical results.
struct RenderResult {
    Identity identity;  ///< identity of the render
    SampleSet samples;  ///< samples of every pixel that the films hold
    Film film;
    AovFilm aovs;             ///< empty if none were requested
    IdFilm ids;               ///< empty if none were requested
    StrategyFilm strategies;  ///< empty if none were requested
    RenderStats stats;
    double seconds = 0.0;      ///< time of the calls that rendered these samples [s]; not in files
    double cpu_seconds = 0.0;  ///< CPU time of the process while it rendered these samples [s]

    /// Returns the linear radiance [nit] of the film's region.
    [[nodiscard]] Image image() const { return film.develop(); }
};

/// Adds the samples of `other` to `result`. Throws `Error` (invalid_input) if they belong to
/// another render (the message names the difference), or if `result` already has some of them.
BDPT_EXPORT void merge(RenderResult& result, const RenderResult& other);

}  // namespace bdpt
