#include <bdpt/io/display.h>

#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include <algorithm>

namespace bdpt::io {
namespace {

/// Makes a colour finite and non-negative; NaN becomes 0.
Rgb sound(Rgb color)
{
    // Far above the end of any curve; keeps squares finite.
    constexpr float brightest = 1e6f;
    for (int channel = 0; channel < 3; ++channel) {
        color[channel] = color[channel] > 0.0f ? std::min(color[channel], brightest) : 0.0f;
    }
    return color;
}

float largest(Rgb color)
{
    return std::max(color.r, std::max(color.g, color.b));
}

/// Evaluates Narkowicz' fit of the ACES reference transform; reaches 1 at about 7.2.
float film_curve(float x)
{
    return std::min(1.0f, (x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f));
}

/// Evaluates Wrensch's fit of the contrast curve of AgX, from [0, 1].
Rgb agx_curve(Rgb x)
{
    constexpr float coefficients[]{15.5f, -40.14f, 31.96f, -6.868f, 0.4298f, 0.1191f, -0.00232f};
    Rgb sum(0.0f);
    for (const float coefficient : coefficients) {
        sum = sum * x + coefficient;
    }
    return sum;
}

}  // namespace

std::string_view tone_curve_name(ToneCurve curve)
{
    constexpr std::array<std::string_view, all_tone_curves.size()> names{"filmic", "pbr-neutral",
                                                                         "agx", "none"};
    return names[static_cast<std::size_t>(curve)];
}

Rgb filmic(Rgb scene_linear)
{
    // Rate at which colours above 1 fade to white, as film loses them, too.
    constexpr float fade = 0.15f;

    const Rgb color = sound(scene_linear);
    const float peak = largest(color);
    if (peak <= 0.0f) {
        return Rgb(0.0f);
    }
    const float excess = fade * std::max(0.0f, peak - 1.0f);
    const float white = excess / (1.0f + excess);
    const Rgb hue = color / peak;
    return film_curve(peak) * (hue * (1.0f - white) + Rgb(white));
}

Rgb pbr_neutral(Rgb scene_linear)
{
    constexpr float fresnel = 0.04f;  // reflectance of a dielectric of index 1.5
    constexpr float start = 0.8f - fresnel;
    constexpr float room = 1.0f - start;
    constexpr float fade = 0.15f;

    Rgb color = sound(scene_linear);
    // Dark colours lose less than the full offset, as they must not become negative.
    const float least = std::min(color.r, std::min(color.g, color.b));
    color -= least < 2.0f * fresnel ? least - least * least / (4.0f * fresnel) : fresnel;
    const float peak = largest(color);
    if (peak < start) {
        return color;
    }
    const float compressed = 1.0f - room * room / (peak + room - start);
    const float white = 1.0f - 1.0f / (fade * (peak - compressed) + 1.0f);
    return mix(color * (compressed / peak), Rgb(compressed), white);
}

Rgb agx(Rgb scene_linear)
{
    // Columns.
    const Mat3 rec2020_from_rec709(0.6274f, 0.0691f, 0.0164f, 0.3293f, 0.9195f, 0.0880f, 0.0433f,
                                   0.0113f, 0.8956f);
    const Mat3 rec709_from_rec2020(1.6605f, -0.1246f, -0.0182f, -0.5876f, 1.1329f, -0.1006f,
                                   -0.0728f, -0.0083f, 1.1187f);
    // Primaries are moved inwards, so that bright colours fade, and back.
    const Mat3 inset(0.856627153f, 0.137318973f, 0.111898213f, 0.0951212405f, 0.761241991f,
                     0.0767994186f, 0.0482516061f, 0.101439036f, 0.811302368f);
    const Mat3 outset(1.12710058f, -0.141329763f, -0.141329763f, -0.110606643f, 1.15782370f,
                      -0.110606643f, -0.0164939387f, -0.0164939387f, 1.25193641f);
    // The range of the curve [EV].
    constexpr float darkest = -12.47393f;
    constexpr float brightest = 4.026069f;

    const Rgb color = inset * (rec2020_from_rec709 * sound(scene_linear));
    const Rgb stops = log2(max(color, Rgb(1e-10f)));
    const Rgb range = clamp((stops - darkest) / (brightest - darkest), 0.0f, 1.0f);
    // The curve's output is encoded with a power of 2.2.
    const Rgb linear = pow(max(outset * agx_curve(range), Rgb(0.0f)), Rgb(2.2f));
    return clamp(rec709_from_rec2020 * linear, 0.0f, 1.0f);
}

Rgb apply(ToneCurve curve, Rgb scene_linear)
{
    switch (curve) {
        case ToneCurve::filmic:
            return filmic(scene_linear);
        case ToneCurve::pbr_neutral:
            return pbr_neutral(scene_linear);
        case ToneCurve::agx:
            return agx(scene_linear);
        case ToneCurve::none:
            break;
    }
    return min(sound(scene_linear), Rgb(1.0f));
}

}  // namespace bdpt::io
