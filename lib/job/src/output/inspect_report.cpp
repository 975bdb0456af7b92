#include "output/render_report.h"

#include <bdpt/eval/drawing.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <numbers>

#include "output/image_files.h"
#include "output/values.h"

namespace bdpt::job {
namespace {

using nlohmann::ordered_json;

const char* kind_text(const InspectedVertex& vertex)
{
    switch (vertex.kind) {
        case InspectedKind::lens:
            return "lens";
        case InspectedKind::light:
            return "light";
        case InspectedKind::surface:
            return vertex.is_light ? "surface, light" : "surface";
        case InspectedKind::medium:
            return "medium";
        case InspectedKind::infinite:
            return "infinite";
    }
    return "";
}

/// Returns how the walk continued, and whether the vertex is connectible.
const char* scattering_text(const InspectedVertex& vertex)
{
    if (vertex.kind != InspectedKind::surface) {
        return "";
    }
    return !vertex.connectible ? "delta" : vertex.scattered_delta ? "by a delta lobe" : "";
}

std::string color_text(const Rgb& color)
{
    return fmt::format("{:.4g} {:.4g} {:.4g}", color.r, color.g, color.b);
}

/// Returns what to add to the position of a vertex; nothing if it is a direction.
DVec3 shift_of_vertex(const InspectedVertex& vertex, const DVec3& origin)
{
    return vertex.kind == InspectedKind::infinite ? DVec3(0.0) : origin;
}

std::string path_text(const char* title, const std::vector<InspectedVertex>& path,
                      const DVec3& origin)
{
    std::string text = fmt::format("\n{}\n{:>4} {:<15} {:<28} {:<28} {:>10}  {}\n", title, "", "on",
                                   "position [m]", "throughput", "pdf", "scatters");
    for (std::size_t i = 0; i < path.size(); ++i) {
        const InspectedVertex& vertex = path[i];
        text += fmt::format("{:>4} {:<15} {:<28} {:<28} {:>10.4g}  {}\n", i, kind_text(vertex),
                            to_text(vertex.position, shift_of_vertex(vertex, origin)),
                            color_text(vertex.beta), vertex.pdf_fwd, scattering_text(vertex));
    }
    return text;
}

std::string shares_text(const InspectedContribution& contribution)
{
    std::string text;
    for (std::size_t s = 0; s < contribution.shares.size(); ++s) {
        if (contribution.shares[s] > 0.0f) {
            text +=
                fmt::format("{}s={} {:.3g}", text.empty() ? "" : ", ", s, contribution.shares[s]);
        }
    }
    return text;
}

double brightness(const InspectedContribution& contribution)
{
    const Rgb value = contribution.weight * contribution.unweighted;
    return static_cast<double>(value.r) + static_cast<double>(value.g) +
           static_cast<double>(value.b);
}

ordered_json path_json(const std::vector<InspectedVertex>& path, const DVec3& origin)
{
    ordered_json result = ordered_json::array();
    for (const InspectedVertex& vertex : path) {
        result.push_back({{"on", kind_text(vertex)},
                          {"position", to_json(vertex.position, shift_of_vertex(vertex, origin))},
                          {"normal", to_json(vertex.normal)},
                          {"throughput", to_json(vertex.beta)},
                          {"emission", to_json(vertex.emission)},
                          {"pdf", vertex.pdf_fwd},
                          {"connectible", vertex.connectible},
                          {"scattered_delta", vertex.scattered_delta}});
    }
    return result;
}

}  // namespace

std::string inspect_text(const InspectedSample& sample, const PixelSample& which,
                         const DVec3& origin)
{
    std::string text =
        fmt::format("pixel {},{}, sample {}: {} nit\nthrough {:.4f},{:.4f}", which.x, which.y,
                    which.index, color_text(sample.value), sample.raster.x, sample.raster.y);
    text += sample.time > 0.0f ? fmt::format(", at {:.4f} of the shutter\n", sample.time) : "\n";
    text += path_text("camera path", sample.camera_path, origin);
    if (!sample.light_path.empty()) {
        text += path_text("light path", sample.light_path, origin);
    }
    constexpr const char* row = "{:<8} {:<30} {:>10}   {:<30} {}\n";  // three numbers take up to 29
    text += "\n" + fmt::format(row, "strategy", "alone [nit]", "weight", "brings [nit]",
                               "shares by balance");
    std::vector<InspectedContribution> sorted = sample.contributions;
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return brightness(a) > brightness(b); });
    for (const InspectedContribution& found : sorted) {
        text += fmt::format(row, fmt::format("s{}t{}", found.strategy.s, found.strategy.t),
                            color_text(found.unweighted), fmt::format("{:.4g}", found.weight),
                            color_text(found.weight * found.unweighted), shares_text(found));
    }
    return text + (sorted.empty() ? "no contributions\n" : "");
}

