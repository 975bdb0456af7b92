#include "report/render_files.h"

#include "options/arguments.h"
#include "options/values/output_files.h"
#include "report/stats_file.h"
#include "report/strategy_files.h"

namespace bdpt::app {

std::vector<std::filesystem::path> all_image_files(const RenderArguments& arguments)
{
    std::vector<std::filesystem::path> files = arguments.outputs;
    if (arguments.strategies) {
        const auto more = arguments.strategies->both();
        files.insert(files.end(), more.begin(), more.end());
    }
    return files;
}

std::vector<std::filesystem::path> check_files(const RenderArguments& arguments)
{
    if (arguments.outputs.empty() && !arguments.part) {
        throw OptionError("--output is required");
    }
    std::vector<std::filesystem::path> taken{arguments.file};
    if (arguments.environment) {
        taken.emplace_back(*arguments.environment);
    }
    if (arguments.volume) {
        taken.push_back(arguments.volume->file);
    }
    if (arguments.rates && arguments.rates->file) {
        taken.push_back(*arguments.rates->file);
    }
    const std::vector<std::filesystem::path> inputs = taken;
    check_outputs(arguments.outputs, inputs);
    taken.insert(taken.end(), arguments.outputs.begin(), arguments.outputs.end());
    std::vector<std::filesystem::path> written = all_image_files(arguments);
    if (arguments.strategies) {
        check_strategy_files(*arguments.strategies, taken);
        const auto more = arguments.strategies->both();
        taken.insert(taken.end(), more.begin(), more.end());
    }
    if (arguments.rates && arguments.rates->saved) {
        written.push_back(*arguments.rates->saved);
        check_outputs(written, inputs);
        taken.push_back(*arguments.rates->saved);
    }
    if (arguments.part) {
        check_part_file(arguments.part->file, taken);
        taken.push_back(arguments.part->file);
        written.push_back(arguments.part->file);
    }
    if (arguments.stats) {
        check_stats_file(*arguments.stats, taken);
        written.push_back(*arguments.stats);
    }
    return written;
}

}  // namespace bdpt::app
