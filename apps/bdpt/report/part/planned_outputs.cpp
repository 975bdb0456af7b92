#include "report/part/planned_outputs.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <cstddef>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include "options/groups/strategy_arguments.h"
#include "options/values/output_files.h"
#include "plan/plan_file.h"
#include "report/part/merged_files.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

/// Returns the files that the plan in `file` names for image `image`.
std::set<fs::path> planned_files(const Plan& plan, const fs::path& file, std::size_t image)
{
    const auto name = [&](const fs::path& path) {
        return expand_pattern(resolved(path, file), plan.images[image]);
    };
    std::set<fs::path> result;
    for (const fs::path& output : plan.outputs) {
        result.insert(name(output));
    }
    if (plan.strategies) {
        const std::vector<fs::path> both = StrategyFiles::named(name(*plan.strategies)).both();
        result.insert(both.begin(), both.end());
    }
    return result;
}

}  // namespace

void check_planned_outputs(const MergeArguments& arguments, const Plan& plan)
{
    const std::set<fs::path> planned = planned_files(plan, *arguments.plan, arguments.image);
    for (const fs::path& file : merged_files(arguments)) {
        std::error_code ignored;
        if (planned.contains(file) && fs::exists(file, ignored) && !is_file_of_ours(file)) {
            throw Error(ErrorCode::output,
                        fmt::format("{}: cannot write: the plan names it, but it is not an image "
                                    "of bdpt; remove it, or name other files with -o",
                                    file.string()));
        }
    }
}

}  // namespace bdpt::app
