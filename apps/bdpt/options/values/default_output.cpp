#include "options/values/default_output.h"

#include <bdpt/error.h>
#include <bdpt/io/png.h>
#include <fmt/core.h>

#include <system_error>

namespace bdpt::app {

namespace fs = std::filesystem;

fs::path default_output(const fs::path& file)
{
    fs::path output = file.filename().replace_extension(".png");
    std::error_code unknown;
    const fs::file_status there = fs::symlink_status(output, unknown);
    const bool is_free = there.type() == fs::file_type::not_found;
    if (!is_free && !(fs::is_regular_file(there) && io::is_png_of_bdpt(output))) {
        throw Error(ErrorCode::output,
                    fmt::format("{0}: exists and was not written by bdpt: -o {0} replaces it, -o "
                                "with another name keeps it",
                                output.string()));
    }
    return output;
}

}  // namespace bdpt::app
