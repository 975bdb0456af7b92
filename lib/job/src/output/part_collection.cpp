#include "output/parts.h"

#include <bdpt/error.h>
#include <bdpt/io/json_value.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "messages/text.h"
#include "options/groups/transport_arguments.h"
#include "options/output_files.h"
#include "output/image_files.h"
#include "output/render_report.h"
#include "plan/plan.h"

namespace bdpt::job {

namespace {

constexpr std::array<std::string_view, 16> with_value{
    "-o",        "--output",     "--samples",        "--time",       "--part",    "--plan",
    "--task",    "--stats",      "--threads",        "--max-memory", "--cameras", "--noise",
    "--display", "--strategies", "--strategy-depth", "--save-rates"};
constexpr std::array<std::string_view, 6> flags{"--restart", "-q",        "--quiet",
                                                "-v",        "--verbose", "--json"};

/// Returns the text of the first `command(i)` of `count` that fit.
template <typename Command>
std::string text_of_commands(std::size_t count, const Command& command)
{
    constexpr std::size_t max_shown = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(count, max_shown); ++i) {
        text += (i == 0 ? "; to render them: " : " && ") + command(i);
    }
    return count > max_shown ? fmt::format("{} && ... ({} more)", text, count - max_shown) : text;
}

}  // namespace

std::vector<std::string> render_words(const std::vector<std::string>& words)
{
    std::vector<std::string> result{"bdpt"};
    for (std::size_t i = 1; i < words.size(); ++i) {
        const std::string& word = words[i];
        const std::string name = word.substr(0, word.find('='));
        if (is_among(with_value, name)) {
            // Skips the value, unless the word contains it.
            i += std::size_t{name.size() == word.size() ? 1U : 0U};
        } else if (!is_among(flags, word) && !(word.starts_with("-o") && word.size() > 2)) {
            result.push_back(one_line(word));
        }
    }
    return result;
}

std::string ranges_text(const SampleSet& samples)
{
    constexpr std::size_t max_shown = 16;
    const std::vector<SampleRange>& ranges = samples.ranges();
    if (ranges.size() <= max_shown) {
        return samples.text();
    }
    std::string text;
    for (std::size_t i = 0; i < max_shown; ++i) {
        text += fmt::format("{}:{},", ranges[i].begin, ranges[i].end);
    }
    return fmt::format("{}... ({} more)", text, ranges.size() - max_shown);
}

std::string commands_text(const std::vector<std::string>& words, const SampleSet& samples,
                          const std::filesystem::path& folder)
{
    if (words.empty()) {
        return "";
    }
    std::string start;
    for (const std::string& word : words) {
        start += shell_word(word) + " ";
    }
    return text_of_commands(samples.ranges().size(), [&](std::size_t i) {
        const SampleRange& range = samples.ranges()[i];
        const auto file = folder / fmt::format("{}-{}.part.exr", range.begin, range.end);
        return fmt::format("{}--samples {}:{} --part {}", start, range.begin, range.end,
                           shell_word(one_line(file.string())));
    });
}

std::string commands_text(const std::filesystem::path& file, const std::vector<std::size_t>& tasks)
{
    return text_of_commands(tasks.size(), [&](std::size_t i) {
        return fmt::format("bdpt render --plan {} --task {}", shell_word(one_line(file.string())),
                           tasks[i]);
    });
}

