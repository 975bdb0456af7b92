#pragma once

#include <bdpt/io/exr.h>
#include <bdpt/part/sample_set.h>
#include <bdpt/render_options.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/groups/denoise_arguments.h"
#include "options/groups/display_arguments.h"
#include "options/groups/strategy_arguments.h"
#include "options/option_list.h"
#include "terminal/console.h"

namespace bdpt::app {

/// What a file that is there already means to the render that would write it.
enum class ExistingPart : std::uint8_t { go_on, restart };

/// The file that a render goes on with.
struct PartChoice {
    std::filesystem::path file{};
    ExistingPart existing = ExistingPart::go_on;
    std::optional<std::filesystem::path> plan{};  ///< that the render must be one of
    std::string task{};                           ///< of it: its number, or where that is
};

/// Adds --part, --restart, --plan and --task.
void add_part_options(OptionList& options, PartChoice& part);

/// `part` where --part is given. Throws `OptionError`.
[[nodiscard]] std::optional<PartChoice> checked(const PartChoice& part, const OptionList& options);

/// How .exr files store what they hold.
struct ExrFormat {
    io::ExrChannelType channel_type = io::ExrChannelType::single_float;
    io::ExrStorage storage = io::ExrStorage::scanlines;
};

/// Adds --half.
void add_half_option(OptionList& options, ExrFormat& exr);
/// Adds --tiled.
void add_tiled_option(OptionList& options, ExrFormat& exr);

/// What a command prints.
struct Printed {
    Format format = Format::text;
    Verbosity verbosity = Verbosity::normal;
};

/// Adds -q,--quiet; `help` says what is printed all the same.
void add_quiet_option(OptionList& options, Printed& printed,
                      std::string help = "Print errors only");
/// Adds --json; `help` says what is printed.
void add_json_option(OptionList& options, Printed& printed, std::string help);

/// What becomes of a merge of which samples are missing.
enum class Incomplete : std::uint8_t { refuse, write };

/// What `bdpt merge` is to do.
struct MergeArguments {
    std::vector<std::filesystem::path> parts{};
    std::vector<std::filesystem::path> outputs{};
    std::optional<std::filesystem::path> strategies{};  ///< .exr for the images of strategies
    std::optional<std::filesystem::path> plan{};        ///< whose parts they are
    std::size_t image = 0;                              ///< of the plan
    std::optional<SampleSet> goal{};                    ///< that the plan has for each image
    std::optional<double> wait{};                       ///< [s] for parts to come; may be infinite
    std::optional<std::int64_t> samples{};              ///< per pixel, that the render was to have
    std::optional<double> noise{};                      ///< as noise_of(), that it was to have
    Incomplete incomplete = Incomplete::refuse;
    DisplayArguments display{};
    std::optional<DenoiseArguments> denoise{};  ///< if images are to be denoised
    ExrFormat exr{};
    Printed printed{};
};

/// The options of `bdpt merge`, as they are given.
struct MergeRequest {
    MergeArguments arguments{};
    StrategyFiles strategies{};
    DenoiseArguments denoise{};
};

/// Is `file` named as a part of a render: NAME.part.exr?
[[nodiscard]] bool is_part_name(const std::filesystem::path& file);

extern const char* const merge_footer;

/// Adds the options of `bdpt merge`.
void add_merge_options(OptionList& options, MergeRequest& request);

/// Throws `OptionError` for options that do not go together.
[[nodiscard]] MergeArguments checked(const MergeRequest& request, const OptionList& options);

}  // namespace bdpt::app
