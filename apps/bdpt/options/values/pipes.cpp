#include "options/values/pipes.h"

#include <algorithm>

#include "options/option_list.h"

namespace bdpt::app {

namespace fs = std::filesystem;

std::vector<std::string> standard_output_names()
{
    return {"-", "exr:-", "hdr:-", "png:-", "jpg:-", "webp:-"};
}

bool is_standard_output(const fs::path& output)
{
    const std::vector<std::string> names = standard_output_names();
    return std::find(names.begin(), names.end(), output) != names.end();
}

bool use_standard_output(std::span<const fs::path> outputs)
{
    return std::any_of(outputs.begin(), outputs.end(), is_standard_output);
}

fs::path written_file(const fs::path& output)
{
    return is_standard_output(output) ? fs::path("-") : output;
}

void check_pipes(std::span<const fs::path> inputs, std::span<const fs::path> outputs, Format format)
{
    if (std::count(inputs.begin(), inputs.end(), "-") > 1) {
        throw OptionError("-: the standard input can be used only once");
    }
    if (format == Format::json && use_standard_output(outputs)) {
        throw OptionError("--json: its lines go to the standard output, which another output uses");
    }
}

}  // namespace bdpt::app
