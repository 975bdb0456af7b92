#include "options/bench_arguments.h"

#include <bdpt/options/enumerators.h>
#include <bdpt/options/option_fields.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <set>
#include <string_view>
#include <system_error>

#include "options/arguments.h"
#include "options/groups/render_fields.h"
#include "options/values/value_types.h"

namespace bdpt::app {
namespace {

using eval::BenchOptions;

/// Benchmark settings with and without `--quick`.
struct Effort {
    double seconds;
    int pixels;
};
constexpr Effort quick_effort{.seconds = 0.5, .pixels = 9216};
constexpr Effort normal_effort{.seconds = 5.0, .pixels = 36864};

/// Time of each of the two renders of a reference relative to a run: its noise is then a small part
/// of the error of most runs.
constexpr double reference_effort = 12.0;

/// Parses integrators separated by commas; each once.
std::optional<std::vector<IntegratorKind>> parse_integrators(const std::string& text)
{
    std::vector<IntegratorKind> result;
    std::size_t begin = 0;
    while (begin <= text.size()) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const auto kind =
            parse_enumerator<IntegratorKind>(lower_case(text.substr(begin, end - begin)));
        if (!kind) {
            return std::nullopt;
        }
        if (std::find(result.begin(), result.end(), *kind) == result.end()) {
            result.push_back(*kind);
        }
        begin = end + 1;
    }
    return result;
}

/// Returns the stem of the file with characters that all file systems allow, distinct from `taken`.
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

void add_effort(OptionList& options, BenchRequest& request)
{
    BenchOptions& bench = request.arguments.options;
    const ValueType<double> time = duration("a time like 5s or 2m");
    options.section("Effort");
    options.add("--time", "TIME", "CPU time of each run at equal time, like 5s. Default: 5s",
                request.render.seconds, time);
    options.add("--spp", "N",
                "Samples per pixel of each run at equal samples. Default: the largest power of two "
                "for which every integrator stays within --time",
                bench.samples, whole_number(1, std::int64_t{1} << 20));
    options.add("--seeds", "N", "Runs of each integrator. Default: 5", bench.seeds,
                whole_number(1, 10000));
    options.add("--integrators", "LIST",
                "Integrators, comma-separated. Default: pt,nee,mis,lt,bdpt", bench.integrators,
                parsed_by(parse_integrators,
                          "a comma-separated list of pt, nee, mis, lt, bdpt, vcm and auto"));
    options.add("--reference-time", "TIME",
                "CPU time of each of the two renders of the reference. Default: 12 times --time",
                request.reference_seconds, time);
    options.add("--reference", "FILE|DIR",
                "Reference image to use instead of rendering one, or a folder with SCENE.exr",
                bench.reference, any_text());
    options.add("--strategy-depth", "N",
                "Maximum path length, in edges, in the pyramid of strategies; 0: none. Default: 5",
                bench.strategy_depth, whole_number(0, 32));
    options.add_flag("--quick",
                     "Small images and 0.5s per run, for a quick look or CI; --size and --time "
                     "override it",
                     request.quick);
}

}  // namespace

const char* const bench_footer = R"(Examples:
  bdpt bench scenes/cornell-box.gltf scenes/cornell-box-hidden.gltf -o out/bench
  bdpt bench scenes/*.gltf -o out/quick --quick
  bdpt bench room.glb -o out/room --integrators pt,mis,bdpt --time 20s --seeds 9 --env sky.hdr

The output folder gets report.html (for any browser), bench.json, bench.csv, the runs with their
images, and the references. Ctrl-C stops after the current pass; the same command resumes. Times are
CPU time of all threads. docs/bench.md explains the figures.

Exit codes: 0 done, 2 wrong usage (also: the folder holds runs with other options), 3 input not found,
4 invalid input (also: a broken file in the folder), 5 unsupported feature, 6 output cannot be
written (finished runs are kept), 7 out of memory or threads, 129 stopped by SIGHUP,
130 by SIGINT, 143 by SIGTERM.)";

void add_bench_options(OptionList& options, BenchRequest& request)
{
    options.add_repeated("files", "FILE", "The scenes: .gltf or .glb", request.files, any_text())
        .required = true;
    options.section("Output");
    options.add("-o,--output", "DIR", "Output folder", request.arguments.folder, any_text())
        .required = true;
    add_quiet_option(options, request.arguments.printed);
    add_json_option(options, request.arguments.printed,
                    "Print one JSON object per line on stdout: progress, scene, done. With --quiet "
                    "only done and error");
    add_effort(options, request);
    options.section("How to render");
    add_size_option(options, request.render,
                    "Image size. Default: about 37 000 pixels (9 216 with --quick) with the "
                    "camera's aspect ratio");
    add_fields(options, request.render.arguments.options,
               std::array<std::string_view, 3>{"max_depth", "sampler", "threads"});
    add_view_options(options, request.render);
}

BenchArguments checked(const BenchRequest& request, const OptionList& options)
{
    BenchArguments result = request.arguments;
    const Effort effort = request.quick ? quick_effort : normal_effort;
    result.pixels = effort.pixels;
    BenchOptions& bench = result.options;
    bench.seconds = request.render.seconds.value_or(effort.seconds);
    bench.reference_seconds = request.reference_seconds.value_or(reference_effort * bench.seconds);
    RenderRequest render = request.render;
    render.seconds.reset();  // time of a run, which is CPU time
    std::set<std::string> names;
    for (const std::string& file : request.files) {
        render.arguments.file = file;
        result.subjects.push_back(
            {.name = scene_name(file, names), .render = checked(render, options)});
    }
    bench.render = result.subjects.front().render.options;
    result.size = result.subjects.front().render.size;
    std::error_code missing;
    if (bench.reference && result.subjects.size() > 1 &&
        !std::filesystem::is_directory(*bench.reference, missing)) {
        options.reject_value("--reference",
                             "a folder with SCENE.exr for each scene, as there are several scenes");
    }
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
