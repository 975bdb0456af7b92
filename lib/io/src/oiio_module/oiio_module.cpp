#include "image/linear/oiio_interface.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <utility>

namespace {

void report(const std::string& text, char* message, std::size_t size)
{
    if (size == 0) {
        return;
    }
    const std::size_t length = std::min(text.size(), size - 1);
    std::memcpy(message, text.data(), length);
    message[length] = '\0';
    std::replace(message, message + length, '\n', ' ');
}

BdptImageHeader describe(const OIIO::ImageSpec& spec)
{
    const bool has_floats = spec.format.is_floating_point() && spec.channelformats.empty();
    return {.width = spec.width,
            .height = spec.height,
            .channels = spec.nchannels,
            .has_floats = has_floats ? 1 : 0,
            .orientation = spec.get_int_attribute("Orientation", 1),
            .tile_width = spec.tile_width,
            .tile_height = spec.tile_height};
}

}  // namespace

struct BdptImage {
    BdptImage(const unsigned char* bytes, std::size_t size) : file(bytes, size) {}

    OIIO::Filesystem::IOMemReader file;
    std::unique_ptr<OIIO::ImageInput> input;
};

extern "C" {

__attribute__((visibility("default"))) int bdpt_oiio_version()
{
    return bdpt_oiio_interface_version;
}

__attribute__((visibility("default"))) BdptImage* bdpt_oiio_open(
    const char* format, const unsigned char* bytes, std::size_t size, BdptImageHeader* header,
    char* message, std::size_t message_size)
{
    try {
        // The caller decodes several images at once; a pool of threads would outlive it. Set once,
        // as OpenImageIO must not be configured by two threads at the same time.
        [[maybe_unused]] static const bool is_told = OIIO::attribute("threads", 1);
        auto image = std::make_unique<BdptImage>(bytes, size);
        image->input = OIIO::ImageInput::create(format);
        if (!image->input) {
            report(OIIO::geterror(), message, message_size);
            return nullptr;
        }
        OIIO::ImageSpec wish;
        wish.attribute("oiio:UnassociatedAlpha", 1);
        OIIO::Filesystem::IOProxy* proxy = &image->file;
        wish.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
        OIIO::ImageSpec spec;
        if (!image->input->open(std::string("memory.") + format, spec, wish)) {
            report(image->input->geterror(), message, message_size);
            return nullptr;
        }
        if (spec.depth > 1 || spec.deep) {
            report("neither volumes nor deep images are read", message, message_size);
            return nullptr;
        }
        *header = describe(spec);
        return image.release();
    } catch (const std::exception& error) {
        report(error.what(), message, message_size);
    } catch (...) {
        report("unknown exception", message, message_size);
    }
    return nullptr;
}

__attribute__((visibility("default"))) int bdpt_oiio_read_floats(BdptImage* image, float* pixels,
                                                                 char* message,
                                                                 std::size_t message_size)
{
    try {
        const int channels = image->input->spec().nchannels;
        if (image->input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, pixels)) {
            return 1;
        }
        report(image->input->geterror(), message, message_size);
    } catch (const std::exception& error) {
        report(error.what(), message, message_size);
    } catch (...) {
        report("unknown exception", message, message_size);
    }
    return 0;
}

__attribute__((visibility("default"))) void bdpt_oiio_close(BdptImage* image)
{
    const std::unique_ptr<BdptImage> owned(image);
}
}
