// The gate: tests whether bdpt is as much better than mis as required. Compares the error at equal
// CPU time in scenes where light is hard to find, and where it is easy.

#include <CLI/CLI.hpp>

#include <array>
#include <cstdio>
#include <string>

#include "subject.h"

namespace {

using namespace bdpt;

/// A scene and the least required ratio of the error of `mis` to that of bdpt.
struct Demand {
    const char* file;
    double min_ratio;
};

constexpr std::array demands{Demand{"cornell-box-hidden.gltf", 4.0}, Demand{"lamp-box.gltf", 10.0},
                             Demand{"cornell-box.gltf", 1.0 / 1.5}};

struct Settings {
    std::string folder;
    SubjectSettings subject;
    eval::EqualTimeOptions contest;
};

/// Tests whether the scene meets the demand.
bool measure(const Demand& demand, const Settings& settings)
{
    const Subject subject = load_subject(settings.folder + "/" + demand.file, settings.subject);
    const eval::Reference reference = make_reference(subject, settings.subject.reference_samples);
    std::array variants{eval::Variant{"bdpt", subject.options},
                        eval::Variant{"mis", subject.options}};
    variants[1].options.integrator = IntegratorKind::mis;
    const auto scores =
        compare_at_equal_time(subject.bench_scene(), reference, variants, settings.contest);
    const double ratio = scores[1].error.median / scores[0].error.median;
    const bool met = ratio >= demand.min_ratio;
    std::printf("  relMSE: bdpt %.2e (%.2e .. %.2e), mis %.2e (%.2e .. %.2e)\n",
                scores[0].error.median, scores[0].error.least, scores[0].error.greatest,
                scores[1].error.median, scores[1].error.least, scores[1].error.greatest);
    std::printf("  samples: bdpt %lld, mis %lld\n", static_cast<long long>(scores[0].samples),
                static_cast<long long>(scores[1].samples));
    std::printf("  mis has %.2f times the relMSE of bdpt; at least %.2f is asked for: %s\n", ratio,
                demand.min_ratio, met ? "met" : "NOT MET");
    return met;
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    settings.folder = BDPT_SCENES_DIR;
    CLI::App app{"Is bdpt as good against mis at equal CPU time as it is meant to be?"};
    app.add_option("folder", settings.folder, "Where the scenes are")->capture_default_str();
    add_options(app, settings.subject);
    add_reference_option(app, settings.subject);
    add_options(app, settings.contest);
    CLI11_PARSE(app, argc, argv);
    return report_errors([&] {
        int missed = 0;
        for (const Demand& demand : demands) {
            missed += measure(demand, settings) ? 0 : 1;
        }
        std::printf("gate: %s\n", missed == 0 ? "passed" : "NOT PASSED");
        return missed == 0 ? 0 : 1;
    });
}
