#pragma once

#include <bdpt/io/denoise.h>

#include <optional>
#include <string>
#include <vector>

#include "options/render_arguments.h"
#include "report/part/part_keeper.h"
#include "report/viewer/display.h"
#include "stage/prepared_scene.h"
#include "terminal/console.h"
#include "terminal/interrupt.h"

namespace bdpt::app {

/// What the views of a command have in common.
struct RenderSession {
    Console& console;
    Interrupt& interrupt;
    Display* display;                ///< null: nobody watches
    const io::Denoiser* denoiser;    ///< null: images stay as they are
    std::vector<std::string> words;  ///< of a command that renders this image
};

/// How messages call the image that `arguments` make.
[[nodiscard]] ImageLabel label_of(const RenderArguments& arguments);

/// Renders what the camera of `stage` sees, goes on with the part of `keeper` if there is one, and
/// writes all files that `asked` names. From then on the session may be stopped, and what is there
/// is written. Throws `Error`; what went wrong with the part comes after the images are written.
void render_view(const RenderArguments& asked, const PreparedScene& stage,
                 std::optional<PartKeeper>& keeper, const RenderSession& session);

}  // namespace bdpt::app
