#include "options/bench_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <string_view>
#include <system_error>

#include "options/arguments.h"
#include "options/values/value_checks.h"

namespace bdpt::app {
namespace {

using eval::BenchOptions;

constexpr const char* bench_examples = R"(Examples:
  bdpt bench scenes/cornell-box.gltf scenes/cornell-box-hidden.gltf -o out/bench
  bdpt bench scenes/*.gltf -o out/quick --quick
  bdpt bench room.glb -o out/room --integrators pt,mis,bdpt --time 20s --seeds 9 --env sky.hdr

The output folder gets report.html (for any browser), bench.json, bench.csv, the runs with their
images, and the references. Ctrl-C stops after the current pass; the same command resumes. Times are
CPU time of all threads. docs/bench.md explains the figures.

Exit codes: 0 done, 2 wrong usage (also: the folder holds runs with other options), 3 input not found,
4 invalid input (also: a file in the folder that is broken), 5 unsupported feature, 6 output cannot be
written (finished runs are kept), 7 out of memory or threads, 129 stopped by SIGHUP,
130 by SIGINT, 143 by SIGTERM.)";

/// What `--quick` chooses, and what is chosen without.
struct Effort {
    double seconds;
    int pixels;
};
constexpr Effort quick_effort{.seconds = 0.5, .pixels = 9216};
constexpr Effort normal_effort{.seconds = 5.0, .pixels = 36864};

/// Time of each of the two renders of a reference, in times that of a run: its noise is then a
/// small part of the error of most runs.
constexpr double reference_effort = 12.0;

double to_seconds(const char* option, const std::optional<std::string>& word, double otherwise)
{
    if (!word) {
        return otherwise;
    }
    const std::optional<double> seconds = parse_duration(*word);
    if (!seconds) {
        reject(option, *word, "a time like 5s or 2m");
    }
    return *seconds;
}

std::vector<IntegratorKind> to_integrators(const std::string& words)
{
    std::vector<IntegratorKind> result;
    std::size_t begin = 0;
    while (begin <= words.size()) {
        const std::size_t end = std::min(words.find(',', begin), words.size());
        const auto kind =
            eval::parse_integrator(std::string_view(words).substr(begin, end - begin));
        if (!kind) {
            reject("--integrators", words,
                   "pt, nee, mis, lt, bdpt, vcm or auto, with commas between");
        }
        if (std::find(result.begin(), result.end(), *kind) == result.end()) {
            result.push_back(*kind);
        }
        begin = end + 1;
    }
    return result;
}

/// The stem of the file with what may be in names of files everywhere, and in none of `taken`.
std::string scene_name(const std::filesystem::path& file, std::set<std::string>& taken)
{
    std::string stem = file.stem().string();
    std::replace_if(
        stem.begin(), stem.end(),
        [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_'; }, '-');
    stem = stem.empty() ? "scene" : stem;
    std::string name = stem;
    for (int number = 2; !taken.insert(name).second; ++number) {
        name = fmt::format("{}-{}", stem, number);
    }
    return name;
}

void add_effort(CLI::App& command, BenchWords& words)
{
    const auto group = "Effort";
    command
        .add_option("--time", words.time,
                    "CPU time of each run at equal time, like 5s. Default: 5s")
        ->type_name("TIME")
        ->group(group);
    command
        .add_option("--spp", words.samples,
                    "Samples per pixel of each run at equal samples. Default: the greatest power "
                    "of two for which every integrator stays within --time")
        ->check(whole_number(1, std::int64_t{1} << 20))
        ->type_name("N")
        ->group(group);
    command.add_option("--seeds", words.seeds, "Runs of each integrator. Default: 5")
        ->check(whole_number(1, 10000))
        ->type_name("N")
        ->group(group);
    command
        .add_option("--integrators", words.integrators,
                    "Integrators, comma-separated. Default: pt,nee,mis,lt,bdpt")
        ->type_name("LIST")
        ->group(group);
    command
        .add_option(
            "--reference-time", words.reference_time,
            "CPU time of each of the two renders that make the reference. Default: 12 times --time")
        ->type_name("TIME")
        ->group(group);
    command
        .add_option("--reference", words.reference,
                    "Reference image to use instead of rendering one, or a folder with SCENE.exr")
        ->type_name("FILE|DIR")
        ->group(group);
    command
        .add_option("--strategy-depth", words.strategy_depth,
                    "Longest paths, in edges, in the pyramid of strategies; 0 for none. Default: 5")
        ->check(whole_number(0, 32))
        ->type_name("N")
        ->group(group);
    command
        .add_flag(
            "--quick", words.quick,
            "Small images and 0.5s a run, for a quick look or CI; --size and --time override it")
        ->group(group);
}

void add_image_options(CLI::App& command, RenderWords& words)
{
    const auto group = "How to render";
    command
        .add_option("--size", words.size,
                    "Image size. Default: about 37 000 pixels (9 216 with --quick) with the "
                    "camera's aspect ratio")
        ->type_name("WxH")
        ->group(group);
    command
        .add_option("--max-depth", words.transport.max_depth, "Longest path, in edges. Default: 8")
        ->check(whole_number(1, 4096))
        ->type_name("N")
        ->group(group);
    command
        .add_option("--sampler", words.sampler, "Random numbers: sobol (default) or independent")
        ->check(one_of({"sobol", "independent"}))
        ->type_name("sobol|independent")
        ->group(group);
    command
        .add_option(
            "--threads", words.threads,
            "Number of threads. Default: 0, one for each processor that the process may use")
        ->check(whole_number(0, 4096))
        ->type_name("N")
        ->group(group);
}

}  // namespace

void add_bench_options(CLI::App& command, BenchWords& words)
{
    command.add_option("files", words.files, "The scenes: .gltf or .glb")
        ->required()
        ->type_name("FILE");
    const auto group = "Output";
    command.add_option("-o,--output", words.output, "Output folder")
        ->required()
        ->type_name("DIR")
        ->group(group);
    command.add_flag("-q,--quiet", words.quiet, "Print errors only")->group(group);
    command
        .add_flag("--json", words.json,
                  "Print one JSON object per line on stdout: progress, scene, done. With --quiet "
                  "only done and error")
        ->group(group);
    add_effort(command, words);
    add_image_options(command, words.render);
    add_view_options(command, words.render);
    command.footer(bench_examples);
}

BenchArguments understand(const BenchWords& words)
{
    BenchArguments result;
    const Effort effort = words.quick ? quick_effort : normal_effort;
    result.folder = words.output;
    result.pixels = effort.pixels;
    BenchOptions& options = result.options;
    if (words.integrators) {
        options.integrators = to_integrators(*words.integrators);
    }
    options.seconds = to_seconds("--time", words.time, effort.seconds);
    options.samples = words.samples;
    options.seeds = words.seeds.value_or(options.seeds);
    options.reference_seconds =
        to_seconds("--reference-time", words.reference_time, reference_effort * options.seconds);
    options.strategy_depth = words.strategy_depth.value_or(options.strategy_depth);
    std::set<std::string> names;
    for (const std::string& file : words.files) {
        RenderWords render = words.render;
        render.file = file;
        result.subjects.push_back({.name = scene_name(file, names), .render = understand(render)});
    }
    options.render = result.subjects.front().render.options;
    result.size = result.subjects.front().render.size;
    if (words.reference) {
        options.reference = *words.reference;
        std::error_code missing;
        if (result.subjects.size() > 1 &&
            !std::filesystem::is_directory(*words.reference, missing)) {
            reject("--reference", *words.reference,
                   "a folder with SCENE.exr for each scene, as there are several scenes");
        }
    }
    result.format = words.json ? Format::json : Format::text;
    result.verbosity = words.quiet ? Verbosity::quiet : Verbosity::normal;
    return result;
}

Size bench_size(const Size& whole, int pixels)
{
    const double aspect = static_cast<double>(whole.width) / whole.height;
    const auto side = [](double length) {
        return static_cast<int>(std::clamp(std::round(length), 1.0, 65535.0));
    };
    return {side(std::sqrt(pixels * aspect)), side(std::sqrt(pixels / aspect))};
}

}  // namespace bdpt::app
