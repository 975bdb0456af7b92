#include "report/direction_sheet.h"

#include <bdpt/eval/image/heat_map.h>
#include <bdpt/eval/image/pixel_font.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace bdpt::app {
namespace {

constexpr int columns = 3;
constexpr int border = 4;         // [pixels] around each sphere
constexpr int label_height = 20;  // [pixels] below each sphere
constexpr double decades = 4.0;

/// Position of a sphere on the sheet.
struct Cell {
    int x = 0;
    int y = 0;
    Cell(int index, const Image& map)
        : x(border + index % columns * (map.width + border)),
          y(border + index / columns * (map.height + label_height + border))
    {}
};

io::DisplayImage empty_sheet(const Image& map)
{
    io::DisplayImage sheet;
    sheet.width = border + columns * (map.width + border);
    sheet.height = border + 2 * (map.height + label_height + border);
    constexpr std::uint8_t dark = 24;
    sheet.rgb.assign(
        3 * static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height), dark);
    return sheet;
}

void paste(io::DisplayImage& sheet, int index, const io::DisplayImage& map, const char* label,
           const Image& size)
{
    const Cell cell(index, size);
    const auto row_bytes = 3 * static_cast<std::size_t>(map.width);
    for (int y = 0; y < map.height; ++y) {
        const auto from = static_cast<std::ptrdiff_t>(row_bytes * static_cast<std::size_t>(y));
        const auto to =
            3 * (static_cast<std::size_t>(cell.y + y) * static_cast<std::size_t>(sheet.width) +
                 static_cast<std::size_t>(cell.x));
        std::copy_n(map.rgb.begin() + from, row_bytes,
                    sheet.rgb.begin() + static_cast<std::ptrdiff_t>(to));
    }
    sheet = eval::with_text(std::move(sheet), label,
                            {.x = cell.x, .y = cell.y + map.height + border, .dot = 2});
}

/// Returns densities of four decades below `greatest` as colours.
io::DisplayImage heat(const Image& density, double greatest)
{
    static const std::vector<eval::Color8> colors = eval::heat_colors();
    io::DisplayImage result{.width = density.width, .height = density.height, .rgb = {}};
    for (const Rgb& value : density.pixels) {
        const double relative = static_cast<double>(value.g) / greatest;
        const double place = relative > 0.0 ? 1.0 + std::log10(relative) / decades : 0.0;
        const auto last = static_cast<double>(colors.size() - 1);
        const auto& color = colors[static_cast<std::size_t>(std::clamp(place, 0.0, 1.0) * last)];
        result.rgb.insert(result.rgb.end(), color.begin(), color.end());
    }
    return result;
}

double max_value(const Image& density)
{
    float greatest = 0.0f;
    for (const Rgb& value : density.pixels) {
        greatest = std::max(greatest, value.g);
    }
    return static_cast<double>(greatest);
}

/// Returns the density that is proportional to the mean of the channels.
Image ideal_density(const Image& product)
{
    const Rgb whole = sphere_integral(product);
    const float sum = whole.r + whole.g + whole.b;
    Image result = product;
    for (Rgb& value : result.pixels) {
        value = Rgb(sum > 0.0f ? (value.r + value.g + value.b) / sum : 0.0f);
    }
    return result;
}

/// Returns the mean density of one direction by BSDF sampling and `light_samples` by light
/// sampling.
Image mean_density(const DirectionMaps& maps, int light_samples)
{
    const auto n = static_cast<float>(light_samples);
    Image result = maps.bsdf_pdf;
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        result.pixels[i] = (maps.bsdf_pdf.pixels[i] + n * maps.light_pdf.pixels[i]) / (1.0f + n);
    }
    return result;
}

Layer map_layer(const Image& map, const char* name)
{
    Layer layer{
        .name = name, .channels = "RGB", .width = map.width, .height = map.height, .values = {}};
    for (const Rgb& value : map.pixels) {
        layer.values.insert(layer.values.end(), {value.r, value.g, value.b});
    }
    return layer;
}

}  // namespace

Rgb sphere_integral(const Image& map)
{
    const double square = std::numbers::pi / map.height;
    double sums[3]{};
    for (int y = 0; y < map.height; ++y) {
        const double top = std::cos(square * y);
        const double solid_angle = (top - std::cos(square * (y + 1))) * 2.0 * std::numbers::pi /
                                   map.width;  // of one pixel of the row
        for (int x = 0; x < map.width; ++x) {
            const Rgb& value = map.at(x, y);
            sums[0] += static_cast<double>(value.r) * solid_angle;
            sums[1] += static_cast<double>(value.g) * solid_angle;
            sums[2] += static_cast<double>(value.b) * solid_angle;
        }
    }
    return {static_cast<float>(sums[0]), static_cast<float>(sums[1]), static_cast<float>(sums[2])};
}

io::DisplayImage direction_sheet(const DirectionMaps& maps, int light_samples)
{
    const Image ideal = ideal_density(maps.product);
    const Image mean = mean_density(maps, light_samples);
    const double greatest =
        std::max({max_value(ideal), max_value(maps.bsdf_pdf), max_value(maps.light_pdf), 1e-30});
    io::DisplayImage sheet = empty_sheet(ideal);
    const auto mapped = [](const Image& map) {
        return io::tone_map(map, io::automatic_exposure(map));
    };
    paste(sheet, 0, mapped(maps.incident), "light", ideal);
    paste(sheet, 1, mapped(maps.scattering), "bsdf cos", ideal);
    paste(sheet, 2, heat(ideal, greatest), "ideal pdf", ideal);
    paste(sheet, 3, heat(maps.bsdf_pdf, greatest), "bsdf pdf", ideal);
    paste(sheet, 4, heat(maps.light_pdf, greatest), "light pdf", ideal);
    paste(sheet, 5, heat(mean, greatest), "mean pdf", ideal);
    return sheet;
}

std::vector<Layer> direction_layers(const DirectionMaps& maps)
{
    return {map_layer(maps.incident, "incident"), map_layer(maps.scattering, "scattering"),
            map_layer(maps.bsdf_pdf, "bsdf_pdf"), map_layer(maps.light_pdf, "light_pdf")};
}

}  // namespace bdpt::app
