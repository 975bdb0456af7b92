// Measures the speed-up of several threads over one: the same render with either, interleaved.

#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <string>

#include "measure.h"
#include "subject.h"

namespace {

using namespace bdpt;

struct Settings {
    std::string scene;
    SubjectSettings subject{.threads = 2};
    std::int64_t samples = 16;
    int rounds = 5;
};

void measure(const Settings& settings)
{
    const Subject subject = load_subject(settings.scene, settings.subject);
    const std::array threads{1, settings.subject.threads};
    RenderOptions options = subject.options;
    options.sampling.samples.end = settings.samples;
    const auto seconds = in_turn(threads.size(), settings.rounds, [&](std::size_t v, int) {
        options.system.threads = threads[v];
        return render(subject.scene, subject.camera, options).seconds;
    });
    std::printf("%s: 1 thread %.3f s, %d threads %.3f s: %.3f times as fast\n",
                subject.name.c_str(), median(seconds[0]), threads[1], median(seconds[1]),
                median_ratio(seconds[0], seconds[1]));
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"How much faster bdpt renders with several threads than with one"};
    app.add_option("scene", settings.scene, "A glTF file with a camera")->required();
    app.add_option("--spp", settings.samples, "Samples per pixel")->capture_default_str();
    app.add_option("--rounds", settings.rounds, "Renders with each")->capture_default_str();
    add_options(app, settings.subject);
    CLI11_PARSE(app, argc, argv);
    return report_errors([&] {
        measure(settings);
        return 0;
    });
}
