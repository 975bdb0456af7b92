#include <bdpt/eval/drawing.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "catch.hpp"
#include "image/glyphs.h"
#include "metrics/metric_parts.h"

namespace bdpt::eval::false_color_test {
namespace {

float decode_srgb(std::uint8_t value)
{
    const float v = static_cast<float>(value) / 255.0f;
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

Vec3 lab_of(const Color8& c)
{
    return lab_from_linear({decode_srgb(c[0]), decode_srgb(c[1]), decode_srgb(c[2])});
}

Color8 at(const io::DisplayImage& image, int x, int y)
{
    const auto i = 3 * static_cast<std::size_t>(y * image.width + x);
    return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

TEST_CASE("heat colours rise in lightness by equal steps")
{
    const std::vector<Color8> colors = heat_colors();
    REQUIRE(colors.size() == 256);
    // Sixteen steps at a time, so that rounding to 8 bits does not matter.
    std::vector<double> steps;
    for (std::size_t i = 0; i + 16 < colors.size(); i += 16) {
        const Vec3 a = lab_of(colors[i]);
        const Vec3 b = lab_of(colors[i + 16]);
        CHECK(b.x > a.x + 2.0f);
        steps.push_back(
            std::sqrt(std::pow(b.x - a.x, 2) + std::pow(b.y - a.y, 2) + std::pow(b.z - a.z, 2)));
    }
    const auto [least, greatest] = std::minmax_element(steps.begin(), steps.end());
    CAPTURE(*least, *greatest);
    CHECK(*greatest < 1.1 * *least);
    CHECK(lab_of(colors.front()).x < 5.0f);
    CHECK(lab_of(colors.back()).x > 95.0f);
}

TEST_CASE("errors have the colours of the bar below them")
{
    const std::vector<Color8> colors = heat_colors();
    const ErrorMap map{4, 2, {0.0, 0.5, 1.0, 2.0, 4.0, -1.0, 1e300, 2.0}};
    const io::DisplayImage image = false_color(map, {.scale = 2.0, .title = "mse"});
    REQUIRE(image.rgb.size() == 3 * static_cast<std::size_t>(image.width * image.height));
    CHECK(at(image, 0, 0) == colors[0]);
    CHECK(at(image, 1, 0) == colors[64]);
    CHECK(at(image, 2, 0) == colors[128]);
    CHECK(at(image, 3, 0) == colors[255]);
    CHECK(at(image, 0, 1) == colors[255]);  // beyond the scale
    CHECK(at(image, 1, 1) == colors[0]);
    CHECK(at(image, 2, 1) == colors[255]);
    // The bar goes from the first to the last colour, through all that fit.
    const int bar_row = 2 + 8;
    CHECK(at(image, 4, bar_row) == colors[0]);
    CHECK(lab_of(at(image, image.width - 5, bar_row)).x > 95.0f);
    for (int x = 5; x < image.width - 4; ++x) {
        CHECK(lab_of(at(image, x, bar_row)).x >= lab_of(at(image, x - 1, bar_row)).x);
    }
}

TEST_CASE("the same error has the same colour in every image of one scale")
{
    const FalseColorOptions options{.scale = 1.0, .title = ""};
    const io::DisplayImage dark = false_color({2, 1, {0.25, 0.0}}, options);
    const io::DisplayImage bright = false_color({2, 1, {0.25, 900.0}}, options);
    CHECK(at(dark, 0, 0) == at(bright, 0, 0));
}

TEST_CASE("numbers stand under the bar, and the title under them")
{
    const ErrorMap map{1, 1, {0.0}};
    const auto ink = [&map](const FalseColorOptions& options, int from_x, int to_x, int from_y,
                            int to_y) {
        const io::DisplayImage image = false_color(map, options);
        int count = 0;
        for (int y = from_y; y < to_y; ++y) {
            for (int x = from_x; x < to_x; ++x) {
                count += at(image, x, 1 + y) == Color8{235, 235, 235} ? 1 : 0;
            }
        }
        return count;
    };
    const auto ink_of = [](std::string_view text) {
        std::ptrdiff_t count = 0;
        for (const char c : text) {
            for (const std::string_view row : glyph(c)) {
                count += std::count(row.begin(), row.end(), '#');
            }
        }
        return count;
    };
    const FalseColorOptions options{.scale = 0.25, .title = "flip_ldr"};
    CHECK(ink(options, 0, 40, 17, 24) == ink_of("0"));
    CHECK(ink(options, 40, 120, 17, 24) == ink_of("0.125"));
    CHECK(ink(options, 120, 160, 17, 24) == ink_of("0.25"));
    CHECK(ink(options, 0, 160, 27, 34) == ink_of("flip_ldr"));
}

TEST_CASE("large images have large letters")
{
    const io::DisplayImage small = false_color({600, 1, std::vector<double>(600)}, {});
    const io::DisplayImage large = false_color({1300, 1, std::vector<double>(1300)}, {});
    CHECK(large.height - 1 == 3 * (small.height - 1));
    CHECK(large.width == 1300);
}

TEST_CASE("all letters that are used have an image of their own")
{
    std::set<std::string> shapes;
    const std::string_view used = "0123456789.+-e_relmsemapepsnrflip_ldr";
    const std::set<char> letters(used.begin(), used.end());
    for (const char c : letters) {
        CAPTURE(c);
        std::string shape;
        for (const std::string_view row : glyph(c)) {
            CHECK(row.size() == glyph_width);
            shape += row;
        }
        CHECK((c == 'n' || shape.find('#') != std::string::npos));
        shapes.insert(shape);
    }
    CHECK(shapes.size() == letters.size());
}

}  // namespace
}  // namespace bdpt::eval::false_color_test
