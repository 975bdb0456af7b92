#include <bdpt/eval/bench_report.h>
#include <bdpt/options/option_fields.h>
#include <bdpt/version.h>

#include <algorithm>
#include <cstdio>

namespace bdpt::eval {
namespace {

constexpr const char* columns =
    "scene,file,content,width,height,max_depth,sampler,integrator,seed,samples,equal_time,"
    "equal_samples,cpu_seconds,wall_seconds,relmse,reference_noise,relmse_scales,mape,threads,cpu,"
    "libraries,version\n";

/// Formats a field of a CSV file [RFC 4180].
std::string field(const std::string& text)
{
    std::string result = "\"";
    for (const char c : text) {
        result += c == '"' ? "\"\"" : std::string(1, c);
    }
    return result + "\"";
}

std::string number(double value)
{
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return text;
}

}  // namespace

std::string bench_csv(const BenchRecord& record)
{
    const RenderOptions& render = record.options.render;
    std::string result = columns;
    const std::string tail = "," + std::to_string(render.system.threads) + "," +
                             field(record.machine.cpu) + "," + field(record.machine.libraries) +
                             "," BDPT_VERSION "\n";
    for (const SceneResult& scene : record.scenes) {
        const std::string head =
            field(scene.name) + "," + field(scene.file) + "," + scene.content + "," +
            std::to_string(scene.width) + "," + std::to_string(scene.height) + "," +
            std::to_string(render.transport.max_depth) + "," +
            (render.sampling.sampler == SamplerKind::sobol ? "sobol" : "independent") + ",";
        for (const BenchRun& run : scene.runs) {
            const auto goals = std::find_if(
                scene.goals.begin(), scene.goals.end(),
                [&](const BenchGoals& one) { return one.integrator == run.integrator; });
            for (const Checkpoint& point : run.checkpoints) {
                result += head + std::string(to_name(run.integrator)) + "," +
                          std::to_string(run.seed) + "," + std::to_string(point.samples) + "," +
                          (point.samples == goals->equal_time ? "1," : "0,") +
                          (point.samples == goals->equal_samples ? "1," : "0,") +
                          number(point.cpu_seconds) + "," + number(point.wall_seconds) + "," +
                          number(point.relmse) + "," + number(scene.reference_noise) + "," +
                          number(point.relmse_scales) + "," + number(point.mape) + tail;
            }
        }
    }
    return result;
}

}  // namespace bdpt::eval
