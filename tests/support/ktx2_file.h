#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::test {

/// A KTX2 file to be written, 2D and valid unless its fields say otherwise [KTX 2.0].
struct Ktx2File {
    struct Level {
        std::string bytes;
        std::uint64_t unpacked = 0;  ///< as stated in the file [bytes]
    };

    std::uint32_t format = 0;  ///< VkFormat
    std::uint32_t width = 8;
    std::uint32_t height = 4;
    std::uint32_t depth = 0;
    std::uint32_t layers = 0;
    std::uint32_t faces = 1;
    std::uint32_t level_count = 1;
    std::uint32_t supercompression = 0;
    std::uint8_t model = 166;   ///< UASTC
    std::uint8_t transfer = 2;  ///< sRGB
    std::uint8_t flags = 0;
    std::vector<std::uint8_t> channels{0};
    std::vector<std::pair<std::string, std::string>> metadata{};
    std::string global_data{};
    std::vector<Level> levels{{std::string(32, 'u'), 32}};

    /// Returns two blocks of UASTC, RGB or RGBA.
    [[nodiscard]] static Ktx2File uastc(bool alpha = false)
    {
        Ktx2File file;
        file.channels = {static_cast<std::uint8_t>(alpha ? 3 : 0)};
        return file;
    }
    /// Returns ETC1S with BasisLZ, RGB or RGBA.
    [[nodiscard]] static Ktx2File etc1s(bool alpha = false)
    {
        Ktx2File file;
        file.model = 163;
        file.supercompression = 1;
        file.channels = alpha ? std::vector<std::uint8_t>{0, 15} : std::vector<std::uint8_t>{0};
        file.global_data = std::string(40, 'g');
        file.levels = {{"etc", 0}};
        return file;
    }
    /// Returns VK_FORMAT_R8G8B8_UNORM of 2 x 1 pixels.
    [[nodiscard]] static Ktx2File plain()
    {
        Ktx2File file;
        file.format = 23;
        file.model = 1;
        file.transfer = 1;
        file.width = 2;
        file.height = 1;
        file.channels = {0, 1, 2};
        file.levels = {{"\x01\x02\x03\x04\x05\x06", 6}};
        return file;
    }

    [[nodiscard]] std::string bytes() const
    {
        const std::string descriptor = descriptor_bytes();
        std::string pairs;
        for (const auto& [key, value] : metadata) {
            const std::string pair = key + '\0' + value + '\0';
            pairs += number(pair.size(), 4) + pair;
            pairs.resize((pairs.size() + 3) / 4 * 4);
        }
        const std::size_t index_end = 80 + 24 * levels.size();
        const std::size_t pairs_start = index_end + descriptor.size();
        const std::size_t global_start = (pairs_start + pairs.size() + 7) / 8 * 8;
        std::string result("\xabKTX 20\xbb\r\n\x1a\n", 12);
        for (const std::uint32_t value :
             {format, 1U, width, height, depth, layers, faces, level_count, supercompression}) {
            result += number(value, 4);
        }
        result += number(index_end, 4) + number(descriptor.size(), 4);
        result += number(pairs.empty() ? 0 : pairs_start, 4) + number(pairs.size(), 4);
        result += number(global_data.empty() ? 0 : global_start, 8) + number(global_data.size(), 8);
        std::size_t start = (global_start + global_data.size() + 15) / 16 * 16;
        const std::size_t first_level = start;
        for (const Level& level : levels) {
            result += number(start, 8) + number(level.bytes.size(), 8) + number(level.unpacked, 8);
            start += level.bytes.size();
        }
        result += descriptor + pairs;
        result.resize(global_start);
        result += global_data;
        result.resize(first_level);
        for (const Level& level : levels) {
            result += level.bytes;
        }
        return result;
    }

    /// Returns `value` in `count` bytes, little-endian.
    [[nodiscard]] static std::string number(std::uint64_t value, std::size_t count)
    {
        std::string result;
        for (std::size_t i = 0; i < count; ++i) {
            result += static_cast<char>(value >> (8 * i) & 255U);
        }
        return result;
    }
    /// Returns `bytes` with the `count` bytes at `offset` replaced by `value`.
    [[nodiscard]] static std::string patched(std::string bytes, std::size_t offset,
                                             std::uint64_t value, std::size_t count = 4)
    {
        return bytes.replace(offset, count, number(value, count));
    }

private:
    [[nodiscard]] std::string descriptor_bytes() const
    {
        const std::size_t size = 24 + 16 * channels.size();
        std::string result = number(size + 4, 4) + number(0, 4) + number(2, 2) + number(size, 2);
        for (const std::uint8_t value : {model, std::uint8_t{1}, transfer, flags}) {
            result += static_cast<char>(value);
        }
        const bool is_plain = format != 0;
        const std::size_t block_bytes = is_plain ? channels.size() : model == 163 ? 8 : 16;
        result += number(is_plain ? 0 : 0x0303, 4) + number(block_bytes, 8);
        const std::size_t bits = is_plain ? 8 : 8 * block_bytes;
        for (std::size_t i = 0; i < channels.size(); ++i) {
            result += number(i * bits, 2) + number(bits - 1, 1) + static_cast<char>(channels[i]);
            result += number(0, 8) + number(is_plain ? 255 : UINT32_MAX, 4);
        }
        return result;
    }
};

}  // namespace bdpt::test
