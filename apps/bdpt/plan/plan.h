#pragma once

#include <bdpt/part/identity.h>
#include <bdpt/part/sample_set.h>
#include <bdpt/render_options.h>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bdpt::app {

/// What one process of a planned render does.
struct PlanTask {
    SampleRange samples;
    std::filesystem::path part;  ///< the file that it writes
    [[nodiscard]] bool operator==(const PlanTask&) const = default;
};

/// A render that is shared by several processes. Paths are absolute, or relative to the folder of
/// the plan's file: so a folder that holds all of it may be somewhere else for each of them.
struct Plan {
    std::filesystem::path scene;
    std::optional<std::filesystem::path> environment{};  ///< the file of --env
    std::vector<std::string> render_options{};  ///< further words of bdpt render, alike for all
    std::vector<std::string> merge_options{};   ///< words of bdpt merge
    std::vector<std::filesystem::path> outputs{};
    std::vector<PlanTask> tasks{};
    std::vector<std::filesystem::path> engine_files{};  ///< what starts the tasks
    Identity identity{};                                ///< that each task must find
    [[nodiscard]] bool operator==(const Plan&) const = default;
};

/// All samples that the tasks render.
[[nodiscard]] SampleSet samples_of(const Plan& plan);

/// "0-2,5": numbers of those tasks of `plan` that render some of `samples`.
[[nodiscard]] std::string tasks_text(const Plan& plan, const SampleSet& samples);

/// As JSON. Throws `Error` (usage) for a path that is not UTF-8.
[[nodiscard]] std::string to_text(const Plan& plan);

/// The plan in `file`, with paths as they are there. Throws `Error`: not_found, and invalid_input
/// for a file that is no plan, or one of another version.
[[nodiscard]] Plan read_plan(const std::filesystem::path& file);

/// What a path of a plan means here, as an absolute one.
[[nodiscard]] std::filesystem::path resolved(const std::filesystem::path& path,
                                             const std::filesystem::path& plan_file);

}  // namespace bdpt::app
