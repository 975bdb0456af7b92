#include "stage/input_files.h"

#include <string>

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
    if (arguments.denoise && arguments.denoise->library) {
        files.push_back(*arguments.denoise->library);
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

}  // namespace bdpt::app
