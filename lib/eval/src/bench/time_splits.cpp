#include "bench/time_splits.h"

#include <bdpt/error.h>
#include <bdpt/eval/report/packed_image.h>
#include <bdpt/options/option_fields.h>
#include <bdpt/render.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/trial.h"

namespace bdpt::eval {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr std::uint64_t split_seed = 3'000'000;  // not used by any run or reference

/// Encoding of logarithms of times in a byte: 0 for none, then from 2^-28 s in twelfths of an
/// octave.
constexpr double octaves_below = 28.0;
constexpr double steps = 12.0;

std::vector<std::uint8_t> time_map(const std::vector<float>& seconds)
{
    std::vector<std::uint8_t> result;
    for (const float of_pixel : seconds) {
        const double step =
            of_pixel > 0.0f ? 1.0 + steps * (std::log2(double{of_pixel}) + octaves_below) : 0.0;
        result.push_back(static_cast<std::uint8_t>(std::clamp(step + 0.5, 0.0, 255.0)));
    }
    return result;
}

ordered_json split_json(const TimeSplit& split, const TimeProfile& profile)
{
    ordered_json shares = ordered_json::object();
    for (const Phase phase : all_phases) {
        shares[to_string(phase)] = split.shares[static_cast<std::size_t>(phase)];
    }
    return {{"integrator", to_name(split.integrator)},
            {"samples", split.samples},
            {"sample_seconds", split.sample_seconds},
            {"shares", std::move(shares)},
            {"distortion", split.distortion},
            {"pixels", packed_bytes(time_map(profile.pixel_seconds))}};
}

[[noreturn]] void refuse_split(const fs::path& file, const std::string& what)
{
    throw Error(ErrorCode::invalid_input,
                file.string() + ": " + what + "; delete it to measure it again");
}

TimeSplit parse_split(const ordered_json& json, IntegratorKind integrator, const fs::path& file)
{
    TimeSplit split{.integrator = integrator};
    try {
        split.samples = json.at("samples").get<std::int64_t>();
        split.sample_seconds = json.at("sample_seconds").get<double>();
        split.distortion = json.at("distortion").get<double>();
        for (const Phase phase : all_phases) {
            split.shares[static_cast<std::size_t>(phase)] =
                json.at("shares").at(to_string(phase)).get<double>();
        }
        static_cast<void>(json.at("pixels").get<std::string>());
        if (json.at("integrator").get<std::string>() != to_name(integrator)) {
            refuse_split(file, "is of a different integrator than its name");
        }
    } catch (const nlohmann::json::exception&) {
        refuse_split(file, "lacks values of a time split of bdpt bench");
    }
    return split;
}

/// Measures a time split; returns none if stopped.
std::optional<TimeSplit> measure(const TrialSetup& setup, const BenchGoals& goals,
                                 const fs::path& file, const BenchProgressMeter& meter)
{
    RenderOptions options = setup.options;
    options.sampling.samples.end = std::max<std::int64_t>(
        static_cast<std::int64_t>(split_share * static_cast<double>(goals.equal_time)), 1);
    RenderControl control;
    control.stop = setup.control.stop;
    control.profiling = Profiling::on;
    control.on_progress = [&](const Progress& progress) {
        meter.tell(static_cast<double>(progress.samples_done) /
                   static_cast<double>(progress.samples_total));
    };
    const RenderResult result = render(setup.scene.scene, setup.scene.camera, options, control);
    if (result.samples.end() < options.sampling.samples.end) {
        return std::nullopt;
    }
    const TimeProfile& profile = result.profile.value();
    TimeSplit split{.integrator = options.integrator,
                    .shares = {},
                    .sample_seconds = profile.total() / static_cast<double>(profile.samples),
                    .samples = options.sampling.samples.end,
                    .distortion = profile.distortion};
    for (const Phase phase : all_phases) {
        split.shares[static_cast<std::size_t>(phase)] = profile.share(phase);
    }
    write_json(file, split_json(split, profile));
    return split;
}

}  // namespace

std::vector<TimeSplit> measure_time_splits(const BenchScene& scene, const BenchOptions& options,
                                           const BenchFiles& files,
                                           const std::vector<BenchGoals>& goals,
                                           BenchProgressMeter& meter, const BenchControl& control)
{
    std::vector<TimeSplit> splits;
    for (const BenchGoals& one : goals) {
        const double seconds = split_share * options.seconds;
        const fs::path file = files.time_split(one.integrator);
        if (const auto json = read_json(file)) {
            meter.skip(seconds);
            splits.push_back(parse_split(*json, one.integrator, file));
            continue;
        }
        meter.begin("where " + std::string(to_name(one.integrator)) + " takes its time", seconds);
        const auto split =
            measure(make_setup(scene, options.render, one.integrator, split_seed, control), one,
                    file, meter);
        if (!split) {
            break;
        }
        meter.end();
        splits.push_back(*split);
    }
    return splits;
}

std::optional<std::string> packed_time_map(const BenchFiles& files, IntegratorKind integrator)
{
    const fs::path file = files.time_split(integrator);
    const auto json = read_json(file);
    if (!json) {
        return std::nullopt;
    }
    static_cast<void>(parse_split(*json, integrator, file));
    return json->at("pixels").get<std::string>();
}

}  // namespace bdpt::eval
