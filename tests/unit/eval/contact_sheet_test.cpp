#include <bdpt/eval/drawing.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "catch.hpp"

namespace bdpt::eval::contact_sheet_test {
namespace {

constexpr std::array<Strategy, 5> two_rows{
    {{.s = 0, .t = 2}, {.s = 1, .t = 1}, {.s = 0, .t = 3}, {.s = 1, .t = 2}, {.s = 2, .t = 1}}};

io::DisplayImage black(int width, int height)
{
    return {width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(3 * width * height))};
}

int red(const io::DisplayImage& image, int x, int y)
{
    return image.rgb[static_cast<std::size_t>(3 * (y * image.width + x))];
}

/// Pixels of the rectangle that are brighter than the sheet's background.
int bright_pixels(const io::DisplayImage& image, SheetPlace from, SheetSize size)
{
    int count = 0;
    for (int y = from.y; y < from.y + size.height; ++y) {
        for (int x = from.x; x < from.x + size.width; ++x) {
            count += red(image, x, y) > 100 ? 1 : 0;
        }
    }
    return count;
}

TEST_CASE("strategies make a pyramid: a row a length, s from left to right")
{
    const PyramidLayout pinhole(two_rows, {.width = 10, .height = 7});
    CHECK(pinhole.size().width == 30);
    CHECK(pinhole.size().height == 14);
    CHECK(pinhole.place({.s = 0, .t = 2}) == SheetPlace{5, 0});
    CHECK(pinhole.place({.s = 1, .t = 1}) == SheetPlace{15, 0});
    CHECK(pinhole.place({.s = 0, .t = 3}) == SheetPlace{0, 7});
    CHECK(pinhole.place({.s = 1, .t = 2}) == SheetPlace{10, 7});
    CHECK(pinhole.place({.s = 2, .t = 1}) == SheetPlace{20, 7});

    // What is left out leaves a gap, and t = 0 is at the right end.
    constexpr std::array<Strategy, 2> some{{{.s = 4, .t = 0}, {.s = 1, .t = 3}}};
    const PyramidLayout gaps(some, {.width = 10, .height = 7});
    CHECK(gaps.size().width == 40);
    CHECK(gaps.size().height == 7);
    CHECK(gaps.place({.s = 1, .t = 3}) == SheetPlace{0, 0});
    CHECK(gaps.place({.s = 4, .t = 0}) == SheetPlace{30, 0});
}

TEST_CASE("each row has a stop more than the one above")
{
    CHECK(extra_exposure({.s = 0, .t = 2}) == 0.0f);
    CHECK(extra_exposure({.s = 2, .t = 0}) == 0.0f);
    CHECK(extra_exposure({.s = 1, .t = 2}) == 1.0f);
    CHECK(extra_exposure({.s = 3, .t = 3}) == 4.0f);
}

TEST_CASE("images are shrunk to the means of squares")
{
    Image image{5, 3, {}};
    for (int i = 0; i < 15; ++i) {
        image.pixels.emplace_back(static_cast<float>(i), 1.0f, 0.0f);
    }
    const Image half = shrunk(image, 2);
    REQUIRE(half.width == 3);
    REQUIRE(half.height == 2);
    REQUIRE(half.pixels.size() == 6);
    CHECK(half.at(0, 0) == Rgb(3.0f, 1.0f, 0.0f));   // of 0 1 5 6
    CHECK(half.at(2, 0) == Rgb(6.5f, 1.0f, 0.0f));   // of 4 9
    CHECK(half.at(1, 1) == Rgb(12.5f, 1.0f, 0.0f));  // of 12 13
    CHECK(half.at(2, 1) == Rgb(14.0f, 1.0f, 0.0f));
    CHECK(shrunk(image, 1).pixels == image.pixels);
    CHECK(shrunk(image, 9).at(0, 0) == Rgb(7.0f, 1.0f, 0.0f));
}

TEST_CASE("labels have all the letters that they need")
{
    for (const char letter : std::string_view("0123456789stweightedunaop,+r.-_flmbc")) {
        CAPTURE(letter);
        CHECK(has_glyph(letter));
    }
    CHECK_FALSE(has_glyph('X'));
    // All letters look different.
    int letters = 0;
    std::set<std::string> looks;
    for (int code = 33; code < 127; ++code) {
        const char letter = static_cast<char>(code);
        if (has_glyph(letter)) {
            ++letters;
            const auto rgb = with_text(black(6, 7), std::string(1, letter), {}).rgb;
            looks.insert(std::string(rgb.begin(), rgb.end()));
        }
    }
    CHECK(letters == 34);
    CHECK(looks.size() == 34);
}

TEST_CASE("text is drawn where it should be, in dots of any size, and cut off at borders")
{
    // A one: .. # .. / . ## .. / .. # .. and at the end . ### .
    const io::DisplayImage one = with_text(black(20, 20), "1", {.x = 3, .y = 2, .dot = 1});
    CHECK(red(one, 5, 2) == 235);
    CHECK(red(one, 4, 2) == 0);
    CHECK(red(one, 4, 3) == 235);
    CHECK(bright_pixels(one, {4, 8}, {.width = 3, .height = 1}) == 3);
    CHECK(bright_pixels(one, {0, 0}, {.width = 20, .height = 20}) == 10);
    const io::DisplayImage large = with_text(black(40, 20), " 1", {.x = 3, .y = 2, .dot = 2});
    CHECK(bright_pixels(large, {0, 0}, {.width = 40, .height = 20}) == 40);
    CHECK(bright_pixels(large, {3 + 12 + 4, 2}, {.width = 2, .height = 2}) == 4);
    const io::DisplayImage cut = with_text(black(4, 4), "88888", {.x = -3, .y = -2, .dot = 1});
    CHECK(cut.rgb.size() == 48);
    CHECK(bright_pixels(cut, {0, 0}, {.width = 4, .height = 4}) > 0);
}

TEST_CASE("a contact sheet shows all images with label and exposure")
{
    constexpr int side = 64;
    StrategyFilm film({.x0 = 0, .y0 = 0, .x1 = side, .y1 = side}, two_rows);
    film.count_samples(1);
    const auto fill = [&](Strategy strategy, float weighted, float unweighted) {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                film.add(strategy, {static_cast<float>(x), static_cast<float>(y)},
                         {.weighted = Rgb(weighted), .unweighted = Rgb(unweighted)});
            }
        }
    };
    fill({.s = 0, .t = 2}, 0.4f, 0.8f);
    fill({.s = 2, .t = 1}, 0.2f, 0.4f);
    const io::DisplayImage sheet = contact_sheet(film, -1.0f);
    // Cells have a gap of 4, titles and labels are 22 pixels high.
    constexpr int pitch = side + 4;
    constexpr int row = side + 22 + 4;
    constexpr int group = 22 + 4 + 2 * row;
    CHECK(sheet.width == 25 * 2 * glyph_advance + 4);  // the lower title is wider
    CHECK(sheet.height == 2 * group + 4);
    REQUIRE(sheet.rgb.size() == static_cast<std::size_t>(3 * sheet.width * sheet.height));
    const auto center = [&](int index_of_group, int x, int y) {
        return red(sheet, 4 + x + side / 2, 4 + index_of_group * group + 26 + y + 22 + side / 2);
    };
    const auto displayed = [](float radiance) {
        return int{io::encode_srgb(io::filmic(Rgb(radiance)).r)};
    };
    CHECK(center(0, pitch / 2, 0) == displayed(0.2f));
    CHECK(center(0, 3 * pitch / 2, 0) == 0);
    CHECK(center(0, 2 * pitch, row) == displayed(0.2f));
    CHECK(center(0, 0, row) == 0);
    CHECK(center(1, pitch / 2, 0) == displayed(0.4f));
    CHECK(center(1, 2 * pitch, row) == displayed(0.4f));
    // Each cell and each group has its label.
    for (const int index_of_group : {0, 1}) {
        const int top = 4 + index_of_group * group;
        CHECK(bright_pixels(sheet, {0, top}, {.width = sheet.width, .height = 22}) > 500);
        for (const Strategy& strategy : two_rows) {
            const SheetPlace place =
                PyramidLayout(two_rows, {.width = pitch, .height = row}).place(strategy);
            CHECK(bright_pixels(sheet, {4 + place.x, top + 26 + place.y},
                                {.width = side, .height = 22}) > 100);
        }
    }
}

TEST_CASE("large images are shrunk on a contact sheet, small ones have room for their label")
{
    constexpr std::array<Strategy, 1> one{{{.s = 10, .t = 11}}};
    StrategyFilm large({.x0 = 0, .y0 = 0, .x1 = 500, .y1 = 100}, one);
    // A quarter: 125 x 25
    CHECK(contact_sheet(large, 0.0f).height == 2 * (26 + 25 + 22 + 4) + 4);
    StrategyFilm small({.x0 = 0, .y0 = 0, .x1 = 3, .y1 = 2}, one);
    const io::DisplayImage sheet = contact_sheet(small, 0.0f);
    CHECK(sheet.height == 2 * (15 + 2 + 11 + 4) + 4);
    CHECK(sheet.width >= 7 * glyph_advance);
}

}  // namespace
}  // namespace bdpt::eval::contact_sheet_test
