#include "file/read_file.h"

#include <bdpt/error.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

namespace bdpt::io {

namespace {

/// A file read from its start.
class OpenFile {
public:
    OpenFile(const std::filesystem::path& file, std::uint64_t limit)
    {
        std::error_code error;
        const std::filesystem::file_status status = std::filesystem::status(file, error);
        if (status.type() == std::filesystem::file_type::not_found) {
            throw Error(ErrorCode::not_found, "no such file");
        }
        // Reading a pipe or a device could wait for ever.
        if (!std::filesystem::is_regular_file(status)) {
            throw Error(ErrorCode::not_found, "cannot be read: not a regular file");
        }
        size_ = std::filesystem::file_size(file, error);
        if (error) {
            throw Error(ErrorCode::not_found, "cannot be read: " + error.message());
        }
        if (size_ > limit) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("{} bytes, but the limit is {}", size_, limit));
        }
        errno = 0;
        stream_.open(file, std::ios::binary);
        if (!stream_) {
            throw Error(ErrorCode::not_found,
                        "cannot be read: " + std::generic_category().message(errno));
        }
    }

    [[nodiscard]] std::uint64_t size() const { return size_; }

    /// Reads the next `size` bytes.
    [[nodiscard]] Bytes read(std::uint64_t size)
    {
        Bytes bytes(static_cast<std::size_t>(size));
        stream_.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
        done_ += static_cast<std::uint64_t>(stream_.gcount());
        if (static_cast<std::uint64_t>(stream_.gcount()) != size) {
            throw Error(ErrorCode::not_found,
                        fmt::format("cannot be read: ends after {} of {} bytes", done_, size_));
        }
        return bytes;
    }

private:
    std::ifstream stream_;
    std::uint64_t size_ = 0;
    std::uint64_t done_ = 0;
};

}  // namespace

bool begins_with(ByteView bytes, std::string_view magic, std::size_t offset)
{
    return bytes.size() >= offset + magic.size() &&
           std::memcmp(bytes.data() + offset, magic.data(), magic.size()) == 0;
}

Bytes read_file(const std::filesystem::path& file, std::uint64_t limit, std::uint64_t most,
                const MemoryBudget* memory)
{
    OpenFile open(file, limit);
    const std::uint64_t size = std::min(open.size(), most);
    if (memory != nullptr) {
        memory->check("the file", size);
    }
    return open.read(size);
}

void for_each_block(const std::filesystem::path& file, std::uint64_t limit,
                    const std::function<void(ByteView)>& visit)
{
    constexpr std::uint64_t block = std::uint64_t{1} << 20U;
    OpenFile open(file, limit);
    for (std::uint64_t left = open.size(); left > 0; left -= std::min(left, block)) {
        visit(open.read(std::min(left, block)));
    }
}

std::string human_bytes(long double bytes)
{
    static constexpr std::array units{"B", "kB", "MB", "GB", "TB", "PB", "EB", "ZB", "YB"};
    std::size_t unit = 0;
    while (bytes >= 1000.0L && unit + 1 < units.size()) {
        bytes /= 1000.0L;
        ++unit;
    }
    return fmt::format("{:.3g} {}", static_cast<double>(bytes), units[unit]);
}

namespace {

constexpr std::uint64_t no_end = std::numeric_limits<std::uint64_t>::max();

/// Reads the next bytes, at most `block.size()`; returns 0 at the end.
std::size_t read_some(std::span<std::uint8_t> block)
{
    ssize_t count = -1;
    do {
        count = ::read(STDIN_FILENO, block.data(), block.size());
    } while (count < 0 && errno == EINTR);
    if (count < 0) {
        throw Error(ErrorCode::not_found,
                    "standard input cannot be read: " + std::generic_category().message(errno));
    }
    return static_cast<std::size_t>(count);
}

/// Reads all bytes, or as many as are worth reading.
Bytes read_all(std::uint64_t limit, const WorthReading& worth, const MemoryBudget* memory)
{
    constexpr std::size_t start_size = 4096;  // enough to recognize its kind
    Bytes bytes;
    std::array<std::uint8_t, 65536> block{};
    std::uint64_t end = no_end;
    bool judged = !worth;
    for (std::size_t count = read_some(block); count > 0; count = read_some(block)) {
        if (memory != nullptr && bytes.size() + count > bytes.capacity()) {
            // Growing copies it to twice the room.
            memory->check("standard input", 3 * bytes.size());
        }
        bytes.insert(bytes.end(), block.begin(),
                     block.begin() + static_cast<std::ptrdiff_t>(count));
        if (!judged && bytes.size() >= start_size) {
            end = worth(bytes);
            judged = true;
        }
        if (bytes.size() > limit) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("standard input has more than {} bytes, the limit", limit));
        }
        if (bytes.size() >= end) {
            break;
        }
    }
    return bytes;
}

