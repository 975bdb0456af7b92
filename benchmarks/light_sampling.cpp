// What a tree of lights brings to next-event estimation: error at equal CPU time and time of a
// sample, against the choice by power alone, in turn.

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
    SubjectSettings subject{.size = 64, .max_depth = 5};
    harness::ContestOptions contest;
};

struct Kind {
    IntegratorKind kind;
    const char* name;
};

void measure(const std::string& file, const Settings& settings)
{
    Subject subject = load_subject(file, settings.subject);
    // Of all integrators and ways to choose it has the least error in the same time.
    subject.options.light_sampling = LightSampling::tree;
    const harness::Reference reference =
        make_reference(subject, settings.subject.reference_samples);
    std::printf("  %zu lights, relMSE by power and by tree, its factor, that of time\n",
                subject.scene.counts().lights);
    for (const Kind& integrator :
         {Kind{IntegratorKind::mis, "mis"}, Kind{IntegratorKind::bdpt, "bdpt"}}) {
        std::array variants{harness::Variant{"power", subject.options},
                            harness::Variant{"tree", subject.options}};
        for (harness::Variant& variant : variants) {
            variant.options.integrator = integrator.kind;
        }
        variants[0].options.light_sampling = LightSampling::power;
        const auto scores =
            harness::compete(subject.bench_scene(), reference, variants, settings.contest);
        std::printf("  %-4s %.2e %.2e %5.2f %5.2f\n", integrator.name, scores[0].error.median,
                    scores[1].error.median, scores[0].error.median / scores[1].error.median,
                    scores[1].sample_seconds / scores[0].sample_seconds);
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"Error and time with a tree of lights against the choice of lights by power"};
    app.add_option("scenes", settings.scenes, "glTF files")->required();
    add_options(app, settings.contest);
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
