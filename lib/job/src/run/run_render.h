#pragma once

#include <bdpt/io/denoise.h>
#include <bdpt/job.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "messages/console.h"
#include "options/render_arguments.h"
#include "output/display.h"
#include "output/parts.h"
#include "stage/prepared_scene.h"

namespace bdpt::job {

/// Returns `asked` for `scene`, whose name replaces the placeholders in file names. Without outputs
/// it gets its default one.
[[nodiscard]] RenderArguments for_scene(const RenderArguments& asked,
                                        const std::filesystem::path& scene);

/// Renders one scene and writes all files: `bdpt render` and `bdpt::run`. `words` are the
/// equivalent command line. What happens is told to `console`; `interrupt` stops the render. Throws
/// `Error` before anything is written, or if writing fails.
[[nodiscard]] JobResult run_render(const RenderArguments& arguments,
                                   const std::vector<std::string>& words, Console& console,
                                   Interrupt& interrupt);

/// Adds a cache of images, if the file is loaded for several frames.
[[nodiscard]] RenderArguments with_image_cache(RenderArguments arguments);

/// What files for screens of all views of a scene share.
struct SharedByViews {
    bool is_metered = false;                   ///< `exposure` is known
    std::optional<float> exposure{};           ///< by the light of the first one, if any [EV]
    std::optional<std::vector<Aov>> guides{};  ///< layers for automatic denoising
    std::optional<bool> has_ground{};          ///< though it was not requested
};

/// Returns `image`, a view of `asked`, with the exposure and the layers that its files for screens
/// need, and charges their memory. Without memory for automatic denoising `denoiser` is closed.
/// Throws `Error`.
[[nodiscard]] RenderArguments completed_for_screens(RenderArguments image,
                                                    const RenderArguments& asked,
                                                    PreparedScene& stage,
                                                    std::optional<io::Denoiser>& denoiser,
                                                    SharedByViews& shared, Console& console);

/// State shared by the views of a job.
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

/// Loads the scene, chooses the options left open, and writes the plan and the files of its engine:
/// `bdpt plan`. Throws `Error`.
void make_plan(const PlanArguments& arguments, Console& console);

/// Merges parts of a render and writes its images: `bdpt merge`. Returns the message about samples
/// that are missing, and images that were therefore not written; none if all were. Throws `Error`.
[[nodiscard]] std::optional<std::string> merge_parts(const MergeArguments& asked, Console& console,
                                                     Interrupt& interrupt);

}  // namespace bdpt::job
