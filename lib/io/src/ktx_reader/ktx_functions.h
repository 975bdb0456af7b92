#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace bdpt::ktx {

struct Texture;

/// The start of the table of functions that each texture points to (ktxTexture_vtbl).
struct TextureFunctions {
    void (*Destroy)(Texture* texture);
    int (*GetImageOffset)(Texture* texture, std::uint32_t level, std::uint32_t layer,
                          std::uint32_t face, std::size_t* offset);
};

/// The start of a texture of libktx (ktxTexture), which macros of its header read.
struct Texture {
    int class_id;
    TextureFunctions* functions;
};

/// The used part of the C interface of libktx 4, by the names of its documentation. Errors and
/// formats are plain numbers.
struct KtxFunctions {
    int (*ktxTexture2_CreateFromMemory)(const std::uint8_t* bytes, std::size_t size,
                                        std::uint32_t flags, Texture** texture);
    bool (*ktxTexture2_NeedsTranscoding)(Texture* texture);
    int (*ktxTexture2_TranscodeBasis)(Texture* texture, int format, std::uint32_t flags);
    std::uint8_t* (*ktxTexture_GetData)(Texture* texture);
    std::size_t (*ktxTexture_GetDataSize)(Texture* texture);
    const char* (*ktxErrorString)(int error);

    static constexpr std::uint32_t create_load_image_data = 1;
    static constexpr int format_rgba32 = 13;
    static constexpr int success = 0;
    static constexpr int out_of_memory = 13;
};

/// Opens the library, a file or a folder with libktx.so.4 or libktx.so, and resolves its functions;
/// an empty name: the library that the system finds. Throws `Error` (unsupported).
[[nodiscard]] KtxFunctions open_ktx(const std::string& library);

}  // namespace bdpt::ktx
