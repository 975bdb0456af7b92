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

/// State of libpng's callbacks. They are called from C, so no exception may leave them.
struct PngImage::State {
    ByteView rest;  // rest of the file
    std::array<char, 200> message{};
    png_structp png = nullptr;
    png_infop info = nullptr;

    /// Callbacks find the file by its state.
    static void read(png_structp png, png_bytep target, png_size_t size)
    {
        auto& state = *static_cast<State*>(png_get_io_ptr(png));
        if (size > state.rest.size()) {
            png_error(png, "the file ends too early");
        }
        std::copy_n(state.rest.begin(), size, target);
        state.rest = state.rest.subspan(size);
    }

    [[noreturn]] static void fail(png_structp png, png_const_charp message)
    {
        auto& state = *static_cast<State*>(png_get_error_ptr(png));
        const std::size_t length = std::min(std::strlen(message), state.message.size() - 1);
        std::copy_n(message, length, state.message.begin());
        state.message[length] = '\0';
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
};

void PngImage::Close::operator()(State* state) const
{
    const std::unique_ptr<State> owned(state);
    png_destroy_read_struct(&owned->png, &owned->info, nullptr);
}

PngImage::PngImage(ByteView bytes) : state_(new State{.rest = bytes})
{
    State& state = *state_;
    state.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, &State::fail, &State::ignore);
    state.info = state.png != nullptr ? png_create_info_struct(state.png) : nullptr;
    if (state.info == nullptr) {
        throw std::bad_alloc();
    }
    png_set_read_fn(state.png, &state, &State::read);
    if (!state.read_header()) {
        state.raise();
    }
    width_ = static_cast<int>(png_get_image_width(state.png, state.info));
    height_ = static_cast<int>(png_get_image_height(state.png, state.info));
    channels_ = png_get_channels(state.png, state.info);
    value_bytes_ = png_get_bit_depth(state.png, state.info) == 16 ? 2 : 1;
}

void PngImage::read(std::uint8_t* values)
{
    if (!state_->read_rows(values)) {
        state_->raise();
    }
}

}  // namespace bdpt::io
