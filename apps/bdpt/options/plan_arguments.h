#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/render_arguments.h"

namespace CLI {
class App;
}

namespace bdpt::app {

/// What starts the tasks of a plan.
enum class Engine : std::uint8_t { slurm, kubernetes, make, opencue, aws_batch };

/// What the words after `bdpt plan` say, as they were given.
struct PlanWords {
    RenderWords render;
    std::optional<std::int64_t> parts;
    std::optional<double> minutes;
    std::string engine;
    std::string folder;
    bool restart = false;
    const CLI::App* command = nullptr;  ///< that has parsed them
};

/// What a plan that is there already means.
enum class ExistingPlan : std::uint8_t { must_be_equal, replace };

/// The same, understood and checked.
struct PlanArguments {
    RenderArguments render;
    std::vector<std::string> render_options;  ///< as words, but for files, samples and threads
    std::vector<std::string> merge_options;   ///< as words, but for files
    std::optional<std::int64_t> parts;
    double minutes = 0.0;  ///< that a task may take, without `parts`
    Engine engine = Engine::make;
    std::filesystem::path folder;
    ExistingPlan existing = ExistingPlan::must_be_equal;
};

/// Names, as "--size", of the options that a plan may have for the commands of its tasks. They name
/// no files, which have places of their own in the plan, no code that is loaded and no machines.
struct PlannableOptions {
    std::vector<std::string> render;
    std::vector<std::string> merge;
};
[[nodiscard]] PlannableOptions plannable_options();

/// Describes the options of `bdpt plan` to the parser, which will store into `words`.
void add_plan_options(CLI::App& command, PlanWords& words);

/// Throws `Error` (usage) that names the option and the value.
[[nodiscard]] PlanArguments understand(const PlanWords& words);

}  // namespace bdpt::app
