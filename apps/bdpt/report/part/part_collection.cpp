#include "report/part/part_collection.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <system_error>
#include <thread>
#include <utility>

#include "plan/planned_identity.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;
using io::PartInfo;
using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// Throws when `part` is of another render than `plan` or `first`.
void check_same_render(const PartInfo& part, const MergeArguments& arguments,
                       const std::optional<Plan>& plan, const PartInfo* first)
{
    const auto refuse = [&part](const fs::path& file, const std::string& what) {
        throw Error(ErrorCode::invalid_input, fmt::format("{}: is of another render than {}: {}",
                                                          part.file.string(), file.string(), what));
    };
    if (plan) {
        const PlannedIdentity planned = planned_identity(*plan, arguments.image);
        if (const auto what = difference(part.identity, planned)) {
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
    std::vector<std::string> faults;  ///< of other files, when those may come
};

ReadParts read_parts(const MergeArguments& arguments, const std::optional<Plan>& plan)
{
    ReadParts result;
    for (const fs::path& file : arguments.parts) {
        std::error_code ignored;
        if (plan && !arguments.wait && !fs::exists(file, ignored)) {
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
        check_same_render(part, arguments, plan,
                          result.parts.size() > 1 ? &result.parts.front() : nullptr);
    }
    return result;
}

/// Adds `part`, unless its samples are there.
void add(PartCollection& collection, PartInfo part)
{
    std::vector<PartInfo>& parts = collection.parts;
    const auto overlapping = std::find_if(parts.begin(), parts.end(), [&](const PartInfo& other) {
        return !part.samples.overlap(other.samples).empty();
    });
    if (overlapping == parts.end()) {
        collection.samples.add(part.samples);
        parts.push_back(std::move(part));
    } else if (overlapping->samples.contains(part.samples)) {
        collection.notes.push_back(fmt::format("{}: left out, as {} has its samples {}",
                                               part.file.string(), overlapping->file.string(),
                                               part.samples.text()));
    } else {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("{} and {} both have the samples {}, and each has others",
                                overlapping->file.string(), part.file.string(),
                                part.samples.overlap(overlapping->samples).text()));
    }
}

/// The samples that the render was to have, as far as the user, the plan or the parts tell.
SampleSet goal_of(const std::vector<PartInfo>& parts, const MergeArguments& arguments,
                  const std::optional<Plan>& plan)
{
    if (plan) {
        return samples_of(*plan);
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

PartCollection collect_now(const MergeArguments& arguments, const std::optional<Plan>& plan)
{
    PartCollection result;
    auto [all, faults] = read_parts(arguments, plan);
    result.faults = std::move(faults);
    result.goal = goal_of(all, arguments, plan);
    // The larger ones first: what lies in another one comes behind it.
    std::stable_sort(all.begin(), all.end(), [](const PartInfo& a, const PartInfo& b) {
        return a.samples.count() > b.samples.count();
    });
    for (PartInfo& part : all) {
        add(result, std::move(part));
    }
    return result;
}

/// All samples are there; without a goal that is known, all parts, too.
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
    // Looking is reading all there is: it takes a tenth of the time at most.
    constexpr Seconds least_pause{1.0};
    constexpr double pause_of_looks = 10.0;
    const Clock::time_point start = Clock::now();
    for (;;) {
        const Clock::time_point look = Clock::now();
        PartCollection result = collect_now(arguments, plan);
        const Seconds passed = Clock::now() - start;
        const double left = arguments.wait.value_or(0.0) - passed.count();
        if (left <= 0.0 || is_complete(result, arguments)) {
            console.end_progress();
            return result;
        }
        show_waiting(console, result, passed);
        const Seconds pause = std::max(least_pause, pause_of_looks * Seconds(Clock::now() - look));
        std::this_thread::sleep_for(std::min(pause, Seconds(left)));
    }
}

}  // namespace bdpt::app
