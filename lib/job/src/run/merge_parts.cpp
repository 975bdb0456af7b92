#include "run/run_render.h"

#include <bdpt/io/part_file.h>
#include <bdpt/noise.h>
#include <bdpt/part/render_result.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "machine/machine_limits.h"
#include "messages/console.h"
#include "messages/text.h"
#include "options/output_files.h"
#include "options/value_types.h"
#include "output/image_files.h"
#include "output/parts.h"
#include "output/render_report.h"
#include "output/values.h"
#include "plan/plan.h"

namespace bdpt::job {
namespace {

namespace fs = std::filesystem;
using io::PartInfo;
using nlohmann::ordered_json;

std::string message_of_missing(const PartCollection& collection)
{
    const PartInfo& part = collection.parts.front();
    const SampleSet missing = collection.missing();
    return fmt::format("samples are missing: {}{}; --partial writes the image so far",
                       ranges_text(missing),
                       commands_text(part.notes.command, missing, part.file.parent_path()));
}

/// Outcome of one image.
struct MergedImage {
    std::size_t image = 0;  ///< index in the plan
    SampleSet missing;
    bool has_parts = false;
    bool written = false;
    std::string message{};  ///< why it was not written
};

std::string message_of_missing(const MergeArguments& asked, const Plan& plan,
                               const std::vector<MergedImage>& unwritten)
{
    std::vector<std::size_t> images;
    std::vector<SampleSet> missing(plan.images.size());
    bool has_parts = false;
    for (const MergedImage& image : unwritten) {
        images.push_back(image.image);
        missing[image.image] = image.missing;
        has_parts = has_parts || image.has_parts;
    }
    const std::vector<std::size_t> tasks = tasks_for(plan, missing);
    return fmt::format(
        "samples are missing: {} (tasks {} of {}){}{}",
        is_sequence(plan) ? images_text(plan, images) : ranges_text(unwritten.front().missing),
        numbers_text(tasks), asked.plan->string(), commands_text(*asked.plan, tasks),
        has_parts ? "; --partial writes the image so far" : "");
}

/// Returns the noise of the sum, with the samples that it lacks for the requested noise, if any.
ordered_json judge_noise(const MergeArguments& arguments, const RenderResult& sum,
                         const PartInfo& part, Console& console)
{
    const double noise = estimate_noise(sum.film, sum.aovs);
    ordered_json fields{{"noise", noise_json(noise)}};
    if (!arguments.noise) {
        return fields;
    }
    if (noise <= *arguments.noise) {
        console.note(fmt::format("the noise is {}: not above {}", noise_text(noise),
                                 noise_text(*arguments.noise)));
        fields["missing_for_noise"] = "";
        return fields;
    }
    const std::int64_t samples = samples_for_noise(noise, sum.samples.count(), *arguments.noise);
    const SampleSet more = sum.samples.missing(SampleSet({.begin = 0, .end = samples}));
    console.note(fmt::format("the noise is {}: for {} the samples {} are missing{}",
                             noise_text(noise), noise_text(*arguments.noise), ranges_text(more),
                             commands_text(part.notes.command, more, part.file.parent_path())));
    fields["missing_for_noise"] = more.text();
    return fields;
}

/// Returns the placeholders that distinguish the files of images.
const char* find_placeholders(const PlanImage& image)
{
    if (image.frame && image.camera) {
        return "#### and {camera}";
    }
    return image.frame ? "####" : "{camera}";
}

/// Returns `asked` for each image to merge. Throws `Error` (usage) for file names without the
/// placeholders that distinguish the images.
std::vector<MergeArguments> split_by_image(const MergeArguments& asked,
                                           const std::optional<Plan>& plan)
{
    if (!plan) {
        return {asked};
    }
    const SampleSet goal = collect_samples(*plan);
    const std::vector<std::vector<fs::path>> parts = parts_by_image(*plan);
    const fs::path folder = resolved(".", *asked.plan);
    std::vector<MergeArguments> result;
    std::set<fs::path> files;
    for (std::size_t i = 0; i < plan->images.size(); ++i) {
        MergeArguments image = asked;
        image.image = i;
        image.goal = goal;
        for (const fs::path& part : parts[i]) {
            image.parts.push_back(file_of_plan(part, folder));
        }
        const auto place = [&](fs::path& file) {
            const fs::path pattern = std::exchange(file, expand_pattern(file, plan->images[i]));
            if (!files.insert(file).second && is_sequence(*plan)) {
                throw OptionError(fmt::format(
                    "{}: expected {} in the name, because the plan has {}", pattern.string(),
                    find_placeholders(plan->images[i]), counted(plan->images.size(), "image")));
            }
        };
        std::for_each(image.outputs.begin(), image.outputs.end(), place);
        if (!image.strategies.layers.empty()) {
            place(image.strategies.layers);
        }
        result.push_back(std::move(image));
    }
    return result;
}

/// State shared by the images of a command.
struct MergeSession {
    const std::optional<Plan>& plan;
    const io::Denoiser* denoiser;  ///< null: images are not denoised
    Console& console;
};

/// Merges the parts, and writes the image.
void merge(const MergeArguments& arguments, const PartCollection& collection,
           const MergeSession& session)
{
    Console& console = session.console;
    const std::vector<PartInfo>& parts = collection.parts;
    check_strategies(arguments, parts.front());
    const DisplayArguments display = display_of_parts(parts.front(), arguments.display);
    check_transparency(display, arguments.outputs);
    if (display.backdrop) {
        check_not_read(merged_files(arguments), FileSet({display.backdrop->photo}));
    }
    check_backplate(display);
    RenderResult sum;
    io::MemoryBudget memory(memory_limit(std::nullopt));
    for (const PartInfo& part : parts) {
        io::merge_part(sum, part, &memory);
    }
    io::PartNotes notes = parts.front().notes;
    notes.goal = collection.goal;
    const std::vector<fs::path> denoised =
        write_merged_files(arguments, display, session.denoiser, sum, std::move(notes));

    const SampleSet missing = collection.missing();
    if (!missing.empty()) {
        console.warning(fmt::format("samples are missing: {}", ranges_text(missing)));
    }
    ordered_json outputs = ordered_json::array();
    for (const fs::path& output : merged_files(arguments)) {
        outputs.push_back(output.string());
        console.note(fmt::format("wrote {}: {} spp of {} parts, {:.1f} s of CPU time{}",
                                 output.string(), sum.samples.count(), parts.size(),
                                 sum.cpu_seconds, is_among(denoised, output) ? ", denoised" : ""));
    }
    ordered_json fields{{"samples", sum.samples.count()},
                        {"missing", missing.text()},
                        {"cpu_seconds", sum.cpu_seconds},
                        {"outputs", std::move(outputs)},
                        {"denoised", names_json(denoised)}};
    fields.update(judge_noise(arguments, sum, parts.front(), console));
    console.event("done", fields);
}

/// Collects the parts of one image and, if there are enough, merges them.
MergedImage merge_image(const MergeArguments& arguments, const MergeSession& session)
{
    Console& console = session.console;
    if (session.plan) {
        console.begin_image(make_label(*session.plan, arguments.image));
    }
    const PartCollection collection = collect_parts(arguments, session.plan, console);
    for (const std::string& note : collection.notes) {
        console.note({"part_skipped", note});
    }
    for (const std::string& fault : collection.faults) {
        console.warning(fault);
    }
    MergedImage result{.image = arguments.image,
                       .missing = collection.missing(),
                       .has_parts = !collection.parts.empty()};
    if (!result.has_parts) {
        result.message = "no part was found";
    } else if (!result.missing.empty() && arguments.incomplete == Incomplete::refuse) {
        result.message = message_of_missing(collection);
    } else {
        merge(arguments, collection, session);
        result.written = true;
    }
    return result;
}

}  // namespace

std::optional<std::string> merge_parts(const MergeArguments& asked, Console& console,
                                       Interrupt& interrupt)
{
    const std::optional<Plan> plan =
        asked.plan ? std::optional(read_plan(*asked.plan)) : std::nullopt;
    const std::vector<MergeArguments> images = split_by_image(asked, plan);
    check_merged_files(images);
    if (plan) {
        for (const MergeArguments& image : images) {
            check_planned_outputs(image, *plan);
        }
    }
    constexpr int all_processors = 0;
    const std::optional<io::Denoiser> denoiser =
        open_denoiser(asked.denoise, asked.outputs, all_processors);
    const MergeSession session{plan, denoiser ? &*denoiser : nullptr, console};
    const auto start = std::chrono::steady_clock::now();
    std::vector<MergedImage> unwritten;
    for (MergeArguments image : images) {
        interrupt.set_outputs(pending_outputs(merged_files(image)));
        if (image.wait) {  // for all images together
            image.wait = std::max(*asked.wait - seconds_since(start), 0.0);
        }
        MergedImage merged = merge_image(image, session);
        if (!merged.written) {
            unwritten.push_back(std::move(merged));
        }
    }
    if (unwritten.empty()) {
        return std::nullopt;
    }
    const std::string message =
        plan ? message_of_missing(asked, *plan, unwritten) : unwritten.front().message;
    if (asked.incomplete == Incomplete::write && unwritten.size() < images.size()) {
        console.warning(message);
        return std::nullopt;
    }
    return message;
}

}  // namespace bdpt::job
