#include "report/json_values.h"

#include <bdpt/options/option_fields.h>
#include <bdpt/version.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "bench/bench_parts.h"

namespace bdpt::eval {
namespace {

using nlohmann::ordered_json;

ordered_json options_json(const BenchOptions& options)
{
    ordered_json integrators = ordered_json::array();
    for (const IntegratorKind kind : options.integrators) {
        integrators.push_back(to_name(kind));
    }
    const RenderOptions& render = options.render;
    ordered_json result{{"integrators", integrators}, {"cpu_seconds", options.seconds}};
    result["equal_samples"] = options.samples ? ordered_json(*options.samples) : ordered_json();
    result["seeds"] = options.seeds;
    result["reference"] =
        options.reference ? ordered_json(options.reference->string()) : ordered_json();
    result["reference_cpu_seconds"] = 2.0 * options.reference_seconds;
    result["strategy_depth"] = options.strategy_depth;
    result["max_depth"] = render.transport.max_depth;
    result["heuristic"] = to_name(render.transport.heuristic);
    result["sampler"] = render.sampling.sampler == SamplerKind::sobol ? "sobol" : "independent";
    result["threads"] = render.system.threads;
    return result;
}

ordered_json spread_json(const Spread& spread)
{
    return {{"median", spread.median}, {"least", spread.least}, {"greatest", spread.greatest}};
}

ordered_json goal_json(const GoalSummary& goal)
{
    return {{"samples", goal.samples},
            {"cpu_seconds", goal.cpu_seconds},
            {"wall_seconds", goal.wall_seconds},
            {"relmse", spread_json(goal.error)},
            {"relmse_scales", spread_json(goal.error_scales)},
            {"mape", spread_json(goal.mape)},
            {"near_reference_noise", goal.near_noise}};
}

ordered_json summary_json(const IntegratorSummary& summary)
{
    ordered_json curve = ordered_json::array();
    for (const CurvePoint& point : summary.curve) {
        curve.push_back({{"samples", point.samples},
                         {"cpu_seconds", point.cpu_seconds},
                         {"relmse", spread_json(point.error)}});
    }
    ordered_json result{{"integrator", to_name(summary.integrator)},
                        {"seeds", summary.seeds},
                        {"equal_time", goal_json(summary.equal_time)},
                        {"equal_samples", goal_json(summary.equal_samples)},
                        {"efficiency", summary.efficiency}};
    result["speed_up"] = nullptr;
    if (summary.speed_up) {
        result["speed_up"] = {{"factor", summary.speed_up->factor},
                              {"extrapolated", summary.speed_up->extrapolated}};
    }
    result["relmse_floor"] = summary.floor ? ordered_json(*summary.floor) : ordered_json();
    result["flip"] = summary.flip ? spread_json(*summary.flip) : ordered_json();
    result["flip_denoised"] =
        summary.denoised_flip ? spread_json(*summary.denoised_flip) : ordered_json();
    result["samples_per_second"] = summary.samples_per_second;
    result["rays_per_second"] = {{"camera", summary.camera_rays_per_second},
                                 {"light", summary.light_rays_per_second},
                                 {"shadow", summary.shadow_rays_per_second}};
    result["peak_memory_bytes"] =
        summary.peak_memory ? ordered_json(*summary.peak_memory) : ordered_json();
    result["invalid_samples"] = summary.invalid;
    result["curve"] = std::move(curve);
    return result;
}

}  // namespace

ordered_json head_json(const BenchRecord& record)
{
    const MachineFacts& machine = record.machine;
    return {{"version", BDPT_VERSION},
            {"started", record.started},
            {"command", record.command},
            {"machine",
             {{"cpu", machine.cpu},
              {"processors", machine.processors},
              {"system", machine.system},
              {"compiler", machine.compiler},
              {"libraries", machine.libraries}}},
            {"options", options_json(record.options)}};
}

ordered_json scene_json(const SceneResult& scene, double seconds)
{
    ordered_json integrators = ordered_json::array();
    for (const IntegratorSummary& summary : summarize(scene, seconds)) {
        integrators.push_back(summary_json(summary));
    }
    return {{"name", scene.name},
            {"file", scene.file},
            {"environment", scene.environment},
            {"camera", scene.camera},
            {"content", scene.content},
            {"width", scene.width},
            {"height", scene.height},
            {"complete", scene.complete},
            {"reference",
             {{"origin", scene.reference_origin},
              {"noise_relmse", scene.reference_noise},
              {"mean", scene.light_scale}}},
            {"integrators", std::move(integrators)}};
}

std::string bench_json(const BenchRecord& record)
{
    ordered_json result = head_json(record);
    result["scenes"] = ordered_json::array();
    for (const SceneResult& scene : record.scenes) {
        ordered_json json = scene_json(scene, record.options.seconds);
        json["runs"] = ordered_json::array();
        for (const BenchRun& run : scene.runs) {
            json["runs"].push_back(run_json(run));
        }
        result["scenes"].push_back(std::move(json));
    }
    return result.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace bdpt::eval
