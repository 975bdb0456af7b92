#pragma once

#include <bdpt/render_options.h>

#include <cstdint>
#include <optional>
#include <stop_token>

#include "options/render_arguments.h"
#include "stage/prepared_scene.h"
#include "terminal/console.h"

namespace bdpt::app {

/// Memory for decoded images that stay from frame to frame [bytes]: a quarter of the limit, but not
/// more than 2 GiB.
[[nodiscard]] std::uint64_t image_cache_bytes(const RenderArguments& arguments);

/// Loads the scene, and shows on the console how far it is. Throws `Error`.
[[nodiscard]] PreparedScene prepare_with_progress(const RenderArguments& arguments,
                                                  Console& console);

/// Tells what was noticed while the scene was prepared: warnings and notes, each once.
void tell_findings(Console& console, const PreparedScene& stage);

/// Takes what the film of a render of `size` and its layers need. Throws `Error` if that is too
/// much.
void spend_film(io::MemoryBudget& memory, const RenderOptions& options, const Size& size);

/// Loads the scene into the memory that the film and the cache of images, if there is one, leave of
/// `arguments.memory`, and shows on the console how far it is. Throws `Error`.
[[nodiscard]] PreparedScene prepare_within_memory(const RenderArguments& arguments,
                                                  Console& console);

/// About which share of the light `arguments`, which have all their options, leave out as their
/// paths may not be longer, in [0, 1]; 0 if it is below 1 % or if nothing but emitted and direct
/// light is asked for. By a short render.
[[nodiscard]] double light_beyond_max_depth(const RenderArguments& arguments,
                                            const PreparedScene& stage);

/// Is the light metered, for the exposure of images? It is where `--exposure light` says so, before
/// a background and for frames, and, unless another exposure is asked for, where bdpt itself has
/// made the light from infinity and the camera stands outside of the scene.
[[nodiscard]] bool meters_light(const RenderArguments& arguments, const PreparedScene& stage);

/// The exposure [EV] that makes a white card white which lies on what `seen` shows of the scene;
/// none where no light falls on it.
[[nodiscard]] std::optional<float> metered_exposure(const PreparedScene& stage,
                                                    const Viewpoint& seen);

/// `arguments` with all their options: size, samples and limits of memory filled in, and what is
/// left open chosen by a pilot; and with rates of samples, unless they have them already, from a
/// file or another pilot. A request of `abandon` ends the first pilot early; the result is then of
/// no use. Throws `Error`.
[[nodiscard]] RenderArguments with_choice(RenderArguments arguments, const PreparedScene& stage,
                                          Console& console, const std::stop_token& abandon = {});

}  // namespace bdpt::app
