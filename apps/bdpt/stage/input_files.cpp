#include "stage/input_files.h"

#include <bdpt/error.h>
#include <bdpt/io/gltf.h>

#include <algorithm>
#include <string>
#include <system_error>

namespace bdpt::app {

namespace fs = std::filesystem;

std::vector<fs::path> input_files(const RenderArguments& arguments)
{
    std::vector<fs::path> files{arguments.file};
    const std::string environment = arguments.environment.value_or("none");
    if (is_file_of_environment(environment)) {
        files.emplace_back(environment);
    }
    if (arguments.volume) {
        files.push_back(arguments.volume->file);
    }
    if (arguments.rates && arguments.rates->file) {
        files.push_back(*arguments.rates->file);
    }
    if (arguments.part && arguments.part->plan) {
        files.push_back(*arguments.part->plan);
    }
    if (arguments.denoise.library) {
        files.push_back(*arguments.denoise.library);
    }
    if (arguments.scene.ktx_library) {
        files.push_back(*arguments.scene.ktx_library);
    }
    if (arguments.job) {
        files.push_back(arguments.job->file);
    }
    if (arguments.display.backdrop && !arguments.display.backdrop->photo.empty()) {
        files.push_back(arguments.display.backdrop->photo);
    }
    std::erase(files, "-");  // the standard input, which no output overwrites
    return files;
}

std::vector<fs::path> input_files(const RenderArguments& arguments, const PreparedScene& stage)
{
    std::vector<fs::path> files = input_files(arguments);
    files.insert(files.end(), stage.files.begin(), stage.files.end());
    return files;
}

std::vector<fs::path> named_files(const RenderArguments& arguments,
                                  std::span<const fs::path> outputs)
{
    const bool replaces = std::any_of(outputs.begin(), outputs.end(), [](const fs::path& output) {
        std::error_code ignored;
        return fs::exists(output, ignored);
    });
    if (!replaces || arguments.file == "-") {
        return {};
    }
    try {
        return io::read_gltf_files(arguments.file, arguments.scene.limits,
                                   arguments.scene.allowed_folders);
    } catch (const Error&) {
        return {};  // what is wrong is said when the scene is loaded
    }
}

}  // namespace bdpt::app
