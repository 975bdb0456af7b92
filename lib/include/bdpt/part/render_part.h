#pragma once

#include <bdpt/export.h>
#include <bdpt/film/aov_film.h>
#include <bdpt/film/film.h>
#include <bdpt/film/id_film.h>
#include <bdpt/film/strategy_film.h>
#include <bdpt/part/identity.h>
#include <bdpt/part/sample_set.h>
#include <bdpt/render_stats.h>

namespace bdpt {

/// The sums of some samples of a render, and the set of these samples. Parts of one render add up,
/// in any order, to the bit: a part is a checkpoint, the result of one machine of a farm, or the
/// whole render.
struct RenderPart {
    Identity identity;  ///< of the render
    SampleSet samples;  ///< that the films hold, of every pixel
    Film film;
    AovFilm aovs;             ///< empty if none were asked for
    IdFilm ids;               ///< likewise
    StrategyFilm strategies;  ///< empty if none were asked for
    RenderStats stats;
    double cpu_seconds = 0.0;  ///< [s] of the process, while it rendered these samples
};

/// Adds the samples of `other` to `part`. Throws `Error` (invalid_input) when they are of another
/// render, saying in what it differs, or when `part` has some of them already.
BDPT_EXPORT void merge(RenderPart& part, const RenderPart& other);

}  // namespace bdpt
