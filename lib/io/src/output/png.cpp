#include <bdpt/io/write_image.h>

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fmt/core.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <new>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "output/image_output.h"

namespace bdpt::io {
namespace {

using Text = std::vector<std::pair<std::string, std::string>>;

/// Returns uncompressed UTF-8 entries that point into `text`.
std::vector<png_text> to_png_text(Text& text)
{
    std::vector<png_text> result;
    for (auto& [key, value] : text) {
        png_text entry{};
        entry.compression = PNG_ITXT_COMPRESSION_NONE;
        entry.key = key.data();
        entry.text = value.data();
        entry.itxt_length = value.size();
        result.push_back(entry);
    }
    return result;
}

/// State of libpng's callbacks. They are called from C, so no exception may leave them.
struct Sink {
    std::vector<char> bytes;
    std::string error;
    bool out_of_memory = false;
};

void append(png_structp png, png_bytep data, png_size_t size)
{
    auto& sink = *static_cast<Sink*>(png_get_io_ptr(png));
    try {
        const char* begin = reinterpret_cast<const char*>(data);
        sink.bytes.insert(sink.bytes.end(), begin, begin + size);
        return;
    } catch (const std::bad_alloc&) {
        sink.out_of_memory = true;
    }
    png_error(png, "out of memory");
}

void flush(png_structp) {}

[[noreturn]] void on_error(png_structp png, png_const_charp message)
{
    auto& sink = *static_cast<Sink*>(png_get_error_ptr(png));
    try {
        sink.error = message;
    } catch (const std::bad_alloc&) {
        sink.out_of_memory = true;
    }
    png_longjmp(png, 1);
}

void ignore_warning(png_structp, png_const_charp) {}

/// Pixels to write; a view.
struct Pixels {
    int width;
    int height;
    int channels;  // 1 to 4
    int bits;      // per channel, 8 or 16
    std::span<const std::uint8_t> bytes;

    [[nodiscard]] std::size_t pixel_size() const
    {
        return static_cast<std::size_t>(channels * bits / 8);
    }
};

/// libpng reports errors by longjmp, so no object with a destructor lives in this function. Returns
/// true on success.
bool encode(png_structp png, png_infop info, const Pixels& pixels,
            const std::vector<png_text>& text)
{
    constexpr int color_types[]{PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                PNG_COLOR_TYPE_RGB_ALPHA};
    if (setjmp(png_jmpbuf(png)) != 0) {
        return false;
    }
    png_set_IHDR(png, info, static_cast<png_uint_32>(pixels.width),
                 static_cast<png_uint_32>(pixels.height), pixels.bits,
                 color_types[pixels.channels - 1], PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_text(png, info, text.data(), static_cast<int>(text.size()));
    png_write_info(png, info);
    if (pixels.bits == 16 && std::endian::native == std::endian::little) {
        png_set_swap(png);
    }
    const std::size_t stride = pixels.pixel_size() * static_cast<std::size_t>(pixels.width);
    for (int y = 0; y < pixels.height; ++y) {
        png_write_row(png, pixels.bytes.data() + stride * static_cast<std::size_t>(y));
    }
    png_write_end(png, nullptr);
    return true;
}

void write_pixels(const std::filesystem::path& file, const Pixels& pixels,
                  const PngOptions& options)
{
    // A partial pixel is as wrong as one too many.
    const std::size_t size = pixels.pixel_size();
    const bool whole = pixels.bytes.size() % size == 0;
    check_pixels(file, pixels.width, pixels.height, whole ? pixels.bytes.size() / size : 0);
    Text text = picture_text(options);
    const std::vector<png_text> entries = to_png_text(text);
    Sink sink;
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, &sink, &on_error, &ignore_warning);
    png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
    if (info == nullptr) {
        png_destroy_write_struct(&png, nullptr);
        throw std::bad_alloc();
    }
    png_set_write_fn(png, &sink, &append, &flush);
    const bool encoded = encode(png, info, pixels, entries);
    png_destroy_write_struct(&png, &info);
    if (sink.out_of_memory) {
        throw std::bad_alloc();
    }
    if (!encoded) {
        throw Error(ErrorCode::output,
                    fmt::format("{}: cannot write: {}", file.string(), sink.error));
    }
    OutputFile output(file);
    output.write(sink.bytes);
    output.commit();
}

/// Returns four bytes of a PNG chunk's header as a number.
std::uint32_t chunk_number(std::string_view bytes)
{
    std::uint32_t number = 0;
    for (const char byte : bytes.substr(0, 4)) {
        number = number << 8U | static_cast<std::uint8_t>(byte);
    }
    return number;
}

}  // namespace

bool is_png_of_bdpt(const std::filesystem::path& file)
{
    // `write_png` writes the entry "Software" first, after short chunks.
    constexpr std::size_t enough = 1024;
    constexpr std::size_t signature = 8;
    constexpr std::size_t head = 8;      // of a chunk: its size and its type
    constexpr std::size_t checksum = 4;  // behind the data of a chunk
    std::string start(enough, '\0');
    std::ifstream stream(file, std::ios::binary);
    stream.read(start.data(), static_cast<std::streamsize>(start.size()));
    start.resize(static_cast<std::size_t>(stream.gcount()));
    std::string_view rest = start;
    if (!rest.starts_with("\x89PNG\r\n\x1a\n")) {
        return false;
    }
    rest.remove_prefix(signature);
    while (rest.size() > head) {
        const std::size_t size = chunk_number(rest);
        const std::string_view type = rest.substr(4, 4);
        rest.remove_prefix(head);
        // Keyword, flags for no compression, no language and no translation [PNG, 11.3.4.5].
        using namespace std::string_view_literals;
        if (type == "iTXt" && rest.starts_with("Software\0\0\0\0\0bdpt "sv)) {
            return true;
        }
        rest.remove_prefix(std::min(size + checksum, rest.size()));
    }
    return false;
}

void write_png(const std::filesystem::path& file, const DisplayImage& image,
               const PngOptions& options)
{
    write_pixels(file,
                 {.width = image.width,
                  .height = image.height,
                  .channels = 3,
                  .bits = 8,
                  .bytes = image.rgb},
                 options);
}

void write_png(const std::filesystem::path& file, const TexelImage& image,
               const PngOptions& options)
{
    const bool integers = image.type == TexelType::unorm8 || image.type == TexelType::unorm16;
    if (!integers || image.channels < 1 || image.channels > 4) {
        throw Error(
            ErrorCode::usage,
            fmt::format("{}: a PNG file has 1 to 4 channels of 8 or 16 bits", file.string()));
    }
    write_pixels(file,
                 {.width = image.width,
                  .height = image.height,
                  .channels = image.channels,
                  .bits = static_cast<int>(8 * count_value_bytes(image.type)),
                  .bytes = image.bytes},
                 options);
}

}  // namespace bdpt::io