namespace {

namespace fs = std::filesystem;
using io::PartInfo;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// Throws if `part` belongs to another render than `plan` or `first`.
void check_same_render(const PartInfo& part, const MergeArguments& arguments,
                       const std::optional<PlannedIdentity>& planned, const PartInfo* first)
{
    const auto refuse = [&part](const fs::path& file, const std::string& what) {
        throw Error(ErrorCode::invalid_input, fmt::format("{}: is of another render than {}: {}",
                                                          part.file.string(), file.string(), what));
    };
    if (planned) {
        if (const auto what = difference(part.identity, *planned)) {
            refuse(*arguments.plan, *what);
        }
    }
    if (first != nullptr) {
        if (const auto what = difference(first->identity, part.identity)) {
            refuse(first->file, *what);
        }
    }
}

struct ReadParts {
    std::vector<PartInfo> parts;
    std::vector<std::string> faults;  ///< errors of files that may become readable later
};

ReadParts read_parts(const MergeArguments& arguments, const std::optional<PlannedIdentity>& planned)
{
    ReadParts result;
    for (const fs::path& file : arguments.parts) {
        std::error_code ignored;
        if (planned && !arguments.wait && !fs::exists(file, ignored)) {
            continue;
        }
        try {
            result.parts.push_back(io::read_part_info(file));
        } catch (const Error& error) {
            const bool may_change =
                error.code() == ErrorCode::not_found || error.code() == ErrorCode::invalid_input;
            if (!arguments.wait || !may_change) {
                throw;
            }
            result.faults.emplace_back(error.what());
            continue;
        }
        const PartInfo& part = result.parts.back();
        check_same_render(part, arguments, planned,
                          result.parts.size() > 1 ? &result.parts.front() : nullptr);
    }
    return result;
}

/// Combines parts, in n log n for n ranges of samples.
class Collector {
public:
    /// Adds `part`, unless all its samples are there. Throws `Error` (invalid_input) if some of
    /// them are.
    void add(PartInfo part)
    {
        const PartInfo* const other = overlapping(part.samples);
        if (other == nullptr) {
            for (const SampleRange& range : part.samples.ranges()) {
                owners_.emplace(range.begin, Owner{range.end, result_.parts.size()});
            }
            result_.parts.push_back(std::move(part));
        } else if (other->samples.contains(part.samples)) {
            result_.notes.push_back(fmt::format("{}: skipped, because {} contains its samples {}",
                                                part.file.string(), other->file.string(),
                                                ranges_text(part.samples)));
        } else {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("{} and {} overlap in the samples {}, and neither contains the "
                                    "other",
                                    other->file.string(), part.file.string(),
                                    ranges_text(part.samples.overlap(other->samples))));
        }
    }

    [[nodiscard]] PartCollection collection() &&
    {
        for (const auto& [begin, owner] : owners_) {
            result_.samples.add({.begin = begin, .end = owner.end});
        }
        return std::move(result_);
    }

private:
    struct Owner {
        std::int64_t end = 0;
        std::size_t part = 0;
    };

    /// Returns a part that has some of `samples`, or null.
    [[nodiscard]] const PartInfo* overlapping(const SampleSet& samples) const
    {
        for (const SampleRange& range : samples.ranges()) {
            // The last one that begins before the end of the range.
            auto last = owners_.lower_bound(range.end);
            if (last != owners_.begin() && (--last)->second.end > range.begin) {
                return &result_.parts[last->second.part];
            }
        }
        return nullptr;
    }

    PartCollection result_;
    std::map<std::int64_t, Owner> owners_;  // by the begin of their ranges
};

/// Returns the requested samples of the render, as far as the user, the plan or the parts tell.
SampleSet find_goal(const std::vector<PartInfo>& parts, const MergeArguments& arguments)
{
    if (arguments.goal) {
        return *arguments.goal;
    }
    if (arguments.samples) {
        return SampleSet({.begin = 0, .end = *arguments.samples});
    }
    std::int64_t end = 0;
    for (const PartInfo& part : parts) {
        end = std::max({end, part.samples.end(), part.notes.goal.end()});
    }
    return SampleSet({.begin = 0, .end = end});
}

PartCollection collect_now(const MergeArguments& arguments,
                           const std::optional<PlannedIdentity>& planned)
{
    auto [all, faults] = read_parts(arguments, planned);
    SampleSet goal = find_goal(all, arguments);
    // Larger ones first, so that a part precedes those that it contains.
    std::vector<std::pair<std::int64_t, std::size_t>> order;
    for (std::size_t i = 0; i < all.size(); ++i) {
        order.emplace_back(-all[i].samples.count(), i);
    }
    std::sort(order.begin(), order.end());
    Collector collector;
    for (const auto& [count, i] : order) {
        collector.add(std::move(all[i]));
    }
    PartCollection result = std::move(collector).collection();
    result.goal = std::move(goal);
    result.faults = std::move(faults);
    return result;
}

