#include "bench/bench_parts.h"

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <bdpt/options/option_fields.h>
#include <bdpt/part/content_hash.h>
#include <bdpt/part/identity.h>
#include <bdpt/version.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

namespace bdpt::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string run_name(IntegratorKind integrator, std::uint64_t seed)
{
    return std::string(to_name(integrator)) + "-" + std::to_string(seed);
}

[[noreturn]] void refuse(const fs::path& file, const std::string& what)
{
    throw Error(ErrorCode::invalid_input,
                file.string() + ": " + what + "; delete it to render it again");
}

}  // namespace

BenchFiles::BenchFiles(fs::path folder, std::string scene)
    : folder_(std::move(folder)), scene_(std::move(scene))
{}

fs::path BenchFiles::plan() const
{
    return folder_ / "scenes" / scene_ / "plan.json";
}

fs::path BenchFiles::run(IntegratorKind integrator, std::uint64_t seed) const
{
    return folder_ / "scenes" / scene_ / (run_name(integrator, seed) + ".json");
}

fs::path BenchFiles::image(IntegratorKind integrator, std::uint64_t seed) const
{
    return folder_ / "scenes" / scene_ / (run_name(integrator, seed) + ".exr");
}

fs::path BenchFiles::strategies() const
{
    return folder_ / "scenes" / scene_ / "strategies.json";
}

fs::path BenchFiles::reference_image(const std::string& key) const
{
    return folder_ / "references" / (scene_ + "-" + key + ".exr");
}

fs::path BenchFiles::reference_facts(const std::string& key) const
{
    return folder_ / "references" / (scene_ + "-" + key + ".json");
}

void BenchFiles::create() const
{
    for (const fs::path& folder : {folder_ / "scenes" / scene_, folder_ / "references"}) {
        std::error_code failure;
        fs::create_directories(folder, failure);
        if (failure) {
            throw Error(ErrorCode::output, folder.string() + ": " + failure.message());
        }
    }
}

ordered_json render_settings(const BenchScene& scene, const RenderOptions& options)
{
    RenderOptions common = options;
    common.integrator = IntegratorKind::mis;  // a kind that needs no pilot
    common.film.width = scene.width;
    common.film.height = scene.height;
    common.sampling.seed = 0;
    ordered_json settings;
    constexpr std::string_view option = "option: ";
    for (const auto& [name, value] : identity(scene.scene, scene.camera, common).components) {
        if (name.starts_with(option)) {
            settings[name.substr(option.size())] = value;
        } else if (name == "build: version" || !name.starts_with("build: ")) {
            settings[name] = value;
        }
    }
    settings.erase("integrator");
    settings.erase("seed");
    return settings;
}

std::string hash_content(const BenchScene& scene)
{
    const ordered_json settings = render_settings(scene, {});
    ordered_json content;
    for (const auto& [name, value] : settings.items()) {
        if (name.starts_with("scene: ") || name.starts_with("camera: ")) {
            content[name] = value;
        }
    }
    return hash_bytes(content.dump());
}

std::string hash_bytes(std::string_view bytes)
{
    ContentHasher hasher;
    hasher.add(bytes.data(), bytes.size());
    return to_string(hasher.hash());
}

std::optional<ordered_json> read_json(const fs::path& file)
{
    std::error_code missing;
    if (!fs::exists(file, missing)) {
        return std::nullopt;
    }
    std::ifstream stream(file, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream) {
        throw Error(ErrorCode::not_found, file.string() + ": cannot be read");
    }
    ordered_json json = ordered_json::parse(text, nullptr, false);
    if (json.is_discarded() || !json.is_object()) {
        refuse(file, "was not written by bdpt bench");
    }
    return json;
}

void write_json(const fs::path& file, const ordered_json& json)
{
    const std::string text =
        json.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
    io::OutputFile output(file);
    output.write(text);
    output.commit();
}

io::ImageMetadata make_metadata(const BenchScene& scene)
{
    io::ImageMetadata metadata;
    metadata.version = BDPT_VERSION;
    metadata.scene = scene.file;
    metadata.camera = scene.camera;
    metadata.origin = scene.scene.description().origin;
    metadata.created = std::chrono::system_clock::now();
    return metadata;
}

void check_size(const Image& image, int width, int height, const fs::path& file)
{
    if (image.width != width || image.height != height) {
        throw Error(ErrorCode::invalid_input,
                    file.string() + ": has " + std::to_string(image.width) + " x " +
                        std::to_string(image.height) + " pixels, but the scene is rendered with " +
                        std::to_string(width) + " x " + std::to_string(height));
    }
}

ordered_json run_json(const BenchRun& run)
{
    ordered_json checkpoints = ordered_json::array();
    for (const Checkpoint& point : run.checkpoints) {
        checkpoints.push_back({{"samples", point.samples},
                               {"cpu_seconds", point.cpu_seconds},
                               {"wall_seconds", point.wall_seconds},
                               {"relmse", point.relmse},
                               {"relmse_scales", point.relmse_scales},
                               {"mape", point.mape}});
    }
    const RenderStats& stats = run.stats;
    ordered_json result{{"integrator", to_name(run.integrator)},
                        {"seed", run.seed},
                        {"checkpoints", checkpoints},
                        {"rays",
                         {{"camera", stats.rays.camera},
                          {"light", stats.rays.light},
                          {"shadow", stats.rays.shadow}}},
                        {"paths", {{"camera", stats.paths.camera}, {"light", stats.paths.light}}},
                        {"defects", {{"invalid", run.invalid}, {"saturated", run.saturated}}}};
    result["peak_memory_bytes"] = run.peak_memory ? ordered_json(*run.peak_memory) : ordered_json();
    return result;
}

BenchRun parse_run(const ordered_json& json, const fs::path& file)
{
    BenchRun run;
    try {
        const auto integrator =
            parse_enumerator<IntegratorKind>(json.at("integrator").get<std::string>());
        if (!integrator) {
            refuse(file, "names an unknown integrator");
        }
        run.integrator = *integrator;
        run.seed = json.at("seed").get<std::uint64_t>();
        for (const ordered_json& point : json.at("checkpoints")) {
            run.checkpoints.push_back({.samples = point.at("samples").get<std::int64_t>(),
                                       .cpu_seconds = point.at("cpu_seconds").get<double>(),
                                       .wall_seconds = point.at("wall_seconds").get<double>(),
                                       .relmse = point.at("relmse").get<double>(),
                                       .relmse_scales = point.at("relmse_scales").get<double>(),
                                       .mape = point.at("mape").get<double>()});
        }
        const ordered_json& rays = json.at("rays");
        run.stats.rays = {.camera = rays.at("camera").get<std::uint64_t>(),
                          .light = rays.at("light").get<std::uint64_t>(),
                          .shadow = rays.at("shadow").get<std::uint64_t>(),
                          .aov = 0};
        run.stats.paths = {.camera = json.at("paths").at("camera").get<std::uint64_t>(),
                           .light = json.at("paths").at("light").get<std::uint64_t>()};
        run.invalid = json.at("defects").at("invalid").get<std::uint64_t>();
        run.saturated = json.at("defects").at("saturated").get<std::uint64_t>();
        if (!json.at("peak_memory_bytes").is_null()) {
            run.peak_memory = json.at("peak_memory_bytes").get<std::uint64_t>();
        }
    } catch (const nlohmann::json::exception&) {
        refuse(file, "lacks values of a run of bdpt bench");
    }
    return run;
}

}  // namespace bdpt::eval
