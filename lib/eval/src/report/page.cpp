#include <bdpt/eval/page.h>

#include <bdpt/error.h>
#include <bdpt/eval/drawing.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace bdpt::eval {

std::string heat_text()
{
    constexpr std::string_view digits = "0123456789abcdef";
    std::string result;
    for (const Color8& color : heat_colors()) {
        for (const std::uint8_t channel : color) {
            result += digits[channel >> 4];
            result += digits[channel & 15];
        }
    }
    return result;
}

std::string script_safe(std::string_view json)
{
    std::string result;
    for (const char c : json) {
        result += c == '<' ? "\\u003c" : std::string(1, c);
    }
    return result;
}

std::string fill_page(std::string_view text,
                      const std::vector<std::pair<std::string_view, std::string_view>>& values)
{
    std::string result;
    while (true) {
        const std::size_t open = text.find("{{");
        const std::size_t close = text.find("}}", open);
        if (close == std::string_view::npos) {
            return result.append(text);
        }
        result.append(text.substr(0, open));
        const std::string_view word = text.substr(open + 2, close - open - 2);
        for (const auto& [name, value] : values) {
            if (name == word) {
                result.append(value);
            }
        }
        text.remove_prefix(close + 2);
    }
}

namespace {

constexpr int mantissa_bits = 9;
constexpr int exponent_bias = 15;
constexpr int max_exponent = 31;
constexpr float max_rgb9e5 = 65408.0f;  // 511 / 512 * 2^16

std::string base64(std::span<const Bytef> bytes)
{
    constexpr const char* digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string result;
    result.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const auto byte = [&](std::size_t k) -> std::uint32_t {
            return i + k < bytes.size() ? bytes[i + k] : 0;
        };
        const std::uint32_t word = byte(0) << 16 | byte(1) << 8 | byte(2);
        result += digits[word >> 18];
        result += digits[word >> 12 & 63];
        result += i + 1 < bytes.size() ? digits[word >> 6 & 63] : '=';
        result += i + 2 < bytes.size() ? digits[word & 63] : '=';
    }
    return result;
}

}  // namespace

std::uint32_t pack_rgb9e5(Rgb rgb)
{
    const auto clamped = [](float value) {
        // NaN is not above 0, so it becomes 0.
        return value > 0.0f ? std::min(value, max_rgb9e5) : 0.0f;
    };
    const Rgb color(clamped(rgb.r), clamped(rgb.g), clamped(rgb.b));
    const float greatest = std::max({color.r, color.g, color.b});
    int exponent = 0;  // greatest < 2^exponent
    if (greatest > 0.0f) {
        std::frexp(greatest, &exponent);
    }
    exponent = std::max(exponent, -exponent_bias);
    const auto mantissa = [&](float value) {
        return static_cast<std::uint32_t>(
            std::floor(std::ldexp(value, mantissa_bits - exponent) + 0.5f));
    };
    if (mantissa(greatest) == 1u << mantissa_bits) {
        ++exponent;  // rounded up to the next power of two
    }
    const auto biased =
        static_cast<std::uint32_t>(std::min(exponent + exponent_bias, max_exponent));
    return mantissa(color.r) | mantissa(color.g) << 9 | mantissa(color.b) << 18 | biased << 27;
}

Rgb unpack_rgb9e5(std::uint32_t packed)
{
    const int exponent = static_cast<int>(packed >> 27) - exponent_bias - mantissa_bits;
    const auto component = [&](unsigned shift) {
        return std::ldexp(static_cast<float>(packed >> shift & 511u), exponent);
    };
    return {component(0), component(9), component(18)};
}

std::string packed_bytes(std::span<const std::uint8_t> bytes)
{
    uLongf size = compressBound(static_cast<uLong>(bytes.size()));
    std::vector<Bytef> compressed(size);
    const int result = compress2(compressed.data(), &size, bytes.data(),
                                 static_cast<uLong>(bytes.size()), Z_BEST_COMPRESSION);
    if (result != Z_OK) {
        throw Error(result == Z_MEM_ERROR ? ErrorCode::out_of_memory : ErrorCode::internal,
                    "cannot compress an image for the report");
    }
    return base64(std::span(compressed).first(size));
}

std::string packed_image(const Image& image, double scale)
{
    const std::size_t count = image.pixels.size();
    std::vector<std::uint8_t> bytes(4 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t packed = pack_rgb9e5(image.pixels[i] * static_cast<float>(scale));
        for (std::size_t plane = 0; plane < 4; ++plane) {
            bytes[plane * count + i] = static_cast<std::uint8_t>(packed >> (8 * plane));
        }
    }
    return packed_bytes(bytes);
}

double page_scale(double mean)
{
    return mean > 0.0 ? std::exp2(-2.0 - std::floor(std::log2(mean) + 0.5)) : 1.0;
}

}  // namespace bdpt::eval
