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

/// A file with the state and callbacks of libjpeg. It is C, so no exception may leave them.
struct JpegFile final : ImageFile {
    jpeg_decompress_struct codec{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf jump{};
    Message error{};
    Message first_damage{};  // empty: none

    JpegFile() = default;
    ~JpegFile() override { jpeg_destroy_decompress(&codec); }

    static JpegFile& of(j_common_ptr codec) { return *static_cast<JpegFile*>(codec->client_data); }

    [[noreturn]] static void fail(j_common_ptr codec)
    {
        JpegFile& file = of(codec);
        codec->err->format_message(codec, file.error.data());
        std::longjmp(file.jump, 1);
    }

    [[noreturn]] void fail(const char* message)
    {
        std::copy_n(message, std::min(std::strlen(message), error.size() - 1), error.begin());
        std::longjmp(jump, 1);
    }

    /// Levels below 0 are damage, all others messages for developers.
    static void note(j_common_ptr codec, int level)
    {
        JpegFile& file = of(codec);
        if (level < 0 && file.first_damage.front() == '\0') {
            codec->err->format_message(codec, file.first_damage.data());
        }
    }

    static void ignore(j_common_ptr) {}

    static void limit_scans(j_common_ptr codec)
    {
        JpegFile& file = of(codec);
        if (file.codec.input_scan_number > max_scans) {
            file.fail("too many scans");
        }
    }

    // libjpeg reports errors by longjmp, so no object with a destructor lives in these functions.
    // They return true on success.

    [[nodiscard]] bool read_header(ByteView bytes)
    {
        codec.client_data = this;
        codec.err = jpeg_std_error(&errors);
        errors.error_exit = &JpegFile::fail;
        errors.emit_message = &JpegFile::note;
        errors.output_message = &JpegFile::ignore;
        progress.progress_monitor = &JpegFile::limit_scans;
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

    void read(std::uint8_t* values) override
    {
        std::vector<std::uint8_t> inks(is_cmyk() ? 4 * std::size_t{codec.image_width} : 0);
        if (!read_rows(values, inks.data())) {
            raise();
        }
    }

    [[nodiscard]] std::string damage() const override
    {
        return first_damage.front() == '\0' ? "" : std::string("JPEG: ") + first_damage.data();
    }

    void set_layout()
    {
        layout_.width = static_cast<int>(codec.image_width);
        layout_.height = static_cast<int>(codec.image_height);
        layout_.channels = is_grey() ? 1 : 3;
    }
};

}  // namespace

std::unique_ptr<ImageFile> open_jpeg(ByteView bytes)
{
    auto file = std::make_unique<JpegFile>();
    if (!file->read_header(bytes)) {
        file->raise();
    }
    file->set_layout();
    return file;
}

}  // namespace bdpt::io
