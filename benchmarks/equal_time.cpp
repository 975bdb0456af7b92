// Error at equal time: renders scenes with each integrator for the same CPU time, over several
// seeds in turn, and prints the error of each against a reference.

#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "contest.h"
#include "subject.h"

namespace {

using namespace bdpt;

struct Settings {
    std::vector<std::string> scenes;
    SubjectSettings subject;
    Contest contest;
};

void measure(const std::string& file, const Settings& settings)
{
    const Subject subject = load_subject(file, settings.subject);
    const Reference reference = make_reference(subject, settings.subject.reference_samples);
    std::vector<Variant> variants{{"pt", subject.options},
                                  {"mis", subject.options},
                                  {"nee", subject.options},
                                  {"bdpt", subject.options}};
    constexpr std::array kinds{IntegratorKind::pt, IntegratorKind::mis, IntegratorKind::nee,
                               IntegratorKind::bdpt};
    for (std::size_t v = 0; v < variants.size(); ++v) {
        variants[v].options.integrator = kinds[v];
    }
    const std::vector<Score> scores = compete(subject, reference, variants, settings.contest);
    std::printf("%-5s %9s %12s %12s\n", "", "samples", "relMSE", "over bdpt");
    for (std::size_t v = 0; v < variants.size(); ++v) {
        std::printf("%-5s %9lld %12.3e %11.2fx   (%.2e .. %.2e)\n", variants[v].name.c_str(),
                    static_cast<long long>(scores[v].samples), scores[v].error,
                    scores[v].error / scores.back().error, scores[v].least_error,
                    scores[v].greatest_error);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"Error of pt, mis, nee and bdpt at equal CPU time"};
    app.add_option("scenes", settings.scenes, "glTF files with a camera")->required();
    add_options(app, settings.subject);
    add_reference_option(app, settings.subject);
    add_options(app, settings.contest);
    CLI11_PARSE(app, argc, argv);
    return report_errors([&] {
        for (const std::string& scene : settings.scenes) {
            measure(scene, settings);
        }
        return 0;
    });
}
