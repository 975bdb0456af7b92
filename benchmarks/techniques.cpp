// Measures costs and benefits of parts of bdpt: splats, weights, Russian roulette, more light
// paths. Each is switched separately, and compared with the default bdpt.

#include <CLI/CLI.hpp>

#include <cstdio>
#include <string>
#include <vector>

#include "subject.h"

namespace {

using namespace bdpt;

struct Settings {
    std::vector<std::string> scenes;
    SubjectSettings subject;
    eval::EqualTimeOptions contest;
};

/// Returns all strategies with t <= 1: light paths seen through the lens.
std::vector<Strategy> splats(const RenderOptions& options)
{
    std::vector<Strategy> result;
    for (int vertices = 2; vertices <= options.transport.max_depth + 1; ++vertices) {
        result.push_back({.s = vertices, .t = 0});
        result.push_back({.s = vertices - 1, .t = 1});
    }
    return result;
}

std::vector<eval::Variant> make_variants(const RenderOptions& defaults)
{
    std::vector<eval::Variant> variants{{"default", defaults}};
    const auto add = [&](const std::string& name) -> RenderOptions& {
        variants.push_back({name, defaults});
        return variants.back().options;
    };
    add("no splats (t <= 1)").bidirectional.disabled = splats(defaults);
    add("uniform weights").transport.heuristic = Heuristic::uniform;
    add("balance weights").transport.heuristic = Heuristic::balance;
    for (const int edges : {2, 3, 5}) {
        add("roulette from edge " + std::to_string(edges)).transport.rr_start = edges;
    }
    for (const int paths : {2, 4}) {
        add(std::to_string(paths) + " light paths").bidirectional.light_paths = paths;
    }
    return variants;
}

/// Returns a value proportional to the relMSE of a single sample, if relMSE falls with the inverse
/// of their number.
double sample_error(const eval::Score& score)
{
    return score.error.median / score.sample_seconds;
}

void measure(const std::string& file, const Settings& settings)
{
    const Subject subject = load_subject(file, settings.subject);
    const eval::Reference reference = make_reference(subject, settings.subject.reference_samples);
    const std::vector<eval::Variant> variants = make_variants(subject.options);
    const std::vector<eval::Score> scores =
        compare_at_equal_time(subject.bench_scene(), reference, variants, settings.contest);
    const eval::Score& base = scores.front();
    std::printf("  default: %.2e s of CPU time a sample of all pixels, relMSE %.2e after %.1f s\n",
                base.sample_seconds, base.error.median, settings.contest.seconds);
    std::printf("  %-24s %12s %16s %14s\n", "times the default's", "time/sample", "relMSE/sample",
                "at equal time");
    for (std::size_t v = 1; v < variants.size(); ++v) {
        std::printf("  %-24s %12.2f %16.2f %14.2f\n", variants[v].name.c_str(),
                    scores[v].sample_seconds / base.sample_seconds,
                    sample_error(scores[v]) / sample_error(base),
                    scores[v].error.median / base.error.median);
    }
}

}  // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{"Cost and benefit of splats, weights, roulette and light paths in bdpt"};
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
