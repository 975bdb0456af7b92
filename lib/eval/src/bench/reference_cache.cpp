#include "bench/bench_parts.h"

#include <bdpt/error.h>
#include <bdpt/io/read_image.h>
#include <bdpt/io/write_image.h>
#include <bdpt/options/option_fields.h>

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "metrics/metric_parts.h"

namespace bdpt::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// Returns the noise of an image by its layer "variance"; 0 without the layer.
double noise_by_layer(const fs::path& file, const Image& image)
{
    io::LoadedImage variance;
    try {
        variance = io::read_image(file, {.layer = "variance"});
    } catch (const Error&) {
        return 0.0;
    }
    const double epsilon = bench_scale(image).squared_epsilon;
    const double noise = relative_mean(image, epsilon, [&](std::size_t i, int c, double /*r*/) {
        return static_cast<double>(variance.image.pixels[i][c]);
    });
    return std::isfinite(noise) && noise >= 0.0 ? noise : 0.0;
}

KeyedReference given_reference(const BenchScene& scene, const fs::path& given)
{
    std::error_code missing;
    const fs::path file = fs::is_directory(given, missing) ? given / (scene.name + ".exr") : given;
    Reference reference{.image = io::read_image(file).image, .noise = 0.0, .origin = file.string()};
    check_size(reference.image, scene.width, scene.height, file);
    check_image({.name = file.string(), .image = reference.image});
    reference.noise = noise_by_layer(file, reference.image);
    const auto bytes = std::as_bytes(std::span(reference.image.pixels));
    std::string key = hash_bytes({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
    return {.reference = std::move(reference), .key = std::move(key), .file = file};
}

struct HalvedRender {
    HalvedImage image;
    std::int64_t samples = 0;
};

std::optional<HalvedRender> render_halves(const BenchScene& scene, const BenchOptions& options,
                                          IntegratorKind integrator, BenchProgressMeter& meter,
                                          const BenchControl& control)
{
    const TrialSetup setup = make_setup(scene, options.render, integrator, reference_seed, control);
    meter.begin("reference by " + std::string(to_name(integrator)), options.reference_seconds);
    const auto samples = samples_in(setup, options.reference_seconds);
    const auto film = samples ? render_all(setup, *samples, meter) : std::nullopt;
    if (!film) {
        return std::nullopt;
    }
    meter.end();
    return HalvedRender{.image = {.image = film->develop(),
                                  .first = film->develop_half(0),
                                  .second = film->develop_half(1)},
                        .samples = *samples};
}

std::string describe_origin(const CombinedReference& combined, const HalvedRender& bdpt,
                            const HalvedRender& mis)
{
    char text[160];
    if (combined.share == 1.0) {
        std::snprintf(text, sizeof text,
                      "bdpt with %lld samples; mis is excluded, as it differs by %.3g times what "
                      "noise explains",
                      static_cast<long long>(bdpt.samples), combined.agreement);
    } else {
        std::snprintf(text, sizeof text, "bdpt with %lld samples (%.0f %%) and mis with %lld",
                      static_cast<long long>(bdpt.samples), 100.0 * combined.share,
                      static_cast<long long>(mis.samples));
    }
    return text;
}

void keep(const KeyedReference& keyed, const BenchFiles& files, const BenchScene& scene,
          const BenchOptions& options)
{
    io::write_exr(keyed.file, keyed.reference.image, {.metadata = make_metadata(scene)});
    // Written last: a reference without its facts does not count.
    write_json(files.reference_facts(keyed.key),
               {{"origin", keyed.reference.origin},
                {"noise_relmse", keyed.reference.noise},
                {"cpu_seconds_each", options.reference_seconds},
                {"settings", render_settings(scene, options.render)}});
}

std::optional<KeyedReference> kept_reference(const std::string& key, const BenchFiles& files,
                                             const BenchScene& scene)
{
    const fs::path facts_file = files.reference_facts(key);
    const std::optional<ordered_json> facts = read_json(facts_file);
    if (!facts) {
        return std::nullopt;
    }
    const auto noise = facts->find("noise_relmse");
    const auto origin = facts->find("origin");
    if (noise == facts->end() || !noise->is_number() || origin == facts->end() ||
        !origin->is_string()) {
        throw Error(
            ErrorCode::invalid_input,
            facts_file.string() + ": is incomplete; delete it to render the reference again");
    }
    const fs::path file = files.reference_image(key);
    Reference reference{.image = io::read_image(file).image,
                        .noise = noise->get<double>(),
                        .origin = origin->get<std::string>()};
    check_size(reference.image, scene.width, scene.height, file);
    check_image({.name = file.string(), .image = reference.image});
    return KeyedReference{.reference = std::move(reference), .key = key, .file = file};
}

}  // namespace

std::string reference_key(const BenchScene& scene, const BenchOptions& options)
{
    ordered_json settings = render_settings(scene, options.render);
    settings["reference_seconds"] = options.reference_seconds;
    return hash_bytes(settings.dump());
}

std::optional<KeyedReference> reference_for(const BenchScene& scene, const BenchOptions& options,
                                            const BenchFiles& files, BenchProgressMeter& meter,
                                            const BenchControl& control)
{
    if (options.reference) {
        meter.skip(2.0 * options.reference_seconds);
        return given_reference(scene, *options.reference);
    }
    const std::string key = reference_key(scene, options);
    if (auto kept = kept_reference(key, files, scene)) {
        meter.skip(2.0 * options.reference_seconds);
        return kept;
    }
    const auto bdpt = render_halves(scene, options, IntegratorKind::bdpt, meter, control);
    const auto mis =
        bdpt ? render_halves(scene, options, IntegratorKind::mis, meter, control) : std::nullopt;
    if (!mis) {
        return std::nullopt;
    }
    CombinedReference combined = combine(bdpt->image, mis->image);
    KeyedReference result{.reference = {.image = std::move(combined.image),
                                        .noise = combined.noise,
                                        .origin = describe_origin(combined, *bdpt, *mis)},
                          .key = key,
                          .file = files.reference_image(key)};
    keep(result, files, scene, options);
    return result;
}

}  // namespace bdpt::eval
