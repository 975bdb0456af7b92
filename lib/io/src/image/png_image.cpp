#include "image/encoded_image.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <new>
#include <stdexcept>
#include <string>

namespace bdpt::io {
namespace {

/// A file with the state of libpng's callbacks. They are called from C, so no exception may leave
/// them.
struct PngFile final : ImageFile {
    ByteView rest;  // rest of the file
    std::array<char, 200> message{};
    png_structp png = nullptr;
    png_infop info = nullptr;

    explicit PngFile(ByteView bytes) : rest(bytes)
    {
        png = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &PngFile::fail, &PngFile::ignore);
        info = png != nullptr ? png_create_info_struct(png) : nullptr;
    }
    ~PngFile() override { png_destroy_read_struct(&png, &info, nullptr); }

    static void read_bytes(png_structp png, png_bytep target, png_size_t size)
    {
        auto& file = *static_cast<PngFile*>(png_get_io_ptr(png));
        if (size > file.rest.size()) {
            png_error(png, "the file ends too early");
        }
        std::copy_n(file.rest.begin(), size, target);
        file.rest = file.rest.subspan(size);
    }

    [[noreturn]] static void fail(png_structp png, png_const_charp message)
    {
        auto& file = *static_cast<PngFile*>(png_get_error_ptr(png));
        const std::size_t length = std::min(std::strlen(message), file.message.size() - 1);
        std::copy_n(message, length, file.message.begin());
        file.message[length] = '\0';
        png_longjmp(png, 1);
    }

    static void ignore(png_structp, png_const_charp) {}

    // libpng reports errors by longjmp, so no object with a destructor lives in these functions.
    // They return true on success.

    [[nodiscard]] bool read_header()
    {
        if (setjmp(png_jmpbuf(png)) != 0) {
            return false;
        }
        png_read_info(png, info);
        png_set_expand(png);
        if constexpr (std::endian::native == std::endian::little) {
            png_set_swap(png);
        }
        static_cast<void>(png_set_interlace_handling(png));
        png_read_update_info(png, info);
        return true;
    }

    [[nodiscard]] bool read_rows(std::uint8_t* values)
    {
        if (setjmp(png_jmpbuf(png)) != 0) {
            return false;
        }
        const std::size_t stride = png_get_rowbytes(png, info);
        const png_uint_32 height = png_get_image_height(png, info);
        const int passes = png_set_interlace_handling(png);
        for (int pass = 0; pass < passes; ++pass) {
            for (png_uint_32 y = 0; y < height; ++y) {
                png_read_row(png, values + stride * y, nullptr);
            }
        }
        return true;
    }

    [[noreturn]] void raise() const
    {
        throw std::runtime_error(std::string("PNG: ") + message.data());
    }

    void read(std::uint8_t* values) override
    {
        if (!read_rows(values)) {
            raise();
        }
    }

    void set_layout()
    {
        layout_.width = static_cast<int>(png_get_image_width(png, info));
        layout_.height = static_cast<int>(png_get_image_height(png, info));
        layout_.channels = png_get_channels(png, info);
        layout_.type = png_get_bit_depth(png, info) == 16 ? TexelType::unorm16 : TexelType::unorm8;
    }
};

}  // namespace

std::unique_ptr<ImageFile> open_png(ByteView bytes)
{
    auto file = std::make_unique<PngFile>(bytes);
    if (file->info == nullptr) {
        throw std::bad_alloc();
    }
    png_set_read_fn(file->png, file.get(), &PngFile::read_bytes);
    if (!file->read_header()) {
        file->raise();
    }
    file->set_layout();
    return file;
}

}  // namespace bdpt::io
