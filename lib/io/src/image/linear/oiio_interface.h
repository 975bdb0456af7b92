#pragma once

#include <cstddef>

// Interface of the module bdpt_oiio. It is opened when the first TIFF image is decoded and not
// before: OpenImageIO with all its dependencies would cost every start of the program 0.3 s and 130
// MB. Plain C types, no exceptions. Errors are a message in `message`, which ends with a zero byte.
extern "C" {

struct BdptImage;  // an open image

struct BdptImageHeader {
    int width;
    int height;
    int channels;
    int has_floats;   // 1 if values are stored as floats, of any size
    int orientation;  // as in TIFF; 1: row 0 is the top row
    int tile_width;   // 0 if the image is not stored in tiles
    int tile_height;
};

/// Changes whenever anything in this file does.
constexpr int bdpt_oiio_interface_version = 4;
int bdpt_oiio_version();

/// Opens an image in memory, which must stay there until the image is closed. `format` is a name of
/// OpenImageIO's. Returns null on failure. Images may be opened and read on several threads at
/// once, each on one at a time.
BdptImage* bdpt_oiio_open(const char* format, const unsigned char* bytes, std::size_t size,
                          BdptImageHeader* header, char* message, std::size_t message_size);

/// Reads all pixels, width * height * channels values, top row first, as stored: no colour
/// conversion. Integers are scaled to [0, 1]. Returns 0 on failure.
int bdpt_oiio_read_floats(BdptImage* image, float* pixels, char* message, std::size_t message_size);

void bdpt_oiio_close(BdptImage* image);
}
