#include "report/part/part_collection.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "plan/planned_identity.h"
#include "terminal/text.h"

namespace bdpt::app {
namespace {

constexpr std::array<std::string_view, 17> with_value{
    "-o",      "--output",  "--spp",        "--samples",        "--time",       "--part",
    "--plan",  "--task",    "--stats",      "--threads",        "--max-memory", "--cameras",
    "--noise", "--display", "--strategies", "--strategy-depth", "--save-rates"};
constexpr std::array<std::string_view, 6> flags{"--restart", "-q",        "--quiet",
                                                "-v",        "--verbose", "--json"};

template <typename Names>
bool has(const Names& names, std::string_view word)
{
    return std::find(names.begin(), names.end(), word) != names.end();
}

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
        if (has(with_value, name)) {
            // Skips the value, unless the word contains it.
            i += std::size_t{name.size() == word.size() ? 1U : 0U};
        } else if (!has(flags, word) && !(word.starts_with("-o") && word.size() > 2)) {
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

}  // namespace bdpt::app
