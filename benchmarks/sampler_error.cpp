// What the Sobol sampler brings and costs: error at equal samples and CPU time of whole renders,
// against independent random numbers, in turn.

#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <string>

#include "contest.h"
#include "subject.h"

namespace {

using namespace bdpt;

struct Settings {
    std::string scene;
    SubjectSettings subject;
    int rounds = 5;
    std::int64_t samples = 16;
};

struct Kind {
    IntegratorKind kind;
    const char* name;
};

void measure(const Settings& settings)
{
    const Subject subject = load_subject(settings.scene, settings.subject);
    const Reference reference = make_reference(subject, settings.subject.reference_samples);
    std::printf("%-5s %14s %14s %14s %14s\n", "", "relMSE sobol", "independent", "error ratio",
                "time ratio");
    for (const Kind& integrator : {Kind{IntegratorKind::pt, "pt"}, Kind{IntegratorKind::mis, "mis"},
                                   Kind{IntegratorKind::bdpt, "bdpt"}}) {
        std::array variants{Variant{"sobol", subject.options},
                            Variant{"independent", subject.options}};
        for (Variant& variant : variants) {
            variant.options.integrator = integrator.kind;
        }
        variants[1].options.sampler = SamplerKind::independent;
        const auto scores = compete_at_equal_samples(subject, reference, variants, settings.samples,
                                                     settings.rounds);
        std::printf("%-5s %14.3e %14.3e %14.2f %14.3f\n", integrator.name, scores[0].error,
                    scores[1].error, scores[1].error / scores[0].error,
                    scores[0].sample_seconds / scores[1].sample_seconds);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"Error and time of Sobol points against independent random numbers"};
    app.add_option("scene", settings.scene, "A glTF file with a camera")->required();
    app.add_option("--spp", settings.samples, "Samples per pixel")->capture_default_str();
    app.add_option("--rounds", settings.rounds, "Renders of each")->capture_default_str();
    add_options(app, settings.subject);
    add_reference_option(app, settings.subject);
    CLI11_PARSE(app, argc, argv);
    return report_errors([&] {
        measure(settings);
        return 0;
    });
}
