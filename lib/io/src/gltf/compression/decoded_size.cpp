#include "gltf/compression/decoded_size.h"

#include "file/read_file.h"

#include <fmt/format.h>

namespace bdpt::io {

void DecodedSize::add(const JsonPlace& place, std::uint64_t count, std::uint64_t size,
                      std::uint64_t encoded)
{
    // Small meshes of few different values legitimately have a very high compression ratio.
    constexpr std::uint64_t harmless = std::uint64_t{64} << 20;
    if (size != 0 && count > left() / size) {
        const long double need = static_cast<long double>(count) * static_cast<long double>(size);
        place.fail(fmt::format("{} elements become {}, but the limit for all buffers is {}", count,
                               human_bytes(need),
                               human_bytes(static_cast<long double>(limits_.buffer_bytes))));
    }
    const std::uint64_t bytes = count * size;
    if (bytes > harmless && bytes / limits_.compression_ratio > encoded) {
        place.fail(fmt::format("{} in {} bytes: more than {} times packed",
                               human_bytes(static_cast<long double>(bytes)), encoded,
                               limits_.compression_ratio));
    }
    memory_.spend(place.pointer(), bytes);
    total_ += bytes;
}

}  // namespace bdpt::io
