#pragma once

#include <bdpt/io/write_image.h>
#include <bdpt/part/sample_set.h>
#include <bdpt/render_options.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "messages/console.h"
#include "options/groups/display_arguments.h"
#include "options/groups/transport_arguments.h"
#include "options/option_list.h"

namespace bdpt::job {

/// Treatment of an existing part file by the render that would write it.
enum class ExistingPart : std::uint8_t { go_on, restart };

/// The part file that a render continues.
struct PartChoice {
    std::filesystem::path file{};
    ExistingPart existing = ExistingPart::go_on;
    std::optional<std::filesystem::path> plan{};  ///< plan that the render must belong to
    std::string task{};  ///< task in the plan: its number, or where to find it
};

/// Adds --part, --restart, --plan and --task.
void add_part_options(OptionList& options, PartChoice& part);

/// Returns `part` if --part is given. Throws `OptionError`.
[[nodiscard]] std::optional<PartChoice> checked(const PartChoice& part, const OptionList& options);

/// Storage of .exr files.
struct ExrFormat {
    io::ExrChannelType channel_type = io::ExrChannelType::single_float;
    io::ExrStorage storage = io::ExrStorage::scanlines;
};

/// Adds --half.
void add_half_option(OptionList& options, ExrFormat& exr);
/// Adds --tiled.
void add_tiled_option(OptionList& options, ExrFormat& exr);

/// Output of a command on its streams.
struct Printed {
    Format format = Format::text;
    Verbosity verbosity = Verbosity::normal;
};

/// Adds -q,--quiet; `help` says what is still printed.
void add_quiet_option(OptionList& options, Printed& printed,
                      std::string help = "Print errors only");
/// Adds --json; `help` says what is printed.
void add_json_option(OptionList& options, Printed& printed, std::string help);

/// Treatment of a merge with missing samples.
enum class Incomplete : std::uint8_t { refuse, write };

/// Arguments of `bdpt merge`.
struct MergeArguments {
    std::vector<std::filesystem::path> parts{};
    std::vector<std::filesystem::path> outputs{};
    std::optional<std::filesystem::path> strategies{};  ///< .exr file of strategy images
    std::optional<std::filesystem::path> plan{};        ///< plan of the parts
    std::size_t image = 0;                              ///< index in the plan
    std::optional<SampleSet> goal{};                    ///< goal of the plan for each image
    std::optional<double> wait{};           ///< time to wait for parts [s]; may be infinite
    std::optional<std::int64_t> samples{};  ///< requested samples per pixel of the render
    std::optional<double> noise{};          ///< requested noise, as by estimate_noise()
    Incomplete incomplete = Incomplete::refuse;
    DisplayArguments display{};
    DenoiseArguments denoise{};
    ExrFormat exr{};
    Printed printed{};
};

/// Options of `bdpt merge`, as given.
struct MergeRequest {
    MergeArguments arguments{};
    StrategyFiles strategies{};
};

/// Tests whether `file` is named as a part of a render: NAME.part.exr.
[[nodiscard]] bool is_part_name(const std::filesystem::path& file);

/// Adds the options of `bdpt merge`.
void add_merge_options(OptionList& options, MergeRequest& request);

/// Checks and converts the options. Throws `OptionError` for incompatible ones.
[[nodiscard]] MergeArguments checked(const MergeRequest& request, const OptionList& options);

}  // namespace bdpt::job
