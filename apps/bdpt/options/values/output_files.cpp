#include "options/values/output_files.h"

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "options/values/pipes.h"

namespace bdpt::app {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view stats_start = "{\n  \"version\": \"";  // report/stats_file.h

}  // namespace

namespace {

/// Returns the message for an output whose name does not end in a known extension.
std::string unknown_type(const fs::path& output)
{
    static constexpr std::array<std::string_view, 5> films{".mp4", ".mov", ".avi", ".mkv", ".webm"};
    const bool is_film = std::any_of(films.begin(), films.end(), [&](std::string_view film) {
        return has_extension(output, film);
    });
    const std::string name = fs::path(output).replace_extension().string();
    if (is_film) {
        return fmt::format(
            "{0}: is a video: write frames with --orbit or --frames, -o '{1}.###.png', "
            "and join them with a program such as ffmpeg",
            output.string(), name);
    }
    const bool is_linear = has_extension(output, ".pfm") || has_extension(output, ".dpx");
    return fmt::format(
        "{}: unknown type of image: the name must end in .exr, .hdr, .png, .jpg or "
        ".webp{}",
        output.string(),
        output.has_filename()
            ? fmt::format(" (did you mean {}{}?)", name, is_linear ? ".exr" : ".png")
            : "");
}

}  // namespace

std::optional<ImageType> find_type(const fs::path& output)
{
    using enum ImageType;
    static constexpr std::array<std::pair<std::string_view, ImageType>, 6> types{{{".exr", exr},
                                                                                  {".hdr", hdr},
                                                                                  {".png", png},
                                                                                  {".jpg", jpeg},
                                                                                  {".jpeg", jpeg},
                                                                                  {".webp", webp}}};
    if (output == "-") {
        return exr;
    }
    const bool is_stream = is_standard_output(output);
    const std::string stream = is_stream ? "." + output.string() : "";  // ".png:-"
    for (const auto& [extension, type] : types) {
        if (is_stream ? stream.starts_with(extension) : has_extension(output, extension)) {
            return type;
        }
    }
    return std::nullopt;
}

bool is_for_screens(const fs::path& output)
{
    const std::optional<ImageType> type = find_type(output);
    return type && type != ImageType::exr && type != ImageType::hdr;
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
            throw Error(ErrorCode::usage,
                        fmt::format("{}: cannot be both an input and an output", output.string()));
        }
    }
}

void check_outputs(std::span<const fs::path> outputs, const FileSet& inputs)
{
    check_not_read(outputs, inputs);
    FileSet known;
    for (const fs::path& output : outputs) {
        if (!find_type(output)) {
            throw Error(ErrorCode::usage, unknown_type(output));
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

bool is_file_of_ours(const fs::path& file)
{
    using namespace std::string_view_literals;
    static constexpr std::array signatures{"\x76\x2f\x31\x01"sv, "\x89PNG\r\n\x1a\n"sv,
                                           "\xff\xd8\xff"sv, "#?RADIANCE\n"sv, "RIFF"sv};
    std::error_code ignored;
    if (!fs::is_regular_file(file, ignored)) {
        return false;
    }
    std::ifstream stream(file, std::ios::binary);
    const auto read = [&stream] {
        constexpr std::size_t max_length = std::size_t{1} << 20;
        std::string bytes(max_length, '\0');
        stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        bytes.resize(static_cast<std::size_t>(std::max(stream.gcount(), std::streamsize{0})));
        return bytes;
    };
    std::string start = read();
    if (start.starts_with("RIFF"sv) && stream) {  // its metadata are at the end
        stream.seekg(-static_cast<std::streamoff>(start.size()), std::ios::end);
        start += read();
    }
    const bool is_image =
        std::any_of(signatures.begin(), signatures.end(),
                    [&](std::string_view signature) { return start.starts_with(signature); });
    return (is_image && start.find("bdpt.version"sv) != std::string::npos) ||
           (start.starts_with(stats_start) &&
            start.find("\"stopped_by\": "sv) != std::string::npos);
}

bool writes_exr(std::span<const fs::path> outputs)
{
    return std::any_of(outputs.begin(), outputs.end(),
                       [](const fs::path& output) { return find_type(output) == ImageType::exr; });
}

PendingOutputs pending_outputs(std::span<const fs::path> outputs)
{
    PendingOutputs result;
    for (const fs::path& output : outputs) {
        const bool is_stream = is_standard_output(output);
        std::error_code none;
        const fs::file_status status = fs::status(is_stream ? "/proc/self/fd/1" : output, none);
        if (fs::is_fifo(status) || fs::is_socket(status)) {
            result.have_readers = true;
        } else if (!is_stream) {
            result.temporaries.push_back(io::OutputFile::temporary_path(output));
        }
    }
    return result;
}

}  // namespace bdpt::app
