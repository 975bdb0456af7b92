#include "options/groups/rates_arguments.h"

#include <CLI/CLI.hpp>

#include "options/arguments.h"
#include "options/values/output_files.h"

namespace bdpt::app {

void add_rates_options(CLI::App& command, RatesWords& words, const char* group)
{
    CLI::Option* adaptive =
        command
            .add_flag("--adaptive", words.adaptive,
                      "Adaptive sampling: more samples where the image is noisy, fewer where it is "
                      "not, from a quarter of --spp to four times as many; --spp is their mean, a "
                      "multiple of 8. A test render of 8 samples per pixel finds out where. "
                      "Unbiased. Not for lt and vcm")
            ->group(group);
    command
        .add_option("--rates", words.file,
                    "The same by an .exr that --save-rates has written, without a test render")
        ->excludes(adaptive)
        ->type_name("FILE")
        ->group(group);
}

void add_save_rates_option(CLI::App& command, RatesWords& words, const char* group)
{
    command
        .add_option("--save-rates", words.saved,
                    "Write how many samples pixels take, in units of --spp: .exr for --rates, or "
                    ".png in false colours")
        ->type_name("FILE")
        ->group(group);
}

std::optional<RatesChoice> rates_choice(const RatesWords& words)
{
    if (!words.adaptive && !words.file) {
        if (words.saved) {
            reject("--save-rates", *words.saved, "--adaptive or --rates beside it");
        }
        return std::nullopt;
    }
    if (words.saved && !has_extension(*words.saved, ".exr") &&
        !has_extension(*words.saved, ".png")) {
        reject("--save-rates", *words.saved, "a file that is named .exr or .png");
    }
    return RatesChoice{.file = words.file, .saved = words.saved};
}

}  // namespace bdpt::app
