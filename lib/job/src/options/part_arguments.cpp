#include "options/part_arguments.h"

#include <fmt/core.h>

#include <array>
#include <limits>
#include <utility>

#include "options/output_files.h"
#include "options/value_types.h"

namespace bdpt::job {

namespace {

/// Parses a time [s]; infinite without a text.
std::optional<double> parse_wait(const std::string& text)
{
    return text == "true" ? std::numeric_limits<double>::infinity() : parse_duration(text);
}

}  // namespace

void add_part_options(OptionList& options, PartChoice& part)
{
    options
        .add("--part", "FILE",
             "Checkpoint file (.exr): written while rendering; if it exists, the render resumes "
             "from it (after a crash, or with more --spp). bdpt merge reads it, too. Without -o "
             "only this file is written",
             part.file, file_named({".exr"}, "a file name that ends in .exr, best in .part.exr"))
        .uses.stated_in = StatedIn::own_folder;
    options
        .add_flag("--restart", "Replace the file of --part instead of resuming from it",
                  part.existing, on_or_off(ExistingPart::restart, ExistingPart::go_on))
        .uses.stated_in = StatedIn::programs;
    options
        .add("--plan", "FILE",
             "Render one task of this plan (bdpt plan), which sets all but --threads, "
             "--max-memory, --stats, --ktx-library, --allow-folder, --restart, --quiet, --verbose "
             "and "
             "--json",
             part.plan, any_text())
        .uses.stated_in = StatedIn::command_line;
    options
        .add("--task", "N|env:NAME",
             "Task of --plan, counted from 0, or the environment variable that holds its number",
             part.task, any_text())
        .uses.stated_in = StatedIn::command_line;
}

std::optional<PartChoice> checked(const PartChoice& part, const OptionList& options)
{
    static constexpr std::array needs{Need{"--task", "--plan"}, Need{"--restart", "--part"}};
    if (options.find("--part") != nullptr) {  // the --restart of bdpt plan is a different option
        check(needs, options);
    }
    return options.given("--part") ? std::optional(part) : std::nullopt;
}

void add_half_option(OptionList& options, ExrFormat& exr)
{
    options.add_flag("--half", "Store .exr as 16-bit floats", exr.channel_type,
                     on_or_off(io::ExrChannelType::half_float, io::ExrChannelType::single_float));
}

void add_tiled_option(OptionList& options, ExrFormat& exr)
{
    options.add_flag("--tiled", "Store .exr in tiles, for programs that read parts of it",
                     exr.storage, on_or_off(io::ExrStorage::tiles, io::ExrStorage::scanlines));
}

void add_quiet_option(OptionList& options, Printed& printed, std::string help)
{
    options
        .add_flag("-q,--quiet", std::move(help), printed.verbosity,
                  on_or_off(Verbosity::quiet, Verbosity::normal))
        .uses = {.stated_in = StatedIn::command_line};
}

void add_json_option(OptionList& options, Printed& printed, std::string help)
{
    options
        .add_flag("--json", std::move(help), printed.format, on_or_off(Format::json, Format::text))
        .uses = {.stated_in = StatedIn::command_line};
}

bool is_part_name(const std::filesystem::path& file)
{
    return has_extension(file, ".exr") && has_extension(file.stem(), ".part");
}

void add_merge_options(OptionList& options, MergeRequest& request)
{
    MergeArguments& arguments = request.arguments;
    options.add_repeated("part", "PART",
                         "Parts of a render, made by bdpt render --part. Required without --plan",
                         arguments.parts, any_text());
    options.section("Output");
    options
        .add_repeated(
            "-o,--output", "FILE",
            "Required: .part.exr (a part again), .exr or .hdr (linear radiance), .png, .jpg or "
            ".webp (tone-mapped); exr:-, png:- etc. write to standard output. May be repeated",
            arguments.outputs, any_text())
        .required = true;
    options.section("Parts");
    options.add("--plan", "FILE",
                "Merge the parts of this plan (bdpt plan); without -o, into the plan's outputs. "
                "Parts need not be given",
                arguments.plan, any_text());
    options.add_flag("--wait",
                     "Wait for missing or incomplete parts until all samples are there; "
                     "--wait=90s, 30m or 2h limits the wait",
                     arguments.wait, parsed_by(parse_wait, "a time like 90s, 30m or 2h"));
    options.section("Output");
    options.add_flag("--partial",
                     "Write the image even if samples are missing: it has more noise, but is "
                     "otherwise correct",
                     arguments.incomplete, on_or_off(Incomplete::write, Incomplete::refuse));
    options.add("--spp", "N",
                "Samples per pixel of the complete render. Default: as stored in the parts",
                arguments.samples, whole_number(1, std::int64_t{1} << 31));
    options.add("--noise", "N%",
                "Print how many more samples reduce the noise to this, like 2%, and the command "
                "that renders them",
                arguments.noise, noise_level());
    add_strategy_file_option(options, request.strategies,
                             "Write the strategy images stored in the parts, and their contact "
                             "sheet, as bdpt render --strategies does");
    add_display_options(options, arguments.display);
    add_denoise_options(options, arguments.denoise);
    add_half_option(options, arguments.exr);
    add_tiled_option(options, arguments.exr);
    add_quiet_option(options, arguments.printed);
    add_json_option(options, arguments.printed,
                    "Print one JSON object per line on stdout: warning, done, error. With --quiet "
                    "only done and error");
}

MergeArguments checked(const MergeRequest& request, const OptionList& options)
{
    static constexpr std::array conflicts{
        Conflict{"--spp", "--plan", "the plan sets the number of samples"}};
    MergeArguments result = request.arguments;
    if (!result.plan && result.parts.empty()) {
        throw OptionError("part is required");
    }
    check(conflicts, options);
    if (options.given("--strategies")) {
        result.strategies = request.strategies.layers;
    }
    check_pipes({}, result.outputs, result.printed.format);
    return result;
}

}  // namespace bdpt::job
