#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "options/plan_arguments.h"
#include "plan/plan.h"

namespace bdpt::job {

/// Texts of the files of apps/bdpt/plan/engines, with names like \@COUNT\@ in place of values.
namespace engine_texts {
[[nodiscard]] std::string_view submit_sh();
[[nodiscard]] std::string_view tasks_sbatch();
[[nodiscard]] std::string_view merge_sbatch();
[[nodiscard]] std::string_view kubernetes_head();
[[nodiscard]] std::string_view kubernetes_job();
[[nodiscard]] std::string_view kubernetes_tasks();
[[nodiscard]] std::string_view kubernetes_merge();
[[nodiscard]] std::string_view makefile();
}  // namespace engine_texts

enum class FileKind : std::uint8_t { text, program };

/// A file by which an engine starts tasks.
struct EngineFile {
    std::string name;
    std::string text;
    FileKind kind = FileKind::text;
};

/// Returns the files of `plan`, whose file is plan.json in `folder`, which is absolute.
[[nodiscard]] std::vector<EngineFile> engine_files(Engine engine, const Plan& plan,
                                                   const std::filesystem::path& folder);

/// Returns the command that the user types to start the tasks.
[[nodiscard]] std::string start_command(Engine engine, const std::filesystem::path& folder);

/// Throws `Error` (output), before anything is loaded, for a folder that could not be written.
void check_plan_folder(const std::filesystem::path& folder);

/// Writes `plan` as plan.json into `folder`, which is created if necessary. Before that it writes
/// `files`, and calls `write_rates` with the file for rates, so that a plan is always complete.
/// `write_rates` is not called for plans without rates. Throws `Error`: output, also if another
/// plan exists and is not to be replaced; invalid_input for a symbolic link in a file's place.
void write_plan(const std::filesystem::path& folder, const Plan& plan,
                const std::vector<EngineFile>& files,
                const std::function<void(const std::filesystem::path&)>& write_rates,
                ExistingPlan existing);

}  // namespace bdpt::job
