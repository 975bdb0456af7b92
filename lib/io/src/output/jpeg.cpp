#include <bdpt/io/write_image.h>

#include <cstdio>  // required by the header of libjpeg

#include <jpeglib.h>

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "output/image_output.h"

namespace bdpt::io {
namespace {

/// State and callbacks of libjpeg. It is C, so no exception may leave them.
struct JpegEncoder {
    jpeg_compress_struct codec{};
    jpeg_error_mgr errors{};
    std::jmp_buf jump{};
    std::array<char, JMSG_LENGTH_MAX> error{};
    unsigned char* bytes = nullptr;  ///< by malloc()
    unsigned long size = 0;

    JpegEncoder() = default;
    JpegEncoder(const JpegEncoder&) = delete;
    JpegEncoder& operator=(const JpegEncoder&) = delete;
    ~JpegEncoder()
    {
        jpeg_destroy_compress(&codec);
        std::free(bytes);
    }

    [[noreturn]] static void fail(j_common_ptr codec)
    {
        auto& encoder = *static_cast<JpegEncoder*>(codec->client_data);
        codec->err->format_message(codec, encoder.error.data());
        std::longjmp(encoder.jump, 1);
    }

    static void ignore(j_common_ptr) {}

    /// libjpeg reports errors by longjmp, so no object with a destructor lives in this function.
    /// Returns true on success.
    [[nodiscard]] bool encode(const TexelImage& image, std::span<const std::string> comments)
    {
        constexpr int quality = 95;
        codec.client_data = this;
        codec.err = jpeg_std_error(&errors);
        errors.error_exit = &JpegEncoder::fail;
        errors.output_message = &JpegEncoder::ignore;
        if (setjmp(jump) != 0) {
            return false;
        }
        jpeg_create_compress(&codec);  // clears all but its errors and `client_data`
        jpeg_mem_dest(&codec, &bytes, &size);
        codec.image_width = static_cast<JDIMENSION>(image.width);
        codec.image_height = static_cast<JDIMENSION>(image.height);
        codec.input_components = image.channels;
        codec.in_color_space = image.channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
        jpeg_set_defaults(&codec);
        jpeg_set_quality(&codec, quality, TRUE);
        codec.comp_info[0].h_samp_factor = 1;  // keeps edges of saturated colours sharp
        codec.comp_info[0].v_samp_factor = 1;
        jpeg_start_compress(&codec, TRUE);
        for (const std::string& comment : comments) {
            jpeg_write_marker(&codec, JPEG_COM, reinterpret_cast<const JOCTET*>(comment.data()),
                              static_cast<unsigned int>(comment.size()));
        }
        const std::size_t stride =
            static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels);
        while (codec.next_scanline < codec.image_height) {
            // libjpeg does not write to the row, whatever the type says.
            auto* row = const_cast<JSAMPLE*>(image.bytes.data() + codec.next_scanline * stride);
            jpeg_write_scanlines(&codec, &row, 1);
        }
        jpeg_finish_compress(&codec);
        return true;
    }
};

/// Returns "name: value" texts, without those that do not fit into a comment.
std::vector<std::string> make_comments(const PngOptions& options)
{
    constexpr std::size_t longest = 65533;
    std::vector<std::string> comments;
    for (const auto& [name, value] : picture_text(options)) {
        comments.push_back(fmt::format("{}: {}", name, value));
    }
    std::erase_if(comments, [](const std::string& text) { return text.size() > longest; });
    return comments;
}

}  // namespace

void write_jpeg(const std::filesystem::path& file, const TexelImage& image,
                const PngOptions& options)
{
    if (image.type != TexelType::unorm8 || (image.channels != 1 && image.channels != 3)) {
        throw Error(ErrorCode::usage,
                    fmt::format("{}: a JPEG file has 1 or 3 channels of 8 bits", file.string()));
    }
    const auto channels = static_cast<std::size_t>(image.channels);
    const bool whole = image.bytes.size() % channels == 0;
    check_pixels(file, image.width, image.height, whole ? image.bytes.size() / channels : 0);
    const std::vector<std::string> comments = make_comments(options);
    const auto encoder = std::make_unique<JpegEncoder>();
    if (!encoder->encode(image, comments)) {
        throw Error(ErrorCode::output, fmt::format("{}: cannot write: JPEG: {}", file.string(),
                                                   encoder->error.data()));
    }
    OutputFile output(file);
    output.write({reinterpret_cast<const char*>(encoder->bytes), encoder->size});
    output.commit();
}

}  // namespace bdpt::io