ordered_json inspect_json(const InspectedSample& sample, const PixelSample& which,
                          const DVec3& origin)
{
    ordered_json contributions = ordered_json::array();
    for (const InspectedContribution& found : sample.contributions) {
        contributions.push_back({{"s", found.strategy.s},
                                 {"t", found.strategy.t},
                                 {"light_path", found.light_path},
                                 {"unweighted", to_json(found.unweighted)},
                                 {"weight", found.weight},
                                 {"shares", found.shares}});
    }
    return {{"pixel", {which.x, which.y}},
            {"sample", which.index},
            {"raster", {sample.raster.x, sample.raster.y}},
            {"time", sample.time},
            {"value", to_json(sample.value)},
            {"camera_path", path_json(sample.camera_path, origin)},
            {"light_path", path_json(sample.light_path, origin)},
            {"contributions", std::move(contributions)}};
}

namespace {

constexpr int columns = 3;
constexpr int border = 4;         // [pixels] around each sphere
constexpr int label_height = 20;  // [pixels] below each sphere
constexpr double decades = 4.0;

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

void paste(io::DisplayImage& sheet, int index, const io::DisplayImage& map, const char* label)
{
    const int left = border + index % columns * (map.width + border);
    const int top = border + index / columns * (map.height + label_height + border);
    const auto row_bytes = 3 * static_cast<std::size_t>(map.width);
    for (int y = 0; y < map.height; ++y) {
        const auto from = static_cast<std::ptrdiff_t>(row_bytes * static_cast<std::size_t>(y));
        const auto to =
            3 * (static_cast<std::size_t>(top + y) * static_cast<std::size_t>(sheet.width) +
                 static_cast<std::size_t>(left));
        std::copy_n(map.rgb.begin() + from, row_bytes,
                    sheet.rgb.begin() + static_cast<std::ptrdiff_t>(to));
    }
    sheet = eval::with_text(std::move(sheet), label,
                            {.x = left, .y = top + map.height + border, .dot = 2});
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

/// Returns the integral of each channel over all directions.
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

}  // namespace

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
    paste(sheet, 0, mapped(maps.incident), "light");
    paste(sheet, 1, mapped(maps.scattering), "bsdf cos");
    paste(sheet, 2, heat(ideal, greatest), "ideal pdf");
    paste(sheet, 3, heat(maps.bsdf_pdf, greatest), "bsdf pdf");
    paste(sheet, 4, heat(maps.light_pdf, greatest), "light pdf");
    paste(sheet, 5, heat(mean, greatest), "mean pdf");
    return sheet;
}

std::vector<Layer> direction_layers(const DirectionMaps& maps)
{
    return {to_layer(maps.incident, "incident"), to_layer(maps.scattering, "scattering"),
            to_layer(maps.bsdf_pdf, "bsdf_pdf"), to_layer(maps.light_pdf, "light_pdf")};
}

}  // namespace bdpt::job
