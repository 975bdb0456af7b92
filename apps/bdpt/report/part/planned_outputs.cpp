#include "report/part/planned_outputs.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "options/groups/strategy_arguments.h"
#include "plan/plan_file.h"
#include "report/part/merged_files.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;
using namespace std::string_view_literals;

/// Tests for the signature of OpenEXR or PNG, with an entry of bdpt before the pixels.
bool is_image_of_ours(const fs::path& file)
{
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) {
        return false;
    }
    constexpr std::size_t max_length = std::size_t{1} << 20;
    std::string start(max_length, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(std::max(stream.gcount(), std::streamsize{0})));
    const bool is_image =
        start.starts_with("\x76\x2f\x31\x01"sv) || start.starts_with("\x89PNG\r\n\x1a\n"sv);
    return is_image && start.find("bdpt.version"sv) != std::string::npos;
}

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
        if (planned.contains(file) && fs::exists(file, ignored) && !is_image_of_ours(file)) {
            throw Error(ErrorCode::output,
                        fmt::format("{}: cannot write: the plan names it, but it is not an image "
                                    "of bdpt; remove it, or name other files with -o",
                                    file.string()));
        }
    }
}

}  // namespace bdpt::app
