#include "report/stats_file.h"

#include <bdpt/io/output_file.h>
#include <bdpt/noise.h>
#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

ordered_json rays_json(const RayCounts& rays, double seconds)
{
    ordered_json result{{"camera", rays.camera},
                        {"light", rays.light},
                        {"shadow", rays.shadow},
                        {"aov", rays.aov},
                        {"total", rays.total()}};
    result["per_second"] =
        seconds > 0.0 ? ordered_json(static_cast<double>(rays.total()) / seconds) : ordered_json();
    return result;
}

ordered_json defects_json(const FilmDefects& defects)
{
    ordered_json result{{"invalid", defects.invalid}, {"saturated", defects.saturated}};
    result["first_invalid"] = nullptr;
    if (const auto& place = defects.first_invalid) {
        result["first_invalid"] = {
            {"x", place->x}, {"y", place->y}, {"sample", place->sample_index}};
    }
    return result;
}

ordered_json clamp_json(const Film& film)
{
    if (film.layout().clamp == std::numeric_limits<float>::infinity()) {
        return nullptr;
    }
    const ClampLoss loss = film.clamp_loss();
    return {{"limit", film.layout().clamp},
            {"contributions", loss.contributions},
            {"radiance_taken", {loss.radiance.r, loss.radiance.g, loss.radiance.b}}};
}

}  // namespace

ordered_json noise_json(double noise)
{
    return std::isfinite(noise) ? ordered_json(noise) : ordered_json();
}

ordered_json stats_json(const RenderResult& result, const TimeSplit& time)
{
    const RenderStats& stats = result.stats;
    ordered_json json{{"samples", result.film.sample_count()},
                      {"seconds",
                       {{"load", time.load},
                        {"build", time.build},
                        {"choose", time.choose},
                        {"render", time.render},
                        {"write", time.write}}},
                      {"paths", {{"camera", stats.paths.camera}, {"light", stats.paths.light}}},
                      {"rays", rays_json(stats.rays, time.render)},
                      {"defects", defects_json(result.film.defects())},
                      {"clamp", clamp_json(result.film)}};
    json["noise"] = noise_json(estimate_noise(result.film));
    return json;
}

void write_stats_file(const fs::path& file, const ordered_json& stats)
{
    const std::string text =
        stats.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
    io::OutputFile output(file);
    output.write(text);
    output.commit();
}

}  // namespace bdpt::app
