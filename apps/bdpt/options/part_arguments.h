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
#include "terminal/console.h"

namespace CLI {
class App;
}

namespace bdpt::app {

/// What the words after `bdpt render` say about parts, as they were given.
struct PartWords {
    std::optional<std::string> file;
    bool restart = false;
    std::optional<std::string> plan;
    std::optional<std::string> task;  ///< of the plan
    std::optional<std::string> samples;
};

/// What a file that is there already means to the render that would write it.
enum class ExistingPart : std::uint8_t { go_on, restart };

/// The file that a render goes on with.
struct PartChoice {
    std::filesystem::path file;
    ExistingPart existing = ExistingPart::go_on;
    std::optional<std::filesystem::path> plan{};  ///< that the render must be one of
    std::string task{};                           ///< of it: its number, or where that is
};

/// Describes --part, --restart, --plan and --task to the parser.
void add_part_options(CLI::App& command, PartWords& words, const char* group);

/// Describes --samples to the parser.
void add_samples_option(CLI::App& command, PartWords& words, const char* group);

/// None without --part. Throws `OptionError`.
[[nodiscard]] std::optional<PartChoice> part_choice(const PartWords& words);

/// The samples of --samples, if that was given. Throws `OptionError`.
[[nodiscard]] std::optional<SampleRange> sample_range(const PartWords& words);

/// What the words after `bdpt merge` say, as they were given.
struct MergeWords {
    std::vector<std::string> parts;
    std::vector<std::string> outputs;
    std::optional<std::string> plan;
    std::optional<std::int64_t> samples;
    std::string wait;  // "" not at all, or a time
    std::optional<std::string> noise;
    bool partial = false;
    std::optional<std::string> strategies;
    DisplayWords display;
    DenoiseWords denoise;
    bool half = false;
    bool tiled = false;
    bool quiet = false;
    bool json = false;
};

/// What becomes of a merge of which samples are missing.
enum class Incomplete : std::uint8_t { refuse, write };

/// The same, understood and checked.
struct MergeArguments {
    std::vector<std::filesystem::path> parts;
    std::vector<std::filesystem::path> outputs;
    std::optional<std::filesystem::path> strategies;  ///< .exr for the images of strategies
    std::optional<std::filesystem::path> plan;        ///< whose parts they are
    std::size_t image = 0;                            ///< of the plan
    std::optional<SampleSet> goal;                    ///< that the plan has for each image
    std::optional<double> wait;                       ///< [s] for parts to come; may be infinite
    std::optional<std::int64_t> samples;              ///< per pixel, that the render was to have
    std::optional<double> noise;                      ///< as noise_of(), that it was to have
    Incomplete incomplete = Incomplete::refuse;
    DisplayArguments display;
    std::optional<DenoiseArguments> denoise;  ///< if images are to be denoised
    io::ExrChannelType channel_type = io::ExrChannelType::single_float;
    io::ExrStorage storage = io::ExrStorage::scanlines;
    Format format = Format::text;
    Verbosity verbosity = Verbosity::normal;
};

/// Is `file` named as a part of a render: NAME.part.exr?
[[nodiscard]] bool is_part_name(const std::filesystem::path& file);

/// Describes the options of `bdpt merge` to the parser, which will store into `words`.
void add_merge_options(CLI::App& command, MergeWords& words);

/// Throws `Error` (usage) that names the option and the value.
[[nodiscard]] MergeArguments understand(const MergeWords& words);

}  // namespace bdpt::app