/// Tests whether all samples are there; without a known goal, all parts, too.
bool is_complete(const PartCollection& collection, const MergeArguments& arguments)
{
    const bool knows_goal = arguments.plan || arguments.samples;
    return !collection.parts.empty() && collection.missing().empty() &&
           (knows_goal || collection.faults.empty());
}

void show_waiting(Console& console, const PartCollection& collection, Seconds passed)
{
    const auto goal = static_cast<double>(std::max(collection.goal.count(), std::int64_t{1}));
    console.task({.fraction = static_cast<double>(collection.samples.count()) / goal,
                  .seconds = passed.count(),
                  .activity = "waiting for parts"});
}

}  // namespace

PartCollection collect_parts(const MergeArguments& arguments, const std::optional<Plan>& plan,
                             Console& console)
{
    // A check reads all files, so it takes at most a tenth of the time.
    constexpr Seconds min_pause{1.0};
    constexpr double pause_of_looks = 10.0;
    const Clock::time_point start = Clock::now();
    const std::optional<PlannedIdentity> planned =
        plan ? std::optional(planned_identity(*plan, arguments.image)) : std::nullopt;
    for (;;) {
        const Clock::time_point look = Clock::now();
        PartCollection result = collect_now(arguments, planned);
        const Seconds passed = Clock::now() - start;
        const double left = arguments.wait.value_or(0.0) - passed.count();
        if (left <= 0.0 || is_complete(result, arguments)) {
            console.end_progress();
            return result;
        }
        show_waiting(console, result, passed);
        const Seconds pause = std::max(min_pause, pause_of_looks * Seconds(Clock::now() - look));
        std::this_thread::sleep_for(std::min(pause, Seconds(left)));
    }
}

namespace {

using nlohmann::ordered_json;

/// Parses the settings `text` of a part. Invalid JSON is discarded, and so is text longer or deeper
/// than that of any render, as keys are searched linearly and text is written recursively.
ordered_json parsed_settings(const std::string& text)
{
    constexpr std::size_t max_length = std::size_t{64} << 10;
    const ordered_json discarded = ordered_json::parse("", nullptr, false);
    if (text.size() > max_length) {
        return discarded;
    }
    try {
        static_cast<void>(io::JsonValue::parse(text));
    } catch (const Error&) {
        return discarded;
    }
    return ordered_json::parse(text, nullptr, false);
}

/// Returns the settings of the parts, with the total number of samples and the backdrop.
std::string merge_settings(const std::string& text, std::int64_t samples,
                           const std::optional<Backdrop>& backdrop)
{
    ordered_json settings = parsed_settings(text);
    if (!settings.is_object()) {
        return text;
    }
    settings["spp"] = samples;
    if (backdrop) {
        settings["background"] = backdrop_text(*backdrop);
    }
    settings.erase("time_limit_seconds");
    settings.erase("noise_goal");
    return settings.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

}  // namespace

DisplayArguments display_of_parts(const io::PartInfo& part, DisplayArguments display)
{
    const io::ImageMetadata& metadata = part.notes.metadata;
    const ordered_json settings = parsed_settings(metadata.settings);
    std::optional<Backdrop> own;
    if (settings.is_object() && settings.contains("background") &&
        settings["background"].is_string()) {
        own = parse_backdrop(settings["background"].get<std::string>());
        if (own && !own->photo.empty()) {
            own->photo = find_photo(own->photo, part.file);
        }
    }
    if (display.backdrop && !own) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("--background \"{}\": the parts contain the environment; render "
                                "them with --background, too",
                                backdrop_text(*display.backdrop)));
    }
    display.backdrop = display.backdrop ? display.backdrop : own;
    check_metered(display.exposure, metadata, "the parts");
    return display;
}

