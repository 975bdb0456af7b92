#include "report/film_report.h"

#include <fmt/core.h>

#include <algorithm>

namespace bdpt::app {

void warn_of_defects(Console& console, const FilmDefects& defects)
{
    if (defects.invalid > 0) {
        const FilmDefects::Place place = defects.first_invalid.value_or(FilmDefects::Place{});
        console.warning(
            fmt::format("{} contributions were NaN, infinite or negative and were dropped; the "
                        "first at pixel ({}, {}), sample {}",
                        defects.invalid, place.x, place.y, place.sample_index));
    }
    if (defects.saturated > 0) {
        console.warning(fmt::format("{} contributions were above {:.3g} nit and were clamped to it",
                                    defects.saturated, ExactSum::max_value));
    }
}

bool is_black(const Image& image, const std::vector<Layer>& layers)
{
    const auto alpha = std::find_if(layers.begin(), layers.end(),
                                    [](const Layer& layer) { return layer.name.empty(); });
    const bool is_empty =
        alpha != layers.end() && std::all_of(alpha->values.begin(), alpha->values.end(),
                                             [](float value) { return value == 0.0f; });
    return !is_empty && std::all_of(image.pixels.begin(), image.pixels.end(),
                                    [](const Rgb& pixel) { return pixel == Rgb(0.0f); });
}

std::string black_image_text(const std::string& scene)
{
    return scene + ": the image is black: none of the light reaches what the camera sees (--env " +
           "default gives a closed room without lights a lamp)";
}

void report_clamp(Console& console, const Film& film, const Image& image)
{
    const ClampLoss loss = film.clamp_loss();
    if (loss.contributions == 0) {
        return;
    }
    const auto sum = [](Rgb c) { return static_cast<double>(c.r + c.g + c.b); };
    double left = 0.0;
    for (const Rgb& pixel : image.pixels) {
        left += sum(pixel) / static_cast<double>(image.pixels.size());
    }
    const double taken = sum(loss.radiance);
    console.note(
        {"clamped",
         fmt::format("clamping at {:g} nit removed {:.2f} % of the light: {} contributions",
                     film.layout().clamp, 100.0 * taken / (left + taken), loss.contributions)});
}

}  // namespace bdpt::app
