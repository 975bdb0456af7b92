#include "image/encoded_image.h"

#include <cstdio>  // required by the header of libjpeg

#include <jpeglib.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace bdpt::io {

namespace {

using Message = std::array<char, JMSG_LENGTH_MAX>;

/// Encoders write about ten. Each costs the time of a whole image, whatever its size in the file.
constexpr int max_scans = 500;

/// Converts inks to RGB. They are stored as 255 minus their amount, as by Adobe's programs: the
/// fraction of light that each transmits.
void cmyk_to_rgb(const std::uint8_t* cmyk, std::size_t pixels, std::uint8_t* rgb)
{
    for (; pixels > 0; --pixels, cmyk += 4, rgb += 3) {
        for (int c = 0; c < 3; ++c) {
            rgb[c] = static_cast<std::uint8_t>((cmyk[c] * cmyk[3] + 127) / 255);
        }
    }
}

}  // namespace

/// State and callbacks of libjpeg. It is C, so no exception may leave them.
struct JpegImage::State {
    jpeg_decompress_struct codec{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf jump{};
    Message error{};
    Message damage{};  // empty: none

    static State& of(j_common_ptr codec) { return *static_cast<State*>(codec->client_data); }

    [[noreturn]] static void fail(j_common_ptr codec)
    {
        State& state = of(codec);
        codec->err->format_message(codec, state.error.data());
        std::longjmp(state.jump, 1);
    }

    [[noreturn]] void fail(const char* message)
    {
        std::copy_n(message, std::min(std::strlen(message), error.size() - 1), error.begin());
        std::longjmp(jump, 1);
    }

    /// Levels below 0 are damage, all others messages for developers.
    static void note(j_common_ptr codec, int level)
    {
        State& state = of(codec);
        if (level < 0 && state.damage.front() == '\0') {
            codec->err->format_message(codec, state.damage.data());
        }
    }

    static void ignore(j_common_ptr) {}

    static void limit_scans(j_common_ptr codec)
    {
        State& state = of(codec);
        if (state.codec.input_scan_number > max_scans) {
            state.fail("too many scans");
        }
    }

    // libjpeg reports errors by longjmp, so no object with a destructor lives in these functions.
    // They return true on success.

    [[nodiscard]] bool read_header(ByteView bytes)
    {
        codec.client_data = this;
        codec.err = jpeg_std_error(&errors);
        errors.error_exit = &State::fail;
        errors.emit_message = &State::note;
        errors.output_message = &State::ignore;
        progress.progress_monitor = &State::limit_scans;
        if (setjmp(jump) != 0) {
            return false;
        }
        jpeg_create_decompress(&codec);  // clears all but its errors and `client_data`
        codec.progress = &progress;
        jpeg_mem_src(&codec, bytes.data(), bytes.size());
        jpeg_read_header(&codec, TRUE);
        if (codec.data_precision != 8) {
            fail("channels are not of 8 bits");
        }
        choose_colors();
        return true;
    }

    /// Chooses a colour space that libjpeg itself converts to; it does not convert inks to RGB.
    void choose_colors()
    {
        switch (codec.jpeg_color_space) {
            case JCS_GRAYSCALE:
                codec.out_color_space = JCS_GRAYSCALE;
                break;
            case JCS_RGB:
            case JCS_YCbCr:
                codec.out_color_space = JCS_RGB;
                break;
            case JCS_CMYK:
            case JCS_YCCK:
                codec.out_color_space = JCS_CMYK;
                break;
            default:
                fail("channels of unknown meaning");
        }
    }

    [[nodiscard]] bool is_cmyk() const { return codec.out_color_space == JCS_CMYK; }
    [[nodiscard]] bool is_grey() const { return codec.out_color_space == JCS_GRAYSCALE; }

    /// Decodes all rows. `inks` is room for a row of inks, if the image has inks.
    [[nodiscard]] bool read_rows(std::uint8_t* values, std::uint8_t* inks)
    {
        if (setjmp(jump) != 0) {
            return false;
        }
        jpeg_start_decompress(&codec);
        const std::size_t width = codec.output_width;
        const std::size_t stride = width * (is_grey() ? 1 : 3);
        while (codec.output_scanline < codec.output_height) {
            std::uint8_t* const target = values + codec.output_scanline * stride;
            JSAMPROW row = is_cmyk() ? inks : target;
            jpeg_read_scanlines(&codec, &row, 1);
            if (is_cmyk()) {
                cmyk_to_rgb(inks, width, target);
            }
        }
        return true;
    }

    [[noreturn]] void raise() const
    {
        throw std::runtime_error(std::string("JPEG: ") + error.data());
    }
};

void JpegImage::Close::operator()(State* state) const
{
    const std::unique_ptr<State> owned(state);
    jpeg_destroy_decompress(&owned->codec);
}

JpegImage::JpegImage(ByteView bytes) : state_(new State)
{
    State& state = *state_;
    if (!state.read_header(bytes)) {
        state.raise();
    }
    width_ = static_cast<int>(state.codec.image_width);
    height_ = static_cast<int>(state.codec.image_height);
    channels_ = state.is_grey() ? 1 : 3;
}

void JpegImage::read(std::uint8_t* values)
{
    std::vector<std::uint8_t> inks(state_->is_cmyk() ? 4 * std::size_t{state_->codec.image_width}
                                                     : 0);
    if (!state_->read_rows(values, inks.data())) {
        state_->raise();
    }
}

std::string JpegImage::damage() const
{
    const char* const what = state_->damage.data();
    return *what == '\0' ? "" : std::string("JPEG: ") + what;
}

}  // namespace bdpt::io
