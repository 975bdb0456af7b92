#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "options/plan_arguments.h"
#include "plan/plan.h"

namespace bdpt::app {

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

}  // namespace bdpt::app
