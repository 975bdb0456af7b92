#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/render_arguments.h"

namespace bdpt::app {

/// What starts the tasks of a plan.
enum class Engine : std::uint8_t { slurm, kubernetes, make, opencue, aws_batch };

/// What a plan that is there already means.
enum class ExistingPlan : std::uint8_t { must_be_equal, replace };

/// What `bdpt plan` is to do.
struct PlanArguments {
    RenderArguments render{};
    std::vector<std::string> render_options{};  ///< as words, but for files, samples and threads
    std::vector<std::string> merge_options{};   ///< as words, but for files
    std::optional<std::int64_t> parts{};
    double minutes = 0.0;  ///< that a task may take, without `parts`
    Engine engine = Engine::make;
    std::filesystem::path folder{};
    ExistingPlan existing = ExistingPlan::must_be_equal;
};

/// Names, as "--size", of the options that a plan may have for the commands of its tasks. They name
/// no files, which have places of their own in the plan, no code that is loaded and no machines.
struct PlannableOptions {
    std::vector<std::string> render;
    std::vector<std::string> merge;
};
[[nodiscard]] PlannableOptions plannable_options();

/// The options of `bdpt plan`, as they are given.
struct PlanRequest {
    RenderRequest render{};
    PlanArguments arguments{};
};

extern const char* const plan_footer;

/// Adds the options of `bdpt plan`.
void add_plan_options(OptionList& options, PlanRequest& request);

/// Throws `OptionError` for options that do not go together.
[[nodiscard]] PlanArguments checked(const PlanRequest& request, const OptionList& options);

}  // namespace bdpt::app
