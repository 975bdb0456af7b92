#include "image_fixture.h"

#include <array>
#include <string_view>

namespace bdpt::io {

namespace {

std::string big_endian(std::uint32_t value)
{
    return raw({static_cast<int>(value >> 24), static_cast<int>(value >> 16 & 255u),
                static_cast<int>(value >> 8 & 255u), static_cast<int>(value & 255u)});
}

std::uint32_t crc32(std::string_view bytes)
{
    std::uint32_t crc = ~0u;
    for (const char byte : bytes) {
        crc ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) {
            crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
        }
    }
    return ~crc;
}

/// One stored block [RFC 1950, RFC 1951].
std::string zlib_stored(const std::string& bytes)
{
    std::uint32_t a = 1;
    std::uint32_t b = 0;
    for (const char byte : bytes) {
        a = (a + static_cast<unsigned char>(byte)) % 65521;
        b = (b + a) % 65521;
    }
    const int size = static_cast<int>(bytes.size());
    return raw({0x78, 0x01, 1, size & 255, size >> 8, ~size & 255, ~size >> 8 & 255}) + bytes +
           big_endian(b << 16 | a);
}

std::string from_base64(std::string_view text)
{
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string bytes;
    std::uint32_t word = 0;
    int bits = 0;
    for (const char c : text) {
        if (c == '=') {
            break;
        }
        word = word << 6 | static_cast<std::uint32_t>(digits.find(c));
        bits += 6;
        if (bits >= 8) {
            bits -= 8;
            bytes.push_back(static_cast<char>(word >> bits & 255u));
        }
    }
    return bytes;
}

}  // namespace

std::string raw(const std::vector<int>& values)
{
    std::string bytes;
    for (const int value : values) {
        bytes.push_back(static_cast<char>(value));
    }
    return bytes;
}

std::string png_chunk(const std::string& type, const std::string& data)
{
    const std::string body = type + data;
    return big_endian(static_cast<std::uint32_t>(data.size())) + body + big_endian(crc32(body));
}

std::string png(int width, int height, int depth, int color_type,
                const std::vector<std::string>& rows, const std::string& extra)
{
    std::string pixels;
    for (const std::string& row : rows) {
        pixels += '\0' + row;
    }
    const std::string header = big_endian(static_cast<std::uint32_t>(width)) +
                               big_endian(static_cast<std::uint32_t>(height)) +
                               raw({depth, color_type, 0, 0, 0});
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + extra +
           png_chunk("IDAT", zlib_stored(pixels)) + png_chunk("IEND", "");
}

std::string orange_jpeg()
{
    return from_base64(
        "/9j/4AAQSkZJRgABAQAAAQABAAD/4QEKRXhpZgAASUkqAK4AAABvaWlvdG9vbCAtLWNyZWF0ZSA4eDggMyAtLWZp"
        "bGw6Y29sb3I9MSwwLjUsMCA4eDggLS1xdWFsaXR5IDEwMCAtbyBhLmpwZwBPcGVuSW1hZ2VJTyAyLjQuNy4xIDog"
        "b2lpb3Rvb2wgLS1jcmVhdGUgOHg4IDMgLS1maWxsOmNvbG9yPTEsMC41LDAgOHg4IC0tcXVhbGl0eSAxMDAgLW8g"
        "YS5qcGcAAgAxAQIAXgAAAFAAAABphwQAAQAAAMwAAAAAAAAABAAAkAcABAAAADAyMzABkQcABAAAAAECAwATkgIA"
        "SAAAAAgAAAAAoAcABAAAADAxMDAAAAAA/+0AflBob3Rvc2hvcCAzLjAAOEJJTQQEAAAAAABiHAJBAF1PcGVuSW1h"
        "Z2VJTyAyLjQuNy4xIDogb2lpb3Rvb2wgLS1jcmVhdGUgOHg4IDMgLS1maWxsOmNvbG9yPTEsMC41LDAgOHg4IC0t"
        "cXVhbGl0eSAxMDAgLW8gYS5qcGf/2wBDAAEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEB"
        "AQEBAQEBAQEBAQEBAQEBAQEBAQEBAQH/2wBDAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEB"
        "AQEBAQEBAQEBAQEBAQEBAQEBAQEBAQEBAQH/wAARCAAIAAgDASIAAhEBAxEB/8QAHwAAAQUBAQEBAQEAAAAAAAAA"
        "AAECAwQFBgcICQoL/8QAtRAAAgEDAwIEAwUFBAQAAAF9AQIDAAQRBRIhMUEGE1FhByJxFDKBkaEII0KxwRVS0fAk"
        "M2JyggkKFhcYGRolJicoKSo0NTY3ODk6Q0RFRkdISUpTVFVWV1hZWmNkZWZnaGlqc3R1dnd4eXqDhIWGh4iJipKT"
        "lJWWl5iZmqKjpKWmp6ipqrKztLW2t7i5usLDxMXGx8jJytLT1NXW19jZ2uHi4+Tl5ufo6erx8vP09fb3+Pn6/8QA"
        "HwEAAwEBAQEBAQEBAQAAAAAAAAECAwQFBgcICQoL/8QAtREAAgECBAQDBAcFBAQAAQJ3AAECAxEEBSExBhJBUQdh"
        "cRMiMoEIFEKRobHBCSMzUvAVYnLRChYkNOEl8RcYGRomJygpKjU2Nzg5OkNERUZHSElKU1RVVldYWVpjZGVmZ2hp"
        "anN0dXZ3eHl6goOEhYaHiImKkpOUlZaXmJmaoqOkpaanqKmqsrO0tba3uLm6wsPExcbHyMnK0tPU1dbX2Nna4uPk"
        "5ebn6Onq8vP09fb3+Pn6/9oADAMBAAIRAxEAPwD64ooor/lXP+lA/9k=");
}

std::string red_webp()
{
    return from_base64(
        "UklGRkQAAABXRUJQVlA4IDgAAABQAgCdASoCAAIAAAAAJaACdLoB+AH6AfwAB5AA/v9vVv/8sPx/Unn/yxD//xPT"
        "m8RU8r/+JkAAAA==");
}

std::string half_webp()
{
    return from_base64("UklGRh4AAABXRUJQVlA4TBEAAAAvAAAAEAdQsiJXpoCBiOh/AAA=");
}

void add_grey_textures(GltfFixture& fixture)
{
    for (int i = 0; i < 6; ++i) {
        fixture.json["images"].push_back(
            {{"uri", "data:image/png;base64," + base64(png(1, 1, 8, 0, {raw({10 * i})}))}});
        fixture.json["textures"].push_back({{"source", i}});
    }
}

int grey_image(const LoadedScene& loaded, const std::optional<TextureRef>& ref)
{
    return ref ? loaded.scene.images.at(static_cast<std::size_t>(ref->image)).bytes.at(0) / 10 : -1;
}

}  // namespace bdpt::io
