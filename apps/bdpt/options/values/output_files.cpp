#include "options/values/output_files.h"

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <system_error>

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

bool same_file(const fs::path& a, const fs::path& b)
{
    if (is_standard_output(a) || is_standard_output(b)) {
        return is_standard_output(a) && is_standard_output(b);
    }
    std::error_code missing;
    return fs::weakly_canonical(a, missing) == fs::weakly_canonical(b, missing);
}

bool has_extension(const fs::path& file, std::string_view extension)
{
    std::string own = file.extension().string();
    std::transform(own.begin(), own.end(), own.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return own == extension;
}

void check_outputs(std::span<const fs::path> outputs, std::span<const fs::path> inputs)
{
    for (const fs::path& output : outputs) {
        if (!type_of(output)) {
            throw Error(ErrorCode::usage,
                        fmt::format("{}: unknown type of output file: name it .exr or .png",
                                    output.string()));
        }
        for (const fs::path& input : inputs) {
            std::error_code missing;
            if (fs::equivalent(input, output, missing)) {
                throw Error(
                    ErrorCode::usage,
                    fmt::format("{}: is an input and cannot be the output too", output.string()));
            }
        }
        io::check_writable(written_file(output));
    }
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (same_file(outputs[i], outputs[k])) {
                throw Error(ErrorCode::usage,
                            fmt::format("{}: the same output is named twice", outputs[i].string()));
            }
        }
    }
}

void check_part_file(const fs::path& file, std::span<const fs::path> others)
{
    for (const fs::path& other : others) {
        if (same_file(file, other)) {
            throw Error(ErrorCode::usage,
                        fmt::format("--part \"{}\": the same file is an input or another output",
                                    file.string()));
        }
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
