#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/render_arguments.h"

namespace bdpt::job {

/// System that starts the tasks of a plan.
enum class Engine : std::uint8_t { slurm, kubernetes, make };

/// Treatment of an existing plan.
enum class ExistingPlan : std::uint8_t { must_be_equal, replace };

/// Arguments of `bdpt plan`.
struct PlanArguments {
    RenderArguments render{};
    std::vector<std::string> render_options{};  ///< as words, without files, samples and threads
    std::vector<std::string> merge_options{};   ///< as words, without files
    std::optional<std::int64_t> parts{};
    double minutes = 0.0;  ///< maximum time of a task, without `parts`
    Engine engine = Engine::make;
    std::filesystem::path folder{};
    ExistingPlan existing = ExistingPlan::must_be_equal;
};

/// Names, such as "--size", of the options that a plan may have for the commands of its tasks. They
/// exclude options that name files (which the plan stores separately), loaded code or machines.
struct PlannableOptions {
    std::vector<std::string> render;
    std::vector<std::string> merge;
};
[[nodiscard]] PlannableOptions plannable_options();

/// Options of `bdpt plan`, as given.
struct PlanRequest {
    RenderRequest render{};
    PlanArguments arguments{};
};

/// Adds the options of `bdpt plan`.
void add_plan_options(OptionList& options, PlanRequest& request);

/// Checks and converts the options. Throws `OptionError` for incompatible ones.
[[nodiscard]] PlanArguments checked(const PlanRequest& request, const OptionList& options);

}  // namespace bdpt::job
