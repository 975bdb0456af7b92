#include "options/part_arguments.h"

#include <bdpt/part/sample_set.h>
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <limits>

#include "options/arguments.h"
#include "options/groups/strategy_arguments.h"
#include "options/render_arguments.h"
#include "options/values/output_files.h"
#include "options/values/pipes.h"
#include "options/values/value_checks.h"

namespace bdpt::app {
namespace {

constexpr const char* no_end = "true";  // what the parser takes --wait without a time for

constexpr const char* part_examples = R"(Examples:
  bdpt merge job/*.part.exr -o out.exr -o out.png
  bdpt merge job/*.part.exr -o now.png --partial
  bdpt merge job/0-*.part.exr -o job-0.part.exr
  bdpt merge --plan job/plan.json --wait

Parts come from bdpt render --part. They may be in any order, and the image is that of one render of
all their samples, to the bit. A part that lies within another one is left out with a note. Layers
(AOVs) of the parts are written to .exr files.

Exit codes: 0 done, 12 samples are missing (the message says which, and what renders them; nothing
is written without --partial), 2 wrong usage, 3 part not found, 4 a part is broken, of another
render, or overlaps another one, 6 output cannot be written, 7 out of memory.)";

/// [s]
double to_patience(const std::string& word)
{
    if (word == no_end) {
        return std::numeric_limits<double>::infinity();
    }
    const std::optional<double> seconds = parse_duration(word);
    if (!seconds) {
        reject("--wait", word, "a time like 90s, 30m or 2h");
    }
    return *seconds;
}

}  // namespace

void add_part_options(CLI::App& command, PartWords& words, const char* group)
{
    command
        .add_option("--part", words.file,
                    "Keep the render in this .exr file while it runs, and go on with it if it is "
                    "there: after a crash, with more --spp, or for bdpt merge. Without -o only "
                    "this file is written")
        ->type_name("FILE")
        ->group(group);
    command
        .add_flag("--restart", words.restart,
                  "Do not go on with the file of --part, but replace it")
        ->group(group);
    command
        .add_option("--plan", words.plan,
                    "Render one task of this plan (bdpt plan), which says all but --threads, "
                    "--max-memory, --stats, --restart, --quiet and --json")
        ->type_name("FILE")
        ->group(group);
    command
        .add_option("--task", words.task,
                    "The task of --plan, from 0, or the environment variable that has its number")
        ->type_name("N|env:NAME")
        ->group(group);
}

void add_samples_option(CLI::App& command, PartWords& words, const char* group)
{
    command
        .add_option("--samples", words.samples,
                    "Render the samples A to B - 1 of each pixel, in place of --spp: a part of a "
                    "render that other machines share")
        ->type_name("A:B")
        ->group(group);
}

std::optional<PartChoice> part_choice(const PartWords& words)
{
    if (words.task && !words.plan) {
        throw OptionError("--task: expected --plan FILE with it");
    }
    if (!words.file) {
        if (words.restart) {
            throw OptionError("--restart: expected --part FILE with it");
        }
        return std::nullopt;
    }
    if (!has_extension(*words.file, ".exr")) {
        reject("--part", *words.file, "a file that is named .exr, best .part.exr");
    }
    return PartChoice{.file = *words.file,
                      .existing = words.restart ? ExistingPart::restart : ExistingPart::go_on,
                      .plan = words.plan,
                      .task = words.task.value_or("")};
}

std::optional<SampleRange> sample_range(const PartWords& words)
{
    if (!words.samples) {
        return std::nullopt;
    }
    const std::optional<SampleSet> set = SampleSet::parse(*words.samples);
    if (!set || set->ranges().size() != 1) {
        reject("--samples", *words.samples,
               "two whole numbers A:B with A below B, and below 2^32, like 64:128");
    }
    return set->ranges().front();
}

bool is_part_name(const std::filesystem::path& file)
{
    return has_extension(file, ".exr") && has_extension(file.stem(), ".part");
}

void add_merge_options(CLI::App& command, MergeWords& words)
{
    command
        .add_option("part", words.parts,
                    "Parts of a render, made by bdpt render --part. Required without --plan")
        ->type_name("PART");
    const auto group = "Output";
    command
        .add_option("-o,--output", words.outputs,
                    "Required: .part.exr (a part again), .exr (linear radiance) or .png "
                    "(tone-mapped); exr:- and png:- are the standard output. May be repeated")
        ->required()
        ->allow_extra_args(false)
        ->type_name("FILE")
        ->group(group);
    command
        .add_option("--plan", words.plan,
                    "Merge the parts of this plan (bdpt plan); without -o, to the files that it "
                    "names. Parts need not be given")
        ->type_name("FILE")
        ->group("Parts");
    command
        .add_flag("--wait", words.wait,
                  "Wait for parts that are not there or not complete, until there are all samples; "
                  "as --wait=90s, 30m or 2h no longer than that")
        ->group("Parts");
    command
        .add_flag("--partial", words.partial,
                  "Write what there is when samples are missing: the image has more noise, but is "
                  "right otherwise")
        ->group(group);
    command
        .add_option("--spp", words.samples,
                    "Samples per pixel that the render was to have. Default: what the parts say")
        ->check(whole_number(1, std::int64_t{1} << 31))
        ->type_name("N")
        ->group(group);
    command
        .add_option("--noise", words.noise,
                    "Say how many more samples would bring the noise down to this, like 2%, and "
                    "what renders them")
        ->type_name("N%")
        ->group(group);
    add_strategy_file_option(
        command, words.strategies,
        "Write the images of strategies that the parts have, and their contact "
        "sheet, as bdpt render --strategies does");
    add_display_options(command, words.display, group);
    add_denoise_options(command, words.denoise, group);
    command.add_flag("--half", words.half, "Store .exr as 16-bit floats")->group(group);
    command
        .add_flag("--tiled", words.tiled, "Store .exr in tiles, for programs that read parts of it")
        ->group(group);
    command.add_flag("-q,--quiet", words.quiet, "Print errors only")->group(group);
    command
        .add_flag("--json", words.json,
                  "Print one JSON object per line on stdout: warning, done, error. With --quiet "
                  "only done and error")
        ->group(group);
    command.footer(part_examples);
}

MergeArguments understand(const MergeWords& words)
{
    MergeArguments result;
    if (!words.plan && words.parts.empty()) {
        throw OptionError("part is required");
    }
    if (words.plan && words.samples) {
        reject("--spp", fmt::format("{}", *words.samples), "no --plan beside it, which says that");
    }
    if (!words.wait.empty()) {
        result.wait = to_patience(words.wait);
    }
    result.plan = words.plan;
    result.parts.assign(words.parts.begin(), words.parts.end());
    result.outputs.assign(words.outputs.begin(), words.outputs.end());
    if (words.strategies) {
        result.strategies = strategy_files(*words.strategies).layers;
    }
    check_pipes({}, result.outputs, words.json ? Format::json : Format::text);
    result.samples = words.samples;
    result.noise = to_noise(words.noise);
    result.incomplete = words.partial ? Incomplete::write : Incomplete::refuse;
    result.display = understand(words.display);
    result.denoise = understand(words.denoise);
    result.channel_type =
        words.half ? io::ExrChannelType::half_float : io::ExrChannelType::single_float;
    result.storage = words.tiled ? io::ExrStorage::tiles : io::ExrStorage::scanlines;
    result.format = words.json ? Format::json : Format::text;
    result.verbosity = words.quiet ? Verbosity::quiet : Verbosity::normal;
    return result;
}

}  // namespace bdpt::app
