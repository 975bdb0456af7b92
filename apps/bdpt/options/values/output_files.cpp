#include "options/values/output_files.h"

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <string>

#include "options/values/pipes.h"

namespace bdpt::app {
namespace fs = std::filesystem;

std::optional<ImageType> type_of(const fs::path& output)
{
    if (is_standard_output(output)) {
        return output == "png:-" ? ImageType::png : ImageType::exr;
    }
    if (has_extension(output, ".exr")) {
        return ImageType::exr;
    }
    return has_extension(output, ".png") ? std::optional(ImageType::png) : std::nullopt;
}

bool has_extension(const fs::path& file, std::string_view extension)
{
    std::string own = file.extension().string();
    std::transform(own.begin(), own.end(), own.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return own == extension;
}

void check_not_read(std::span<const fs::path> outputs, const FileSet& inputs)
{
    for (const fs::path& output : outputs) {
        if (inputs.contains(output)) {
            throw Error(
                ErrorCode::usage,
                fmt::format("{}: is an input and cannot be the output too", output.string()));
        }
    }
}

void check_outputs(std::span<const fs::path> outputs, const FileSet& inputs)
{
    check_not_read(outputs, inputs);
    FileSet known;
    for (const fs::path& output : outputs) {
        if (!type_of(output)) {
            throw Error(ErrorCode::usage,
                        fmt::format("{}: unknown type of output file: name it .exr or .png",
                                    output.string()));
        }
        if (!known.add(output)) {
            throw Error(ErrorCode::usage,
                        fmt::format("{}: the same output is named twice", output.string()));
        }
        io::check_writable(written_file(output));
    }
}

void check_output(std::string_view option, const fs::path& file, const FileSet& inputs,
                  const FileSet& outputs)
{
    if (inputs.contains(file) || outputs.contains(file)) {
        throw Error(ErrorCode::usage,
                    fmt::format("{} \"{}\": the same file is an input or another output", option,
                                file.string()));
    }
    io::check_writable(file);
}

bool writes_exr(std::span<const fs::path> outputs)
{
    return std::any_of(outputs.begin(), outputs.end(),
                       [](const fs::path& output) { return type_of(output) == ImageType::exr; });
}

std::vector<fs::path> temporary_paths(std::span<const fs::path> outputs)
{
    std::vector<fs::path> result;
    for (const fs::path& output : outputs) {
        if (!is_standard_output(output)) {
            result.push_back(io::OutputFile::temporary_path(output));
        }
    }
    return result;
}

}  // namespace bdpt::app
