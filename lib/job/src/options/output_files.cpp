#include "options/output_files.h"

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <bdpt/io/write_image.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <system_error>

#include "options/option_list.h"
#include "options/value_types.h"

namespace bdpt::job {

namespace {

namespace fs = std::filesystem;

/// Returns device and inode of a file; none: it does not exist.
std::optional<std::pair<dev_t, ino_t>> find_identity(const fs::path& file)
{
    struct stat status {};
    const int result =
        is_standard_output(file) ? ::fstat(STDOUT_FILENO, &status) : ::stat(file.c_str(), &status);
    return result == 0 ? std::optional(std::pair(status.st_dev, status.st_ino)) : std::nullopt;
}

/// Returns the resolved path of a file that does not exist.
fs::path resolve_path(const fs::path& file)
{
    if (is_standard_output(file)) {
        return "-";
    }
    std::error_code missing;
    return fs::weakly_canonical(fs::absolute(io::follow_links(file), missing), missing);
}

}  // namespace

bool FileSet::add(const fs::path& file)
{
    const auto identity = find_identity(file);
    return identity ? there_.insert(*identity).second
                    : not_there_.insert(resolve_path(file)).second;
}

void FileSet::add(const std::vector<fs::path>& files)
{
    for (const fs::path& file : files) {
        static_cast<void>(add(file));
    }
}

bool FileSet::contains(const fs::path& file) const
{
    const auto identity = find_identity(file);
    return identity ? there_.contains(*identity) : not_there_.contains(resolve_path(file));
}

bool is_below(const fs::path& file, const fs::path& folder)
{
    const fs::path way = resolve_path(file).lexically_relative(resolve_path(folder / "."));
    return !way.empty() && way != "." && *way.begin() != "..";
}

namespace {

constexpr std::string_view stats_start = "{\n  \"version\": \"";  // of `write_stats_file`

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
    return lower_case(file.extension().string()) == extension;
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

void write_text(const fs::path& file, const std::string& text)
{
    io::OutputFile output(file);
    output.write(text);
    output.commit();
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

std::vector<std::string> standard_output_names()
{
    return {"-", "exr:-", "hdr:-", "png:-", "jpg:-", "webp:-"};
}

bool is_standard_output(const fs::path& output)
{
    return is_among(standard_output_names(), output);
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

namespace {

constexpr std::string_view camera_place = "{camera}";
constexpr std::string_view scene_place = "{name}";

std::string as_file_name(std::string word)
{
    for (std::size_t i = 0; i < word.size(); ++i) {
        const auto c = static_cast<unsigned char>(word[i]);
        const bool special = c < 0x20 || c == 0x7f || c == '/' || c == '\\' || c == ':';
        if (special || (i == 0 && c == '.')) {
            word[i] = '_';
        }
    }
    return word;
}

/// Replaces `place` by `word` in the name of `file`.
fs::path with_word(const fs::path& file, std::string_view place, const std::string& word)
{
    std::string name = file.filename().string();
    const std::string replacement = as_file_name(word);
    for (std::size_t at = name.find(place); at != std::string::npos;
         at = name.find(place, at + replacement.size())) {
        name.replace(at, place.size(), replacement);
    }
    return file.parent_path() / name;
}

}  // namespace

bool takes_number(const fs::path& file)
{
    return file.filename().string().find('#') != std::string::npos;
}

fs::path with_number(const fs::path& file, int number)
{
    std::string name = file.filename().string();
    const std::size_t begin = name.find('#');
    if (begin == std::string::npos) {
        return file;
    }
    const std::size_t end = std::min(name.find_first_not_of('#', begin), name.size());
    if (name.find('#', end) != std::string::npos) {
        throw OptionError(fmt::format("{}: expected one run of # in the name, for the frame number",
                                      file.string()));
    }
    const std::string digits =
        fmt::format("{}{:0{}}", number < 0 ? "-" : "", std::abs(std::int64_t{number}), end - begin);
    return file.parent_path() / name.replace(begin, end - begin, digits);
}

bool takes_camera(const fs::path& file)
{
    return file.filename().string().find(camera_place) != std::string::npos;
}

fs::path with_camera(const fs::path& file, const std::string& camera)
{
    return with_word(file, camera_place, camera);
}

fs::path with_scene(const fs::path& file, const std::string& name)
{
    return with_word(file, scene_place, name);
}

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

TemporaryFolder::TemporaryFolder()
{
    std::error_code error;
    std::string name = (std::filesystem::temp_directory_path(error) / "bdpt-XXXXXX").string();
    if (error || ::mkdtemp(name.data()) == nullptr) {
        throw Error(ErrorCode::output, fmt::format("{}: cannot make a temporary folder", name));
    }
    path_ = name;
}

TemporaryFolder::~TemporaryFolder()
{
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

}  // namespace bdpt::job
