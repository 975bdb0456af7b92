#include "report/render_files.h"

#include <bdpt/error.h>
#include <bdpt/eval/image/contact_sheet.h>
#include <bdpt/eval/image/false_color.h>
#include <bdpt/io/output_file.h>
#include <bdpt/io/png.h>
#include <bdpt/io/rates_file.h>
#include <fmt/core.h>

#include <algorithm>
#include <string_view>
#include <system_error>

#include "options/arguments.h"
#include "options/values/output_files.h"
#include "options/values/pipes.h"

namespace bdpt::app {

namespace fs = std::filesystem;

void check_strategy_files(const StrategyFiles& files, const FileSet& inputs, const FileSet& outputs)
{
    for (const fs::path& file : files.both()) {
        if (inputs.contains(file) || outputs.contains(file)) {
            throw Error(
                ErrorCode::usage,
                fmt::format(
                    "--strategies \"{}\": {} is an input or another output", files.layers.string(),
                    file == files.layers ? "it" : "the sheet " + file.string() + " beside it"));
        }
        io::check_writable(file);
    }
}

void write_strategy_files(const StrategyFiles& files, const Image& image,
                          const StrategyFilm& strategies, const io::ExrOptions& options,
                          float exposure)
{
    io::write_exr(files.layers, image, strategies.develop(), options);
    io::write_png(files.sheet, eval::contact_sheet(strategies, exposure),
                  {.exposure = exposure, .metadata = options.metadata});
}

void save_rates(const std::filesystem::path& file, const SampleRates& rates,
                const io::ImageMetadata& metadata)
{
    if (has_extension(file, ".exr")) {
        io::write_rates(file, rates, metadata);
        return;
    }
    eval::ErrorMap map{.width = rates.width(), .height = rates.height(), .values = {}};
    for (const std::int8_t exponent : rates.exponents()) {
        map.values.push_back(SampleRates::to_rate(exponent));
    }
    const float most = SampleRates::to_rate(SampleRates::max_exponent);
    io::write_png(file, eval::false_color(map, {.scale = most, .title = "samples per round"}),
                  {.metadata = metadata});
}

std::vector<std::filesystem::path> all_image_files(const RenderArguments& arguments)
{
    std::vector<std::filesystem::path> files = arguments.outputs;
    if (arguments.strategies) {
        const auto more = arguments.strategies->both();
        files.insert(files.end(), more.begin(), more.end());
    }
    return files;
}

namespace {

/// Checks that a part file is no device or pipe, as it is read back.
void check_part_file(const std::filesystem::path& file)
{
    std::error_code missing;
    if (std::filesystem::exists(file, missing) &&
        !std::filesystem::is_regular_file(file, missing)) {
        throw Error(ErrorCode::output,
                    fmt::format("--part \"{}\": cannot write: a part is read again, and this is "
                                "not a regular file",
                                file.string()));
    }
}

/// Checks `files`, which a job may have named by `option`.
void check_files_of_job(const RenderArguments& arguments, std::string_view option,
                        const std::vector<std::filesystem::path>& files)
{
    if (!arguments.job) {
        return;
    }
    const JobSource& job = *arguments.job;
    const bool names =
        std::find(job.outputs.begin(), job.outputs.end(), option) != job.outputs.end();
    const bool names_default = job.names_default && option == "--output";
    for (const std::filesystem::path& file : files) {
        if (is_standard_output(file)) {
            continue;
        }
        if (names && !is_below(file, job.file.parent_path())) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("{}: {} \"{}\": a job writes only into its folder; name other "
                                    "files on the command line",
                                    job.file.string(), option, file.string()));
        }
        std::error_code ignored;
        // A part is not replaced but continued.
        if ((names || names_default) && option != "--part" &&
            std::filesystem::exists(file, ignored) && !is_file_of_ours(file)) {
            throw Error(ErrorCode::output,
                        fmt::format("{}: cannot write: a job names it, but it is not a file that "
                                    "bdpt wrote; remove it, or name files with {}",
                                    file.string(), option));
        }
    }
}

}  // namespace

void check_files_of_job(const RenderArguments& arguments)
{
    check_files_of_job(arguments, "--output", arguments.outputs);
    if (arguments.strategies) {
        check_files_of_job(arguments, "--strategies", arguments.strategies->both());
    }
    if (arguments.rates && arguments.rates->saved) {
        check_files_of_job(arguments, "--save-rates", {*arguments.rates->saved});
    }
    if (arguments.part) {
        check_files_of_job(arguments, "--part", {arguments.part->file});
    }
    if (arguments.stats) {
        check_files_of_job(arguments, "--stats", {*arguments.stats});
    }
}

std::vector<std::filesystem::path> check_files(const RenderArguments& arguments,
                                               const FileSet& inputs)
{
    if (arguments.outputs.empty() && !arguments.part) {
        throw OptionError(arguments.sequence
                              ? "--output is required for several images, like -o out.####.png"
                              : "--output is required for a scene from the standard input");
    }
    check_files_of_job(arguments);
    check_outputs(arguments.outputs, inputs);
    FileSet outputs(arguments.outputs);
    std::vector<std::filesystem::path> written = all_image_files(arguments);
    if (arguments.strategies) {
        check_strategy_files(*arguments.strategies, inputs, outputs);
        outputs.add(arguments.strategies->both());
    }
    if (arguments.rates && arguments.rates->saved) {
        written.push_back(*arguments.rates->saved);
        check_outputs(written, inputs);
        outputs.add(*arguments.rates->saved);
    }
    if (arguments.part) {
        check_output("--part", arguments.part->file, inputs, outputs);
        check_part_file(arguments.part->file);
        outputs.add(arguments.part->file);
        written.push_back(arguments.part->file);
    }
    if (arguments.stats) {
        check_output("--stats", *arguments.stats, inputs, outputs);
        written.push_back(*arguments.stats);
    }
    return written;
}

}  // namespace bdpt::app
