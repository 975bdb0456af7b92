#include <bdpt/eval/bench_report.h>
#include <bdpt/eval/page.h>
#include <bdpt/io/display.h>
#include <bdpt/io/read_image.h>
#include <bdpt/options/option_fields.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/bench_parts.h"
#include "report/json_values.h"
#include "report/page_source.h"

namespace bdpt::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Encoding of logarithms of variances in a byte: 0 for zero, then 2^-24 to 2^8 in eighths of an
/// octave.
constexpr double variance_octaves_below = 24.0;
constexpr double variance_steps = 8.0;

/// Reads the images of an integrator at equal time, one per seed of its runs.
std::vector<Image> read_images(const SceneResult& scene, IntegratorKind kind,
                               const fs::path& folder)
{
    std::vector<Image> result;
    for (const BenchRun& run : scene.runs) {
        if (run.integrator == kind) {
            result.push_back(io::read_image(image_file(folder, scene.name, kind, run.seed)).image);
        }
    }
    return result;
}

/// Returns the variance between images over r^2 + e: mean of the channels, as bytes of logarithms.
std::vector<std::uint8_t> variance_map(const std::vector<Image>& images, const Image& reference,
                                       double epsilon)
{
    const auto count = static_cast<double>(images.size());
    std::vector<std::uint8_t> result;
    for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
        double relative = 0.0;
        for (int c = 0; c < 3; ++c) {
            double sum = 0.0;
            double squares = 0.0;
            for (const Image& image : images) {
                const double value = static_cast<double>(image.pixels[i][c]);
                sum += value;
                squares += value * value;
            }
            const double r = static_cast<double>(reference.pixels[i][c]);
            relative += std::max(squares - sum * sum / count, 0.0) / (count - 1.0) /
                        (r * r + epsilon) / 3.0;
        }
        const double steps =
            relative > 0.0 ? variance_steps * (std::log2(relative) + variance_octaves_below) + 1.0
                           : 0.0;
        result.push_back(static_cast<std::uint8_t>(std::clamp(steps + 0.5, 0.0, 255.0)));
    }
    return result;
}

ordered_json image_list_json(const SceneResult& scene, const fs::path& folder,
                             const Image& reference, double scale)
{
    const double epsilon = bench_scale(reference).squared_epsilon;
    ordered_json images = ordered_json::object();
    ordered_json variances = ordered_json::object();
    for (const BenchGoals& goals : scene.goals) {
        const std::vector<Image> all = read_images(scene, goals.integrator, folder);
        if (all.empty()) {
            continue;
        }
        const std::string name(to_name(goals.integrator));
        images[name] = packed_image(all.front(), scale);
        if (all.size() > 1) {
            variances[name] = packed_bytes(variance_map(all, reference, epsilon));
        }
    }
    images["reference"] = packed_image(reference, scale);
    return {{"scale", scale},
            {"exposure", io::automatic_exposure(reference)},
            {"epsilon", epsilon},
            {"images", std::move(images)},
            {"variance", std::move(variances)}};
}

}  // namespace

std::string bench_page(const BenchRecord& record, const fs::path& folder)
{
    ordered_json data = head_json(record);
    data["heat"] = heat_text();
    data["scenes"] = ordered_json::array();
    for (const SceneResult& scene : record.scenes) {
        ordered_json json = scene_json(scene, record.options.seconds);
        const Image reference = io::read_image(scene.reference_file).image;
        json["pictures"] = image_list_json(scene, folder, reference, page_scale(scene.light_scale));
        std::optional<ordered_json> strategies =
            read_json(BenchFiles(folder, scene.name).strategies());
        json["strategies"] = strategies ? std::move(*strategies) : ordered_json();
        data["scenes"].push_back(std::move(json));
    }
    const std::string text =
        script_safe(data.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
    return fill_page(page_template(),
                     {{"style", page_style()}, {"data", text}, {"script", page_script()}});
}

}  // namespace bdpt::eval
