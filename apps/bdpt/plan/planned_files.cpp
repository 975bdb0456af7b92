#include "plan/planned_files.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <system_error>

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 5> engine_file_names{
    "submit.sh", "tasks.sbatch", "merge.sbatch", "kubernetes.yaml", "Makefile"};

constexpr std::string_view part_start = "task-";
constexpr std::string_view frame_place = ".####";
constexpr std::string_view camera_suffix = ".{camera}";
constexpr std::string_view part_end = ".part.exr";

/// Removes `start` from the front of `text`; returns false if it is not there.
bool take(std::string_view& text, std::string_view start)
{
    const bool is_there = text.starts_with(start);
    text.remove_prefix(is_there ? start.size() : 0);
    return is_there;
}

}  // namespace

std::string part_name(const PlanImage& image, std::size_t task, std::size_t count)
{
    const std::size_t digits = std::to_string(count - 1).size();
    return fmt::format("{}{:0{}}{}{}{}", part_start, task, digits, image.frame ? frame_place : "",
                       image.camera ? camera_suffix : "", part_end);
}

bool is_part_of_task(std::string_view name)
{
    if (!take(name, part_start)) {
        return false;
    }
    const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
    name.remove_prefix(digits);
    take(name, frame_place);
    take(name, camera_suffix);
    return digits > 0 && name == part_end;
}

bool is_engine_file(std::string_view name)
{
    return std::find(engine_file_names.begin(), engine_file_names.end(), name) !=
           engine_file_names.end();
}

fs::path file_of_plan(const fs::path& name, const fs::path& folder)
{
    const fs::path file = folder / name;
    std::error_code ignored;
    if (fs::is_symlink(file, ignored)) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("{}: is a symbolic link; the files of a plan must be in its folder",
                                file.string()));
    }
    return file;
}

}  // namespace bdpt::app