void check_merged_files(std::span<const MergeArguments> images)
{
    FileSet inputs;
    for (const MergeArguments& image : images) {
        inputs.add(image.parts);
        if (image.plan) {
            inputs.add(*image.plan);
        }
        if (image.denoise.library) {
            inputs.add(*image.denoise.library);
        }
        if (image.display.backdrop && !image.display.backdrop->photo.empty()) {
            inputs.add(image.display.backdrop->photo);
        }
    }
    for (const MergeArguments& image : images) {
        check_outputs(image.outputs, inputs);
        check_strategy_files(image.strategies, inputs, image.outputs);
    }
}

void check_strategies(const MergeArguments& arguments, const io::PartInfo& part)
{
    const auto& components = part.identity.components;
    const bool has_images =
        std::any_of(components.begin(), components.end(), [](const IdentityComponent& component) {
            return component.name == "option: strategy_depth" && component.value != "0";
        });
    if (!arguments.strategies.layers.empty() && !has_images) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("--strategies \"{}\": {} has no strategy images; render the parts "
                                "with --strategy-depth",
                                arguments.strategies.layers.string(), part.file.string()));
    }
}

std::vector<fs::path> merged_files(const MergeArguments& arguments)
{
    std::vector<fs::path> files = arguments.outputs;
    const std::vector<fs::path> more = arguments.strategies.both();
    files.insert(files.end(), more.begin(), more.end());
    return files;
}

std::vector<fs::path> write_merged_files(const MergeArguments& arguments,
                                         const DisplayArguments& display,
                                         const io::Denoiser* denoiser, const RenderResult& part,
                                         io::PartNotes notes)
{
    notes.metadata = completed(std::move(notes.metadata), part.samples.count(), part.cpu_seconds);
    notes.metadata.settings =
        merge_settings(notes.metadata.settings, part.samples.count(), display.backdrop);
    std::vector<fs::path> images;
    Attempts attempts;
    for (const fs::path& output : arguments.outputs) {
        if (is_part_name(output)) {
            attempts.run([&] { io::write_part(output, part, notes, io::OldPart::replace); });
        } else {
            images.push_back(output);
        }
    }
    const bool writes_strategies = !arguments.strategies.layers.empty();
    if (images.empty() && !writes_strategies) {
        attempts.finish();
        return {};
    }
    const Image image = part.image();
    const ImageFileOptions options = image_file_options(
        part, std::move(notes.metadata), arguments.exr, display, denoiser, arguments.denoise);
    WrittenImages written = write_image_files(images, image, options, attempts);
    if (writes_strategies) {
        attempts.run([&] {
            write_strategy_files(arguments.strategies, image, part.strategies, options.exr,
                                 shown_exposure(display.exposure, options.exr.metadata, image));
        });
    }
    attempts.finish();
    return std::move(written.denoised);
}

namespace {

/// Returns the files that the plan in `file` names for image `image`.
std::set<fs::path> planned_files(const Plan& plan, const fs::path& file, std::size_t image)
{
    const auto name = [&](const fs::path& path) {
        return expand_pattern(resolved(path, file), plan.images[image]);
    };
    std::set<fs::path> result;
    for (const fs::path& output : plan.outputs) {
        result.insert(name(output));
    }
    if (plan.strategies) {
        const std::vector<fs::path> both = StrategyFiles{.layers = name(*plan.strategies)}.both();
        result.insert(both.begin(), both.end());
    }
    return result;
}

}  // namespace

void check_planned_outputs(const MergeArguments& arguments, const Plan& plan)
{
    const std::set<fs::path> planned = planned_files(plan, *arguments.plan, arguments.image);
    for (const fs::path& file : merged_files(arguments)) {
        std::error_code ignored;
        if (planned.contains(file) && fs::exists(file, ignored) && !is_file_of_ours(file)) {
            throw Error(ErrorCode::output,
                        fmt::format("{}: cannot write: the plan names it, but it is not an image "
                                    "of bdpt; remove it, or name other files with -o",
                                    file.string()));
        }
    }
}

}  // namespace bdpt::job
