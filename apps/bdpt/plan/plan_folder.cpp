#include "plan/plan_folder.h"

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "plan/plan_file.h"
#include "plan/planned_files.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

void write_file(const fs::path& file, const std::string& text, FileKind kind)
{
    io::OutputFile output(file);
    output.write(text);
    output.commit();
    if (kind == FileKind::program) {
        std::error_code failure;  // if it fails, the user can run "bash submit.sh"
        fs::permissions(file,
                        fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec,
                        fs::perm_options::add, failure);
    }
}

/// Reads an existing plan, if that is possible.
std::optional<Plan> old_plan(const fs::path& file)
{
    try {
        return read_plan(file);
    } catch (const Error&) {
        return std::nullopt;
    }
}

/// Removes an old plan: its parts are useless for the new one, and its tasks would be refused. Only
/// files in its folder that bdpt has created are removed: `read_plan` accepts no others.
void remove_plan(const fs::path& file)
{
    const std::optional<Plan> plan = old_plan(file);
    const auto remove = [folder = file.parent_path()](const fs::path& name) {
        std::error_code nothing_there;
        fs::remove(folder / name.filename(), nothing_there);  // removes a link, not its target
    };
    std::error_code ignored;
    if (fs::is_regular_file(fs::symlink_status(file, ignored))) {
        remove(plan_name);  // a link or a device is kept, and written into
    }
    if (!plan) {
        return;
    }
    for (const std::vector<fs::path>& parts : parts_by_image(*plan)) {
        std::for_each(parts.begin(), parts.end(), remove);
    }
    if (plan->rates) {
        remove(*plan->rates);
    }
    std::for_each(plan->engine_files.begin(), plan->engine_files.end(), remove);
}

}  // namespace

void check_plan_folder(const fs::path& folder)
{
    std::error_code ignored;
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored)) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: cannot write: this is not a folder", folder.string()));
    }
    // A missing folder is created beside existing ones.
    io::check_writable(fs::exists(folder, ignored)
                           ? folder / plan_name
                           : fs::path((folder / ".").lexically_normal().parent_path()) += ".new");
}

void write_plan(const fs::path& folder, const Plan& plan, const std::vector<EngineFile>& files,
                const std::function<void(const fs::path&)>& write_rates, ExistingPlan existing)
{
    const fs::path file = folder / plan_name;
    const std::string text = to_text(plan);
    std::error_code failure;
    if (fs::exists(file, failure)) {
        if (existing == ExistingPlan::replace) {
            remove_plan(file);
        } else if (old_plan(file) != plan) {
            throw Error(ErrorCode::output,
                        fmt::format("{}: is another plan; --restart replaces it and removes its "
                                    "parts",
                                    file.string()));
        }
    }
    fs::create_directory(folder, failure);
    if (failure) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: cannot write: {}", folder.string(), failure.message()));
    }
    for (const EngineFile& engine_file : files) {
        write_file(file_of_plan(engine_file.name, folder), engine_file.text, engine_file.kind);
    }
    if (plan.rates) {
        write_rates(file_of_plan(*plan.rates, folder));
    }
    write_file(file_of_plan(plan_name, folder), text, FileKind::text);
}

}  // namespace bdpt::app
