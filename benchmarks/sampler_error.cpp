// What the Sobol sampler brings and costs: error at equal samples and CPU time of whole renders on
// one thread, against independent random numbers, in turn (A B A B ...).

#include <bdpt/harness/metrics/metric.h>
#include <bdpt/io/gltf.h>
#include <bdpt/render.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <string>
#include <vector>

namespace {

using namespace bdpt;

struct Settings {
    std::string scene;
    int size = 128;
    int max_depth = 8;
    int repeats = 5;
    std::int64_t samples = 16;
    std::int64_t reference_samples = 4096;
};

struct Outcome {
    std::vector<double> errors;
    std::vector<double> seconds;  // of CPU time: other programs on the machine count less
};

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

double cpu_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void measure(const Settings& settings)
{
    const io::LoadedScene loaded = io::load_gltf(settings.scene);
    const Scene scene(loaded.scene);
    const CameraDesc& camera = loaded.cameras.at(0);
    RenderOptions options;
    options.width = settings.size;
    options.height = settings.size;
    options.max_depth = settings.max_depth;
    options.seed = 1000;
    options.samples.end = settings.reference_samples;
    const RenderResult reference = render(scene, camera, options);
    const Image truth = reference.film.develop();
    // The squared difference of the halves has four times the variance of their mean.
    std::printf("reference: bdpt, %lld samples, relMSE about %.2e\n",
                static_cast<long long>(settings.reference_samples),
                harness::evaluate(harness::Metric::relmse, reference.film.develop_half(0),
                                  reference.film.develop_half(1)) /
                    4);

    struct Kind {
        IntegratorKind kind;
        const char* name;
    };
    options.threads = 1;
    options.samples.end = settings.samples;
    std::printf("%-5s %14s %14s %14s %14s\n", "", "relMSE sobol", "independent", "error ratio",
                "time ratio");
    for (const Kind& integrator : {Kind{IntegratorKind::pt, "pt"}, Kind{IntegratorKind::mis, "mis"},
                                   Kind{IntegratorKind::bdpt, "bdpt"}}) {
        options.integrator = integrator.kind;
        Outcome sobol;
        Outcome independent;
        for (int repeat = 0; repeat < settings.repeats; ++repeat) {
            options.seed = static_cast<std::uint64_t>(repeat);
            for (const auto sampler : {SamplerKind::sobol, SamplerKind::independent}) {
                options.sampler = sampler;
                Outcome& outcome = sampler == SamplerKind::sobol ? sobol : independent;
                const double begin = cpu_seconds();
                const RenderResult result = render(scene, camera, options);
                outcome.seconds.push_back(cpu_seconds() - begin);
                outcome.errors.push_back(
                    harness::evaluate(harness::Metric::relmse, result.film.develop(), truth));
            }
        }
        std::printf("%-5s %14.3e %14.3e %14.2f %14.3f\n", integrator.name, median(sobol.errors),
                    median(independent.errors), median(independent.errors) / median(sobol.errors),
                    median(sobol.seconds) / median(independent.seconds));
    }
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"Error and time of Sobol points against independent random numbers"};
    app.add_option("scene", settings.scene, "A glTF file with a camera")->required();
    app.add_option("--size", settings.size, "Width and height [pixels]")->capture_default_str();
    app.add_option("--max-depth", settings.max_depth, "Longest path")->capture_default_str();
    app.add_option("--spp", settings.samples, "Samples per pixel")->capture_default_str();
    app.add_option("--repeats", settings.repeats, "Renders of each")->capture_default_str();
    app.add_option("--reference", settings.reference_samples, "Samples of the reference")
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    try {
        measure(settings);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 1;
    }
    return 0;
}
