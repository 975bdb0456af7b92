#include "image/linear/image_readers.h"

#include "file/read_file.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace bdpt::io {

namespace {

constexpr std::size_t flags_offset = 4;
constexpr std::size_t head_size = 8;
constexpr std::uint32_t multi_part_flag = 0x1000;

/// Reads a header from its start to its end. Bytes beyond the file are zero.
class Cursor {
public:
    Cursor(ByteView file, std::size_t position) : file_(file), position_(position) {}

    [[nodiscard]] std::size_t left() const { return file_.size() - position_; }

    [[nodiscard]] std::uint32_t read_u32()
    {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4 && i < left(); ++i) {
            value |= static_cast<std::uint32_t>(file_[position_ + i]) << (8 * i);
        }
        skip(4);
        return value;
    }

    /// Reads text up to a zero byte.
    [[nodiscard]] std::string_view read_text()
    {
        const ByteView rest = file_.subspan(position_);
        const auto length =
            static_cast<std::size_t>(std::find(rest.begin(), rest.end(), 0) - rest.begin());
        skip(length + 1);
        return {reinterpret_cast<const char*>(rest.data()), length};
    }

    void skip(std::size_t count) { position_ += std::min(count, left()); }

private:
    ByteView file_;
    std::size_t position_;
};

[[noreturn]] void refuse_header(const std::string& what)
{
    throw Error(ErrorCode::invalid_input, "OpenEXR: " + what);
}

struct FixedSize {
    std::string_view type;
    std::uint32_t size;
};

constexpr FixedSize fixed_sizes[] = {{"box2f", 16},
                                     {"box2i", 16},
                                     {"chromaticities", 32},
                                     {"compression", 1},
                                     {"deepImageState", 1},
                                     {"double", 8},
                                     {"envmap", 1},
                                     {"float", 4},
                                     {"int", 4},
                                     {"keycode", 28},
                                     {"lineOrder", 1},
                                     {"m33d", 72},
                                     {"m33f", 36},
                                     {"m44d", 128},
                                     {"m44f", 64},
                                     {"rational", 8},
                                     {"tiledesc", 9},
                                     {"timecode", 8},
                                     {"v2d", 16},
                                     {"v2f", 8},
                                     {"v2i", 8},
                                     {"v3d", 24},
                                     {"v3f", 12},
                                     {"v3i", 12}};

/// Returns the size of a list of channels, independently of what its attribute states.
std::size_t channel_list_size(Cursor cursor)
{
    constexpr std::size_t channel_size = 16;
    const std::size_t before = cursor.left();
    while (!cursor.read_text().empty()) {
        cursor.skip(channel_size);
    }
    return before - cursor.left();
}

std::uint64_t preview_size(Cursor cursor)
{
    const std::uint64_t width = cursor.read_u32();
    const std::uint64_t height = cursor.read_u32();
    // Dimensions of 32 bits: their product fits, four times it may not.
    return width * height > UINT32_MAX ? UINT64_MAX : 8 + 4 * width * height;
}

/// Tests whether texts, each preceded by its length, fill `size` bytes.
bool is_text_list(Cursor cursor, std::uint32_t size)
{
    std::uint32_t left = size;
    while (left >= 4) {
        const std::uint32_t length = cursor.read_u32();
        left -= 4;
        if (length > left) {
            return false;
        }
        cursor.skip(length);
        left -= length;
    }
    return left == 0;
}

/// Tests whether a value has the size that its attribute states. Values of most types have a size
/// of their own, which OpenEXR uses. If the two differ, OpenEXR and this code would read the rest
/// of the header differently.
bool has_size(const Cursor& value, std::string_view type, std::uint32_t size)
{
    for (const FixedSize& fixed : fixed_sizes) {
        if (fixed.type == type) {
            return fixed.size == size;
        }
    }
    if (type == "chlist") {
        return channel_list_size(value) == size;
    }
    if (type == "preview") {
        return preview_size(value) == size;
    }
    if (type == "stringvector") {
        return is_text_list(value, size);
    }
    return true;
}

void check_tiles(Cursor description, const ReadLimits& limits)
{
    const std::uint32_t width = description.read_u32();
    const std::uint32_t height = description.read_u32();
    const auto most = static_cast<std::uint32_t>(limits.image_side);
    if (width > most || height > most) {
        refuse_header(fmt::format("tiles of {} x {} pixels, but the limit is {} a side", width,
                                  height, limits.image_side));
    }
}

void check_window(Cursor box, const ReadLimits& limits)
{
    const auto read = [&box] { return std::int64_t{static_cast<std::int32_t>(box.read_u32())}; };
    const std::int64_t left = read();
    const std::int64_t top = read();
    const std::int64_t width = read() - left + 1;
    const std::int64_t height = read() - top + 1;
    const std::int64_t most = limits.image_side;
    if (width < 1 || height < 1 || width > most || height > most) {
        refuse_header(
            fmt::format("image of {} x {} pixels; 1 to {} a side are read", width, height, most));
    }
}

/// Checks one attribute; returns false at the end of the header.
bool check_attribute(Cursor& cursor, const ReadLimits& limits)
{
    const std::string_view name = cursor.read_text();
    if (name.empty()) {
        return false;
    }
    const std::string_view type = cursor.read_text();
    const std::uint32_t size = cursor.read_u32();
    if (size > cursor.left()) {
        refuse_header(fmt::format("attribute {}: {} bytes, but {} are left", quote(name), size,
                                  cursor.left()));
    }
    if (!has_size(cursor, type, size)) {
        refuse_header(fmt::format("attribute {}: {} bytes are not the size of its {}", quote(name),
                                  size, quote(type)));
    }
    if (name == "tiles") {
        check_tiles(cursor, limits);
    } else if (name == "dataWindow" || name == "displayWindow") {
        check_window(cursor, limits);
    }
    cursor.skip(size);
    return true;
}

}  // namespace

void check_exr_header(ByteView file, const ReadLimits& limits)
{
    if (file.size() < head_size) {
        return;
    }
    const bool multi_part = (Cursor(file, flags_offset).read_u32() & multi_part_flag) != 0;
    Cursor cursor(file, head_size);
    bool any = true;
    // Headers of parts follow each other up to an empty one.
    for (bool more = true; more && any; more = multi_part) {
        any = false;
        while (check_attribute(cursor, limits)) {
            any = true;
        }
    }
}

}  // namespace bdpt::io
