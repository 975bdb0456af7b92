#pragma once

#include "integrator/integrator.h"
#include "render/aov_pass.h"

#include <bdpt/part/render_result.h>
#include <bdpt/path_contribution.h>
#include <bdpt/render_options.h>

#include <functional>
#include <stop_token>

namespace bdpt {

/// Objects that render a tile.
struct Work {
    Integrator& integrator;
    const AovPass& aov_pass;
    const std::function<void(const PathContribution&)>& on_path;
    /// Receives the amount of work for the samples of each tile, on many threads at once, if set.
    std::function<void(const Tile&, const RenderStats&)> on_tile{};
    std::stop_token abandon{};  ///< ends a pass in its middle
};

/// Renders `samples` of all pixels into `result`, on the threads that oneTBB provides: at once, or,
/// if the integrator limits the samples per pass, in several passes. An abandoned pass leaves
/// `result` with some of the samples, without recording them.
void render_pass(const Work& work, const RenderOptions& options, SampleRange samples,
                 RenderResult& result);

/// Returns the layout of a render's film.
[[nodiscard]] FilmLayout film_layout(const RenderOptions& options);

}  // namespace bdpt
