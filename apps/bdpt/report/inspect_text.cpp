#include "report/inspect_text.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "report/values.h"

namespace bdpt::app {
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

}  // namespace bdpt::app