Bytes standard_input(std::uint64_t limit, const WorthReading& worth, const MemoryBudget* memory)
{
    static std::mutex mutex;
    static std::optional<Bytes> all;
    const std::lock_guard lock(mutex);
    if (::isatty(STDIN_FILENO) != 0) {
        throw Error(ErrorCode::not_found, "standard input is a terminal, not a file or pipe");
    }
    if (!all) {
        all = read_all(limit, worth, memory);
    }
    return *all;
}

}  // namespace

Bytes read_named(const std::filesystem::path& file, std::uint64_t limit, const WorthReading& worth,
                 const MemoryBudget* memory)
{
    return file == "-" ? standard_input(limit, worth, memory)
                       : read_file(file, limit, no_end, memory);
}

namespace {

using namespace std::string_view_literals;

struct Kind {
    std::string_view start;  // in lower case
    std::string_view name;
};

/// By the first bytes.
constexpr Kind binary_kinds[] = {
    {"\x89png\r\n"sv, "a PNG image"},
    {"\xff\xd8\xff"sv, "a JPEG image"},
    {"gif8"sv, "a GIF image"},
    {"riff"sv, "a RIFF file (such as a WebP image)"},
    {"\x76\x2f\x31\x01"sv, "an OpenEXR image"},
    {"#?"sv, "a Radiance HDR image"},
    {"\xabktx"sv, "a KTX image"},
    {"%pdf"sv, "a PDF document"},
    {"pk\x03\x04"sv, "a ZIP archive"},
    {"\x1f\x8b"sv, "a gzip archive"},
    {"7z\xbc\xaf\x27\x1c"sv, "a 7z archive"},
    {"\x7f\x65lf"sv, "a program"},
    {"kaydara fbx binary"sv, "an FBX file"},
    {"blender"sv, "a Blender file"},
    {"pxr-usdc"sv, "a USD file"},
    {"version https://git-lfs"sv, "a Git LFS pointer: the file itself has not been fetched"},
    {"\xff\xfe"sv, "text in UTF-16, where glTF asks for UTF-8"},
    {"\xfe\xff"sv, "text in UTF-16, where glTF asks for UTF-8"},
};

/// By the first bytes that are not white space.
constexpr Kind text_kinds[] = {
    {"<!doctype html"sv, "an HTML page"}, {"<html"sv, "an HTML page"}, {"<?xml"sv, "an XML file"},
    {"<"sv, "an HTML or XML file"},       {"#usda"sv, "a USD file"},   {"ply\n"sv, "a PLY file"},
    {"ply\r\n"sv, "a PLY file"},          {"solid "sv, "an STL file"},
};

/// By file extension: model formats whose first bytes tell little.
constexpr Kind models[] = {
    {".obj"sv, "a Wavefront OBJ file"}, {".stl"sv, "an STL file"},
    {".ply"sv, "a PLY file"},           {".fbx"sv, "an FBX file"},
    {".dae"sv, "a COLLADA file"},       {".blend"sv, "a Blender file"},
    {".3ds"sv, "a 3DS file"},           {".usd"sv, "a USD file"},
    {".usda"sv, "a USD file"},          {".usdc"sv, "a USD file"},
    {".usdz"sv, "a USD file"},          {".step"sv, "a STEP file"},
    {".stp"sv, "a STEP file"},          {".iges"sv, "an IGES file"},
    {".3mf"sv, "a 3MF file"},
};

bool starts_with(ByteView bytes, std::string_view start)
{
    const auto is_same = [](char expected, std::uint8_t byte) {
        const std::uint8_t lower =
            byte >= 'A' && byte <= 'Z' ? static_cast<std::uint8_t>(byte + ('a' - 'A')) : byte;
        return static_cast<std::uint8_t>(expected) == lower;
    };
    return bytes.size() >= start.size() &&
           std::equal(start.begin(), start.end(), bytes.begin(), is_same);
}

std::optional<std::string_view> find(std::span<const Kind> kinds, ByteView bytes)
{
    const auto found = std::find_if(kinds.begin(), kinds.end(), [bytes](const Kind& kind) {
        return starts_with(bytes, kind.start);
    });
    return found == kinds.end() ? std::nullopt : std::optional(found->name);
}

/// Returns `text` without the byte order mark that it may begin with.
ByteView without_mark(ByteView text)
{
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    return starts_with(text, byte_order_mark) ? text.subspan(byte_order_mark.size()) : text;
}

bool is_space(std::uint8_t byte)
{
    return byte == ' ' || byte == '\t' || byte == '\r' || byte == '\n';
}

}  // namespace

