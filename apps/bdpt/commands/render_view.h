#pragma once

#include <bdpt/io/denoise.h>
#include <bdpt/job.h>

#include <optional>
#include <string>
#include <vector>

#include "options/render_arguments.h"
#include "report/display.h"
#include "report/part/part_keeper.h"
#include "stage/prepared_scene.h"
#include "terminal/console.h"
#include "terminal/interrupt.h"

namespace bdpt::app {

/// State shared by the views of a command.
struct RenderSession {
    Console& console;
    Interrupt& interrupt;
    Display* display;                ///< null: no viewer
    const io::Denoiser* denoiser;    ///< null: images are not denoised
    std::vector<std::string> words;  ///< command line that renders this image
};

/// Returns the label of the image of `arguments`, for messages.
[[nodiscard]] ImageLabel make_label(const RenderArguments& arguments);

/// Renders the view of `stage`'s camera, continuing the part of `keeper` if there is one, and
/// writes all files that `asked` names. Once it has begun, the session may be stopped, and the
/// samples so far are written. Returns none, and writes nothing, if the stop was requested before.
/// Throws `Error`; errors of the part are thrown after the images are written.
[[nodiscard]] std::optional<JobImage> render_view(const RenderArguments& asked,
                                                  const PreparedScene& stage,
                                                  std::optional<PartKeeper>& keeper,
                                                  const RenderSession& session);

}  // namespace bdpt::app
