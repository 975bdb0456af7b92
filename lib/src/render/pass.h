#pragma once

#include "integrator/integrator.h"
#include "profile/time_recorder.h"
#include "render/aov_pass.h"

#include <bdpt/part/render_part.h>
#include <bdpt/path_contribution.h>
#include <bdpt/render_options.h>

#include <functional>
#include <stop_token>

namespace bdpt {

/// All that works on a tile.
struct Work {
    Integrator& integrator;
    const AovPass& aov_pass;
    const std::function<void(const PathContribution&)>& on_path;
    TimeRecorder* times = nullptr;  ///< if times are recorded
    /// Told what the samples of each tile were in work, on many threads at once; if it is there.
    std::function<void(const Tile&, const RenderStats&)> on_tile{};
    std::stop_token abandon{};  ///< ends a pass in its middle
};

/// Renders `samples` of all pixels into `result`, on the threads that oneTBB gives: at once, or, if
/// the integrator takes fewer in a pass, one such pass after the other. What is abandoned leaves
/// `result` with some of the samples, and without a note of them.
void render_pass(const Work& work, const RenderOptions& options, SampleRange samples,
                 RenderPart& result);

/// What the film of a render has room for.
[[nodiscard]] FilmLayout film_layout(const RenderOptions& options);

}  // namespace bdpt
