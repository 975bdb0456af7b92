#pragma once

#include <bdpt/eval/verify.h>
#include <bdpt/io/denoise.h>
#include <bdpt/io/gltf.h>
#include <bdpt/job.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "options/command_parser.h"
#include "options/eval_arguments.h"
#include "options/option_list.h"
#include "options/part_arguments.h"
#include "options/plan_arguments.h"
#include "options/render_arguments.h"
#include "options/view_arguments.h"
#include "report/display.h"
#include "report/part/part_keeper.h"
#include "stage/prepared_scene.h"
#include "terminal/console.h"
#include "terminal/interrupt.h"

namespace bdpt::app {

/// Arguments of `bdpt info`.
struct InfoArguments {
    std::string file{};                         ///< empty: only the limits
    io::GltfOptions scene{};                    ///< selects the part of the file to describe
    std::optional<std::uint64_t> max_memory{};  ///< [bytes]
    bool limits = false;                        ///< print the limits for reading files
    bool json = false;
};

extern const char* const info_footer;

/// Adds the options of `bdpt info`.
void add_info_options(OptionList& options, InfoArguments& arguments);

/// Runs `bdpt info`: prints the contents of a file on stdout. Returns the exit code. Throws
/// `Error`.
[[nodiscard]] int run_info(const InfoArguments& arguments, const OptionList& options);

/// Renders one scene and writes all files: `bdpt render` and `bdpt::run`. `words` are the
/// equivalent command line. What happens is told to `console`; `interrupt` stops the render. Throws
/// `Error` before anything is written, or if writing fails.
[[nodiscard]] JobResult run_render(const RenderArguments& arguments,
                                   const std::vector<std::string>& words, Console& console,
                                   Interrupt& interrupt);

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

/// Renders one scene and returns an exit code.
using RenderScene = std::function<int(const RenderArguments& arguments)>;

/// Returns `asked` for `scene`, whose name replaces the placeholders in file names. Without outputs
/// it gets its default one.
[[nodiscard]] RenderArguments for_scene(const RenderArguments& asked,
                                        const std::filesystem::path& scene);

/// Runs `bdpt render SCENE...`: renders `asked` for each of `scenes`, one after the other; "{name}"
/// in output names is replaced by the scene's name without folder and extension. Without outputs
/// each scene has its default one. The failure of a scene is reported, and the others are still
/// rendered. Returns the exit code of the first that failed. Throws `Error` before anything is
/// rendered if two scenes would write the same file, or if options are for one scene alone.
int run_render_scenes(const RenderArguments& asked,
                      const std::vector<std::filesystem::path>& scenes, const OptionList& options,
                      const RenderScene& render);

/// Runs a benchmark and writes its report. `command` is the command line as typed, for the record.
/// Returns the exit code. Throws `Error`; results of finished runs are written before.
[[nodiscard]] int run_bench(const BenchArguments& arguments,
                            const std::vector<std::string>& command);

/// Exit code if a threshold is exceeded.
constexpr int compare_failed = 10;

/// Runs `bdpt compare`: prints the errors of images against a reference on stdout. Returns the exit
/// code: 0 or `compare_failed`. Throws `Error`; if only one output cannot be written, the others
/// have been.
[[nodiscard]] int run_compare(const CompareArguments& arguments);

/// Runs `bdpt develop`: writes images for screens from an EXR file and its layers. Returns the exit
/// code; throws `Error`.
[[nodiscard]] int run_develop(const DevelopArguments& arguments);

/// Prints the paths of the sample, and writes its image of directions. Returns the exit code.
/// Throws `Error`.
int run_inspect(const InspectArguments& arguments);

/// Exit code if samples are missing.
constexpr int merge_incomplete = 12;

/// Runs `bdpt merge`: merges parts of a render. Returns the exit code: 0 or `merge_incomplete`.
/// Throws `Error`.
[[nodiscard]] int run_merge(const MergeArguments& arguments);

/// Loads the scene, chooses the options left open, and writes the plan and the files of its engine.
/// Returns the exit code. Throws `Error`.
[[nodiscard]] int run_plan(const PlanArguments& arguments);

/// Exit codes of the two verdicts that are not a pass.
constexpr int verify_failed = 10;
constexpr int verify_inconclusive = 11;

/// Returns 0 for a pass, else one of the codes above.
[[nodiscard]] int exit_code(eval::Verdict verdict);

/// Runs `bdpt verify`: prints on stdout whether all estimators agree on the scene. Returns the exit
/// code. Throws `Error`.
[[nodiscard]] int run_verify(const VerifyArguments& arguments);

/// Returns "bdpt 0.2.0", and in further lines its libraries and the ray tracing kernels that it
/// uses on this machine.
[[nodiscard]] std::string version_text();

/// Runs `bdpt view` with the given `options`. Returns the exit code: 0 after SIGINT. Throws `Error`
/// if it cannot listen, or the scene cannot be loaded.
[[nodiscard]] int run_view(const ViewArguments& arguments, const OptionList& options);

/// The commands with their options, and the structs that a command line fills in.
struct CommandLine {
    CommandLine();
    CommandLine(const CommandLine&) = delete;
    CommandLine& operator=(const CommandLine&) = delete;

    RenderRequest render;
    PlanRequest plan;
    MergeRequest merge;
    InfoArguments info;
    DevelopArguments develop;
    CompareRequest compare;
    BenchRequest bench;
    VerifyRequest verify;
    InspectRequest inspect;
    ViewRequest view;
    std::string topic;  ///< topic of `bdpt help`
    Program program;    ///< its options store into the members above
};

}  // namespace bdpt::app
