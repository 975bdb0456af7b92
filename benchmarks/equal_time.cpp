// Error at equal time: renders a scene with each integrator for the same number of seconds, over
// several seeds in turn (A B C A B C ...), and prints the error of each against a reference.

#include <bdpt/harness/metrics/metric.h>
#include <bdpt/io/gltf.h>
#include <bdpt/render.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace {

using namespace bdpt;

struct Settings {
    std::string scene;
    int size = 128;
    int max_depth = 8;
    double seconds = 5.0;
    int seeds = 5;
    std::int64_t reference_samples = 4096;
};

double median(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

struct Row {
    IntegratorKind kind;
    const char* name;
    std::vector<double> errors{};
    std::vector<double> samples{};
};

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
    // Half the squared difference of the two independent halves is the variance of one; that of
    // their mean is a quarter of the whole.
    std::printf("reference: bdpt, %lld samples, %.1f s, relMSE about %.2e\n",
                static_cast<long long>(settings.reference_samples), reference.seconds,
                harness::evaluate(harness::Metric::relmse, reference.film.develop_half(0),
                                  reference.film.develop_half(1)) /
                    4);

    std::array<Row, 3> rows{Row{IntegratorKind::pt, "pt"}, Row{IntegratorKind::mis, "mis"},
                            Row{IntegratorKind::bdpt, "bdpt"}};
    options.samples.end = 1 << 24;
    for (int seed = 0; seed < settings.seeds; ++seed) {
        for (Row& row : rows) {
            options.integrator = row.kind;
            options.seed = static_cast<std::uint64_t>(seed);
            RenderControl control;
            control.time_limit = settings.seconds;
            const RenderResult result = render(scene, camera, options, control);
            row.errors.push_back(
                harness::evaluate(harness::Metric::relmse, result.film.develop(), truth) *
                result.seconds / settings.seconds);
            row.samples.push_back(static_cast<double>(result.film.sample_count()));
        }
    }
    const double bdpt = median(rows[2].errors);
    std::printf("%-5s %12s %12s %16s\n", "", "samples", "relMSE", "over bdpt");
    for (const Row& row : rows) {
        std::printf("%-5s %12.0f %12.3e %15.2fx   (%.2e .. %.2e)\n", row.name, median(row.samples),
                    median(row.errors), median(row.errors) / bdpt,
                    *std::min_element(row.errors.begin(), row.errors.end()),
                    *std::max_element(row.errors.begin(), row.errors.end()));
    }
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"Error of pt, mis and bdpt at equal time"};
    app.add_option("scene", settings.scene, "A glTF file with a camera")->required();
    app.add_option("--size", settings.size, "Width and height [pixels]")->capture_default_str();
    app.add_option("--max-depth", settings.max_depth, "Longest path")->capture_default_str();
    app.add_option("--time", settings.seconds, "Seconds a render")->capture_default_str();
    app.add_option("--seeds", settings.seeds, "Renders of each integrator")->capture_default_str();
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
