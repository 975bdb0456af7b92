// What the Sobol sampler brings and costs: error at equal samples and CPU time of whole renders,
// against independent random numbers, in turn.

#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <string>

#include "subject.h"

namespace {

using namespace bdpt;

struct Settings {
    std::string scene;
    SubjectSettings subject;
    harness::ContestOptions contest;
};

struct Kind {
    IntegratorKind kind;
    const char* name;
};

void measure(const Settings& settings)
{
    const Subject subject = load_subject(settings.scene, settings.subject);
    const harness::Reference reference =
        make_reference(subject, settings.subject.reference_samples);
    std::printf("%-5s %14s %14s %14s %14s\n", "", "relMSE sobol", "independent", "error ratio",
                "time ratio");
    for (const Kind& integrator : {Kind{IntegratorKind::pt, "pt"}, Kind{IntegratorKind::mis, "mis"},
                                   Kind{IntegratorKind::bdpt, "bdpt"}}) {
        std::array variants{harness::Variant{"sobol", subject.options},
                            harness::Variant{"independent", subject.options}};
        for (harness::Variant& variant : variants) {
            variant.options.integrator = integrator.kind;
        }
        variants[1].options.sampler = SamplerKind::independent;
        const auto scores =
            harness::compete(subject.bench_scene(), reference, variants, settings.contest);
        std::printf("%-5s %14.3e %14.3e %14.2f %14.3f\n", integrator.name, scores[0].error.median,
                    scores[1].error.median, scores[1].error.median / scores[0].error.median,
                    scores[0].sample_seconds / scores[1].sample_seconds);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"Error and time of Sobol points against independent random numbers"};
    app.add_option("scene", settings.scene, "A glTF file with a camera")->required();
    add_sample_options(app, settings.contest);
    add_options(app, settings.subject);
    add_reference_option(app, settings.subject);
    CLI11_PARSE(app, argc, argv);
    return report_errors([&] {
        measure(settings);
        return 0;
    });
}
