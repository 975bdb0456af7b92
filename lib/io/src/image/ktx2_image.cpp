#include "image/ktx2_image.h"

#include <stdexcept>

namespace bdpt::io {

Ktx2Image::Ktx2Image(ByteView bytes, Ktx2Decoder* decoder)
    : bytes_(bytes), decoder_(decoder), header_(read_ktx2_header(bytes))
{
    if (decoder == nullptr) {
        throw std::runtime_error("KTX2 images are read as textures of materials only");
    }
    if (const std::string* const obstacle = decoder->obstacle()) {
        throw std::runtime_error(*obstacle);
    }
}

void Ktx2Image::read(std::uint8_t* values)
{
    decoder_->decode(bytes_, header_, values);
}

}  // namespace bdpt::io
