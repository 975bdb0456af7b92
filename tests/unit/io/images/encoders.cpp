#include "encoders.h"

#include <cstdio>  // for the header of libjpeg

#include <jpeglib.h>
#include <webp/encode.h>

#include <cstdint>
#include <cstdlib>
#include <stdexcept>

namespace bdpt::io {

namespace {

void choose(jpeg_compress_struct& codec, JpegKind kind)
{
    switch (kind) {
        case JpegKind::baseline:
            for (int c = 0; c < 3; ++c) {
                codec.comp_info[c].h_samp_factor = 1;
                codec.comp_info[c].v_samp_factor = 1;
            }
            break;
        case JpegKind::progressive:
            jpeg_simple_progression(&codec);
            break;
        case JpegKind::restarts:
            codec.restart_interval = 2;
            break;
        case JpegKind::rgb:
            jpeg_set_colorspace(&codec, JCS_RGB);
            break;
        case JpegKind::cmyk:
            jpeg_set_colorspace(&codec, JCS_CMYK);
            break;
        case JpegKind::ycck:
            jpeg_set_colorspace(&codec, JCS_YCCK);
            break;
        case JpegKind::subsampled:
        case JpegKind::grey:
        case JpegKind::two_channels:
            break;
    }
}

J_COLOR_SPACE color_space(int channels)
{
    switch (channels) {
        case 1:
            return JCS_GRAYSCALE;
        case 2:
            return JCS_UNKNOWN;
        case 3:
            return JCS_RGB;
        default:
            return JCS_CMYK;
    }
}

/// Little-endian.
std::string number(int value, int bytes)
{
    std::string text;
    for (int i = 0; i < bytes; ++i) {
        text.push_back(static_cast<char>(std::int64_t{value} >> (8 * i) & 255));
    }
    return text;
}

std::string chunk(const std::string& name, const std::string& data)
{
    return name + number(static_cast<int>(data.size()), 4) + data +
           std::string(data.size() % 2, '\0');
}

std::string frame_chunk(const Frame& frame, int x, int y)
{
    constexpr int milliseconds = 40;
    return chunk("ANMF", number(x / 2, 3) + number(y / 2, 3) + number(frame.width - 1, 3) +
                             number(frame.height - 1, 3) + number(milliseconds, 3) + '\0' +
                             frame.file.substr(12));
}

}  // namespace

Picture make_picture(int width, int height, int channels)
{
    Picture picture{.width = width, .height = height, .channels = channels};
    std::uint32_t noise = 1;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < channels; ++c) {
                noise = noise * 1664525U + 1013904223U;
                const int slope = c % 2 == 0 ? 230 * x / width : 230 * y / height;
                picture.values.push_back(static_cast<std::uint8_t>(
                    (slope + 60 * c + static_cast<int>(noise >> 28U)) % 256));
            }
        }
    }
    return picture;
}

int channels_of(JpegKind kind)
{
    switch (kind) {
        case JpegKind::grey:
            return 1;
        case JpegKind::two_channels:
            return 2;
        case JpegKind::cmyk:
        case JpegKind::ycck:
            return 4;
        default:
            return 3;
    }
}

std::string encode_jpeg(const Picture& picture, JpegKind kind)
{
    // With its own handler of errors libjpeg ends the process, which fails the test.
    jpeg_compress_struct codec{};
    jpeg_error_mgr errors{};
    codec.err = jpeg_std_error(&errors);
    jpeg_create_compress(&codec);
    unsigned char* bytes = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&codec, &bytes, &size);
    codec.image_width = static_cast<JDIMENSION>(picture.width);
    codec.image_height = static_cast<JDIMENSION>(picture.height);
    codec.input_components = picture.channels;
    codec.in_color_space = color_space(picture.channels);
    jpeg_set_defaults(&codec);
    jpeg_set_quality(&codec, 92, TRUE);
    choose(codec, kind);
    jpeg_start_compress(&codec, TRUE);
    std::vector<std::uint8_t> values = picture.values;
    const auto stride = static_cast<std::size_t>(picture.width * picture.channels);
    for (std::size_t y = 0; y < static_cast<std::size_t>(picture.height); ++y) {
        JSAMPROW row = values.data() + y * stride;
        jpeg_write_scanlines(&codec, &row, 1);
    }
    jpeg_finish_compress(&codec);
    jpeg_destroy_compress(&codec);
    std::string file(reinterpret_cast<const char*>(bytes), size);
    std::free(bytes);
    return file;
}

std::string repeat_scan(const std::string& file, int times)
{
    constexpr std::size_t end = 2;  // bytes of the mark behind the last scan
    const std::size_t scan = file.rfind("\xff\xda");
    std::string longer = file.substr(0, file.size() - end);
    for (int i = 0; i < times; ++i) {
        longer += file.substr(scan, file.size() - end - scan);
    }
    return longer + file.substr(file.size() - end);
}

std::string encode_webp(const Picture& picture, bool lossless)
{
    WebPConfig config;
    WebPPicture source;
    if (WebPConfigInit(&config) == 0 || WebPPictureInit(&source) == 0) {
        throw std::runtime_error("another version of libwebp");
    }
    config.lossless = lossless ? 1 : 0;
    config.exact = 1;
    config.quality = 90;
    source.use_argb = config.lossless;
    source.width = picture.width;
    source.height = picture.height;
    WebPMemoryWriter writer;
    WebPMemoryWriterInit(&writer);
    source.writer = &WebPMemoryWrite;
    source.custom_ptr = &writer;
    const int stride = picture.width * picture.channels;
    const int imported = picture.channels == 4
                             ? WebPPictureImportRGBA(&source, picture.values.data(), stride)
                             : WebPPictureImportRGB(&source, picture.values.data(), stride);
    const int encoded = imported != 0 ? WebPEncode(&config, &source) : 0;
    WebPPictureFree(&source);
    const std::string file(reinterpret_cast<const char*>(writer.mem), writer.size);
    WebPMemoryWriterClear(&writer);
    if (encoded == 0) {
        throw std::runtime_error("libwebp cannot encode the picture");
    }
    return file;
}

std::string animate(int width, int height, const Frame& first, int x, int y, const Frame& second)
{
    constexpr int is_animation = 0x02;
    constexpr int has_alpha = 0x10;
    const std::string chunks =
        chunk("VP8X",
              number(is_animation | has_alpha, 4) + number(width - 1, 3) + number(height - 1, 3)) +
        chunk("ANIM", number(0, 6)) + frame_chunk(first, x, y) + frame_chunk(second, 0, 0);
    return chunk("RIFF", "WEBP" + chunks);
}

ByteView view(const std::string& file)
{
    return {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
}

}  // namespace bdpt::io
