#include "view/server/page.h"

#include <bdpt/eval/page.h>
#include <bdpt/version.h>

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

namespace bdpt::app {

std::string view_page()
{
    const nlohmann::ordered_json data{{"heat", eval::heat_text()}, {"version", BDPT_VERSION}};
    const std::string text = eval::script_safe(data.dump());
    return eval::fill_page(page_template(),
                           {{"style", page_style()}, {"data", text}, {"script", page_script()}});
}

namespace {

/// Rounds to the nearest half, ties to even. `value` is not negative.
std::uint16_t to_half(float value)
{
    constexpr float greatest = 65504.0f;
    constexpr float min_normal = 6.103515625e-5f;   // 2^-14
    constexpr float subnormal_steps = 16777216.0f;  // 2^24
    if (!(value > 0.0f)) {
        return 0;
    }
    if (value >= greatest) {
        return 0x7bff;
    }
    if (value < min_normal) {
        return static_cast<std::uint16_t>(std::nearbyint(value * subnormal_steps));
    }
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t rounded = bits + 0xfffU + ((bits >> 13U) & 1U);
    constexpr std::uint32_t rebias = (127U - 15U) << 10U;
    return static_cast<std::uint16_t>((rounded >> 13U) - rebias);
}

}  // namespace

FrameHeader frame_header(const Frame& frame, ClientId client)
{
    constexpr std::uint32_t version = 2;
    const auto seen = frame.sequences.find(client);
    const std::array<std::uint32_t, frame_header_bytes / 4> numbers{
        version,          frame.slot,
        frame.generation, seen != frame.sequences.end() ? seen->second : 0,
        frame.grid_width, frame.grid_height,
        frame.x,          frame.y,
        frame.width,      frame.height,
        frame.samples,    frame.channels};
    FrameHeader bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        bytes[i] = static_cast<std::uint8_t>(numbers[i / 4] >> (8 * (i % 4)));
    }
    return bytes;
}

std::vector<std::uint8_t> half_pixels(const Image& image, const Cover& cover)
{
    std::vector<std::uint8_t> bytes;
    bytes.reserve(image.pixels.size() * (cover.alpha.empty() ? 6 : 10));
    const auto add = [&bytes](float value) {
        const std::uint16_t half = to_half(value);
        bytes.push_back(static_cast<std::uint8_t>(half));
        bytes.push_back(static_cast<std::uint8_t>(half >> 8U));
    };
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            add(image.pixels[i][channel]);
        }
        if (!cover.alpha.empty()) {
            add(cover.shadow.empty() ? cover.alpha[i] : cover.alpha[i] - cover.shadow[i]);
            add(1.0f - cover.alpha[i]);
        }
    }
    return bytes;
}

}  // namespace bdpt::app
