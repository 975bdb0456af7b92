#include <bdpt/eval/drawing.h>

#include <bdpt/io/display.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "metrics/metric_parts.h"

namespace bdpt::eval {

namespace {

/// Returns a point on a curve through L*a*b* within the sRGB gamut: `t` in [0, 1].
Vec3 lab_on_curve(double t)
{
    constexpr double degrees = std::numbers::pi / 180.0;
    const double lightness = 2.0 + 95.0 * t;
    const double hue = (290.0 + 165.0 * t) * degrees;  // violet, red, orange, yellow
    const double chroma = 68.0 * std::sin(std::numbers::pi * t);
    return Vec3(lightness, chroma * std::cos(hue), chroma * std::sin(hue));
}

}  // namespace

std::vector<Color8> heat_colors()
{
    constexpr std::size_t steps = 8192;
    std::vector<double> lengths{0.0};  // arc length of the curve up to each step
    for (std::size_t i = 1; i <= steps; ++i) {
        const auto at = [](std::size_t k) {
            return lab_on_curve(static_cast<double>(k) / static_cast<double>(steps));
        };
        lengths.push_back(lengths.back() + static_cast<double>(glm::distance(at(i - 1), at(i))));
    }
    constexpr std::size_t colors = 256;
    std::vector<Color8> result;
    std::size_t step = 0;
    for (std::size_t i = 0; i < colors; ++i) {
        const double wanted =
            lengths.back() * static_cast<double>(i) / static_cast<double>(colors - 1);
        while (step < steps && lengths[step] < wanted) {
            ++step;
        }
        const Rgb linear =
            linear_from_lab(lab_on_curve(static_cast<double>(step) / static_cast<double>(steps)));
        result.push_back(
            {io::encode_srgb(linear.r), io::encode_srgb(linear.g), io::encode_srgb(linear.b)});
    }
    return result;
}

namespace {

constexpr Color8 ground{40, 40, 40};

// Layout of the strip below the map, from the top [pixels at zoom 1].
constexpr int bar_top = 4;
constexpr int bar_height = 10;
constexpr int numbers_top = bar_top + bar_height + 3;
constexpr int title_top = numbers_top + glyph_height + 3;
constexpr int strip_height = title_top + glyph_height + 4;
constexpr int min_width = 160;      // room for three numbers side by side
constexpr int width_at_zoom = 640;  // images this wide have glyphs of twice the size, and so on
constexpr int margin = 4;

class Canvas {
public:
    Canvas(int width, int height) : image_{width, height, {}}
    {
        for (int i = 0; i < width * height; ++i) {
            image_.rgb.insert(image_.rgb.end(), ground.begin(), ground.end());
        }
    }

    void set(int x, int y, const Color8& color)
    {
        if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) {
            return;
        }
        const std::size_t index =
            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) +
                 static_cast<std::size_t>(x));
        std::copy(color.begin(), color.end(),
                  image_.rgb.begin() + static_cast<std::ptrdiff_t>(index));
    }

    void write(std::string_view text, const TextPlace& place)
    {
        image_ = with_text(std::move(image_), text, place);
    }

    [[nodiscard]] io::DisplayImage take() { return std::move(image_); }

private:
    io::DisplayImage image_;
};

std::string number_text(double value)
{
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

int text_width(std::string_view text, int zoom)
{
    return static_cast<int>(text.size()) * glyph_advance * zoom;
}

void draw_bar(Canvas& canvas, const std::vector<Color8>& colors, int width, int top, int zoom)
{
    const int left = margin * zoom;
    const int length = width - 2 * left;
    for (int x = 0; x < length; ++x) {
        const auto index =
            static_cast<std::size_t>(x) * colors.size() / static_cast<std::size_t>(length);
        for (int y = bar_top * zoom; y < (bar_top + bar_height) * zoom; ++y) {
            canvas.set(left + x, top + y, colors[index]);
        }
    }
}

void draw_numbers(Canvas& canvas, double scale, int width, int top, int zoom)
{
    const std::string half = number_text(0.5 * scale);
    const std::string full = number_text(scale);
    const int y = top + numbers_top * zoom;
    canvas.write("0", {.x = margin * zoom, .y = y, .dot = zoom});
    canvas.write(half, {.x = (width - text_width(half, zoom)) / 2, .y = y, .dot = zoom});
    canvas.write(full, {.x = width - margin * zoom - text_width(full, zoom), .y = y, .dot = zoom});
}

}  // namespace

io::DisplayImage false_color(const ErrorMap& map, const FalseColorOptions& options)
{
    const std::vector<Color8> colors = heat_colors();
    const double last = static_cast<double>(colors.size() - 1);
    const int width = std::max(map.width, min_width);
    const int zoom = 1 + width / width_at_zoom;
    Canvas canvas(width, map.height + strip_height * zoom);
    for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
            const double error = map.at(x, y);  // NaN gets the first colour
            const double part = error > 0.0 ? std::min(error / options.scale, 1.0) : 0.0;
            canvas.set(x, y, colors[static_cast<std::size_t>(std::lround(part * last))]);
        }
    }
    draw_bar(canvas, colors, width, map.height, zoom);
    draw_numbers(canvas, options.scale, width, map.height, zoom);
    canvas.write(options.title,
                 {.x = margin * zoom, .y = map.height + title_top * zoom, .dot = zoom});
    return canvas.take();
}

}  // namespace bdpt::eval
