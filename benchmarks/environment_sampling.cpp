// What compensated sampling of environments brings: error at equal samples and CPU time, against
// plain sampling by luminance, in turn.

#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "subject.h"

namespace {

using namespace bdpt;

struct Settings {
    std::vector<std::string> scenes;
    SubjectSettings subject{.size = 64, .max_depth = 6};
    harness::ContestOptions contest;
};

struct Kind {
    IntegratorKind kind;
    const char* name;
};

void measure(const std::string& file, const Settings& settings)
{
    const Subject subject = load_subject(file, settings.subject);
    const harness::Reference reference =
        make_reference(subject, settings.subject.reference_samples);
    for (const Kind& integrator :
         {Kind{IntegratorKind::mis, "mis"}, Kind{IntegratorKind::bdpt, "bdpt"}}) {
        std::array variants{harness::Variant{"plain", subject.options},
                            harness::Variant{"compensated", subject.options}};
        for (harness::Variant& variant : variants) {
            variant.options.integrator = integrator.kind;
        }
        variants[0].options.environment_sampling = EnvironmentSampling::plain;
        variants[1].options.environment_sampling = EnvironmentSampling::compensated;
        const auto scores =
            harness::compete(subject.bench_scene(), reference, variants, settings.contest);
        std::printf("  %-4s relMSE: plain %.2e, compensated %.2e, ratio %.2f; time ratio %.2f\n",
                    integrator.name, scores[0].error.median, scores[1].error.median,
                    scores[1].error.median / scores[0].error.median,
                    scores[1].sample_seconds / scores[0].sample_seconds);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"Error and time of compensated sampling of environments against plain sampling"};
    app.add_option("scenes", settings.scenes, "glTF files with an environment, or see --env")
        ->required();
    add_sample_options(app, settings.contest);
    add_options(app, settings.subject);
    add_reference_option(app, settings.subject);
    CLI11_PARSE(app, argc, argv);
    return report_errors([&] {
        for (const std::string& scene : settings.scenes) {
            measure(scene, settings);
        }
        return 0;
    });
}
