// Measures sampling options against the plain ones: error and time of whole renders, interleaved.

#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "subject.h"

namespace {

using namespace bdpt;

/// Two options to compare.
struct Choice {
    const char* name;
    const char* plain;
    const char* better;
    void (*set)(RenderOptions&, bool better);
};

constexpr std::array choices{
    Choice{"sampler", "independent", "sobol",
           [](RenderOptions& options, bool better) {
               options.sampling.sampler = better ? SamplerKind::sobol : SamplerKind::independent;
           }},
    Choice{"environment", "plain", "compensated",
           [](RenderOptions& options, bool better) {
               options.sampling.environment =
                   better ? EnvironmentSampling::compensated : EnvironmentSampling::plain;
           }},
    Choice{"lights", "power", "tree", [](RenderOptions& options, bool better) {
               options.sampling.lights = better ? LightSampling::tree : LightSampling::power;
           }}};

struct Settings {
    std::string choice;
    std::vector<std::string> scenes;
    SubjectSettings subject{.size = 64, .max_depth = 6};
    eval::EqualTimeOptions contest;
};

struct Kind {
    IntegratorKind kind;
    const char* name;
};

void measure(const std::string& file, const Choice& choice, const Settings& settings)
{
    Subject subject = load_subject(file, settings.subject);
    choice.set(subject.options, true);
    const eval::Reference reference = make_reference(subject, settings.subject.reference_samples);
    std::printf("  %zu lights; relMSE %s, %s, its factor, that of the time of a sample\n",
                subject.scene.counts().lights, choice.plain, choice.better);
    for (const Kind& integrator : {Kind{IntegratorKind::pt, "pt"}, Kind{IntegratorKind::mis, "mis"},
                                   Kind{IntegratorKind::bdpt, "bdpt"}}) {
        subject.options.integrator = integrator.kind;
        std::array variants{eval::Variant{choice.plain, subject.options},
                            eval::Variant{choice.better, subject.options}};
        choice.set(variants[0].options, false);
        const auto scores = eval::compare_at_equal_time(subject.bench_scene(), reference, variants,
                                                        settings.contest);
        std::printf("  %-4s %.2e %.2e %5.2f %5.2f\n", integrator.name, scores[0].error.median,
                    scores[1].error.median, scores[1].error.median / scores[0].error.median,
                    scores[1].sample_seconds / scores[0].sample_seconds);
        std::fflush(stdout);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{
        "Error and time of ways to sample: Sobol points against independent numbers "
        "(sampler), compensated against plain sampling of environments (environment), the "
        "tree against the power of lights (lights)"};
    std::vector<std::string> names;
    for (const Choice& choice : choices) {
        names.emplace_back(choice.name);
    }
    app.add_option("choice", settings.choice, "What is chosen")
        ->required()
        ->check(CLI::IsMember(names));
    app.add_option("scenes", settings.scenes, "glTF files")->required();
    app.add_option("--spp", settings.contest.samples,
                   "Samples per pixel, however long they take, in place of --time");
    add_options(app, settings.contest);
    add_options(app, settings.subject);
    add_reference_option(app, settings.subject);
    CLI11_PARSE(app, argc, argv);
    return report_errors([&] {
        for (const Choice& choice : choices) {
            for (const std::string& scene : settings.scenes) {
                if (settings.choice == choice.name) {
                    measure(scene, choice, settings);
                }
            }
        }
        return 0;
    });
}