std::optional<std::string_view> other_kind(ByteView file)
{
    if (file.empty()) {
        return "an empty file";
    }
    if (const auto kind = find(binary_kinds, file)) {
        return kind;
    }
    ByteView text = without_mark(file);
    const auto first = std::find_if_not(text.begin(), text.end(), is_space);
    text = text.subspan(static_cast<std::size_t>(first - text.begin()));
    if (text.empty()) {
        return "a file of white space";
    }
    if (text.front() == 0) {
        return "a file that starts with zeros";
    }
    return find(text_kinds, text);
}

std::optional<std::string> kind_instead_of_gltf(ByteView bytes, const std::filesystem::path& file)
{
    const std::string extension = file.extension().string();
    const ByteView end{reinterpret_cast<const std::uint8_t*>(extension.data()), extension.size()};
    const auto* const named =
        std::find_if(std::begin(models), std::end(models), [end](const Kind& model) {
            return end.size() == model.start.size() && starts_with(end, model.start);
        });
    const ByteView text = without_mark(bytes);
    const auto first = std::find_if_not(text.begin(), text.end(), is_space);
    const bool may_be_gltf = first == text.end() || *first == '{';
    const std::optional<std::string_view> kind =
        named != std::end(models) && !may_be_gltf ? std::optional(named->name) : other_kind(bytes);
    if (!kind && (may_be_gltf || *first == '[')) {
        return std::nullopt;
    }
    if (!kind) {
        return "another kind of file: expected .gltf, which is JSON, or .glb";
    }
    const bool is_model = std::any_of(std::begin(models), std::end(models),
                                      [&](const Kind& model) { return model.name == *kind; });
    return std::string(*kind) +
           (is_model ? ": export it as .glb first, from Blender for example" : "");
}

namespace {

/// Returns the library that contains this code, or the program that it is linked into.
std::filesystem::path own_file()
{
    Dl_info info{};
    link_map* loaded = nullptr;
    const bool known = dladdr1(reinterpret_cast<const void*>(&own_file), &info,
                               reinterpret_cast<void**>(&loaded), RTLD_DL_LINKMAP) != 0;
    // The loader has no name for the program itself, and the name that the program was called by
    // could denote any file in the current folder.
    const bool is_library = known && loaded != nullptr && loaded->l_name[0] != '\0';
    return is_library ? loaded->l_name : "/proc/self/exe";
}

}  // namespace

std::filesystem::path own_folder()
{
    std::error_code error;
    return std::filesystem::canonical(own_file(), error).parent_path();
}

std::optional<std::filesystem::path> find_companion(std::string_view name)
{
    std::error_code error;
    const std::filesystem::path here = own_folder();
    for (const char* folder : {BDPT_COMPANION_FOLDERS}) {  // the most likely folder first
        const std::filesystem::path file = here / folder / name;
        if (here.is_absolute() && std::filesystem::exists(file, error)) {
            return file;
        }
    }
    return std::nullopt;
}

std::filesystem::path companion_file(std::string_view name)
{
    if (const std::optional<std::filesystem::path> file = find_companion(name)) {
        return *file;
    }
    std::string tried;
    for (const char* folder : {BDPT_COMPANION_FOLDERS}) {
        const std::filesystem::path file = own_folder() / folder / name;
        tried += (tried.empty() ? "" : ", ") + file.lexically_normal().string();
    }
    throw Error(ErrorCode::unsupported, fmt::format("{} not found (tried {})", name, tried));
}

}  // namespace bdpt::io
