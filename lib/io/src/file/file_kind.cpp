#include "file/file_kind.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>
#include <string>
#include <string_view>

namespace bdpt::io {

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

}  // namespace bdpt::io
