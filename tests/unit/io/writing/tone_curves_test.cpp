#include <bdpt/io/display.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "catch.hpp"

namespace bdpt::io::tone_curves_test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

void check_close(Rgb actual, Rgb expected)
{
    CAPTURE(actual.r, actual.g, actual.b);
    for (int channel = 0; channel < 3; ++channel) {
        CHECK(actual[channel] == Approx(expected[channel]).margin(2e-5));
    }
}

/// The specification's steps for a grey value, which stays grey.
double neutral_grey(double x)
{
    const double reflected = x < 0.08 ? x - 6.25 * x * x : 0.04;
    const double diffuse = x - reflected;
    return diffuse < 0.76 ? diffuse : 1.0 - 0.0576 / (diffuse - 0.52);
}

TEST_CASE("PBR Neutral brings base colours back that are lit by 1")
{
    // What a dielectric of that colour leaves: the colour and 0.04 of the light.
    for (const Rgb base : {Rgb(0.64f, 0.24f, 0.08f), Rgb(0.04f), Rgb(0.75f, 0.1f, 0.05f)}) {
        check_close(pbr_neutral(base + Rgb(0.04f)), base);
    }
    // Less than that is left of darker ones: 0.02 - 0.02 + 6.25 * 0.02^2.
    check_close(pbr_neutral({0.52f, 0.22f, 0.02f}), {0.5025f, 0.2025f, 0.0025f});
}

TEST_CASE("PBR Neutral compresses what is bright as the specification says")
{
    for (double x = 0.0; x < 20.0; x += 0.0137) {
        const auto grey = static_cast<float>(neutral_grey(x));
        CAPTURE(x);
        check_close(pbr_neutral(Rgb(static_cast<float>(x))), Rgb(grey));
    }
    // Worked out by hand: peak 1.96 goes to 1 - 0.0576 / 1.44 = 0.96, and 0.15 / 1.15 of it is
    // white.
    const float kept = 1.0f / 1.15f;
    check_close(pbr_neutral({2.0f, 0.53f, 0.08f}),
                {0.96f, 0.96f * (0.49f / 1.96f * kept + 1.0f - kept),
                 0.96f * (0.04f / 1.96f * kept + 1.0f - kept)});
}

TEST_CASE("AgX follows Minimal AgX on Rec. 2020 primaries")
{
    // By the published matrices and polynomial in double precision.
    const std::array<std::pair<Rgb, Rgb>, 7> pairs{
        {{Rgb(0.0f), Rgb(0.0f)},
         {Rgb(0.18f), {0.21454863f, 0.21450236f, 0.21449917f}},
         {Rgb(1.0f), {0.59022944f, 0.59013612f, 0.59010234f}},
         {{1.0f, 0.1f, 0.1f}, {0.67484992f, 0.19979683f, 0.17274894f}},
         {{0.05f, 0.2f, 0.8f}, {0.11594853f, 0.28406550f, 0.59132153f}},
         {{2.0f, 4.0f, 1.0f}, {0.77361188f, 0.85331014f, 0.65335706f}},
         {{20.0f, 0.0f, 0.0f}, {1.0f, 0.76322595f, 0.66224858f}}}};
    for (const auto& [color, expected] : pairs) {
        CAPTURE(color.r, color.g, color.b);
        check_close(agx(color), expected);
    }
    // The end of the range is white on a screen of 8 bits.
    CHECK(encode_srgb(agx(Rgb(16.3f)).g) == 255);
}

TEST_CASE("curves go from black to white, and more light is never darker")
{
    for (const ToneCurve curve : all_tone_curves) {
        CAPTURE(tone_curve_name(curve));
        CHECK(apply(curve, Rgb(0.0f)) == Rgb(0.0f));
        CHECK(encode_srgb(apply(curve, Rgb(1e4f)).g) >= 254);
        Rgb previous(0.0f);
        for (float stop = -16.0f; stop < 20.0f; stop += 1.0f / 64.0f) {
            const Rgb value = apply(curve, Rgb(std::exp2(stop)));
            CAPTURE(stop);
            for (int channel = 0; channel < 3; ++channel) {
                CHECK(value[channel] >= previous[channel] - 1e-6f);
                // A jump of more than this in 1/64 stop would be a step in the image.
                CHECK(value[channel] - previous[channel] < 0.012f);
                CHECK(value[channel] <= 1.0f);
            }
            previous = value;
        }
    }
}

TEST_CASE("without a curve values are kept or clamped")
{
    CHECK(apply(ToneCurve::none, {0.25f, 1.0f, 3.0f}) == Rgb(0.25f, 1.0f, 1.0f));
}

TEST_CASE("curves take what is no colour as black, and infinity as white")
{
    for (const ToneCurve curve : all_tone_curves) {
        CAPTURE(tone_curve_name(curve));
        CHECK(apply(curve, {nan, -1.0f, -infinity}) == Rgb(0.0f));
        CHECK(apply(curve, Rgb(infinity)) == apply(curve, Rgb(1e6f)));
        const Rgb red = apply(curve, {infinity, nan, 0.0f});
        CHECK(red.r > 0.99f);
        CHECK((red.g >= 0.0f && red.g <= 1.0f));
    }
}

TEST_CASE("each curve has its name, and tone mapping uses it")
{
    const Image image{1, 1, {Rgb(2.0f, 0.3f, 0.1f)}};
    CHECK(tone_curve_name(ToneCurve::filmic) == "filmic");
    CHECK(tone_curve_name(ToneCurve::pbr_neutral) == "pbr-neutral");
    CHECK(tone_curve_name(ToneCurve::agx) == "agx");
    CHECK(tone_curve_name(ToneCurve::none) == "none");
    const std::array<Rgb, 4> expected{filmic(0.5f * image.pixels[0]),
                                      pbr_neutral(0.5f * image.pixels[0]),
                                      agx(0.5f * image.pixels[0]), Rgb(1.0f, 0.15f, 0.05f)};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const DisplayImage shown = tone_map(image, -1.0f, all_tone_curves[i]);
        CAPTURE(i);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            CHECK(shown.rgb[channel] == encode_srgb(expected[i][static_cast<int>(channel)]));
        }
    }
}

}  // namespace
}  // namespace bdpt::io::tone_curves_test
