#include "commands/commands.h"

#include <bdpt/error.h>
#include <bdpt/eval/bench.h>
#include <bdpt/eval/bench_report.h>
#include <bdpt/io/output_file.h>
#include <fmt/chrono.h>
#include <fmt/core.h>

#include <array>
#include <chrono>
#include <ctime>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "messages/text.h"
#include "options/output_files.h"
#include "report/reports.h"
#include "stage/prepared_scene.h"
#include "terminal/console.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

/// A scene of a benchmark.
struct BenchSubject {
    std::string name;        ///< in file names; unique
    RenderArguments render;  ///< arguments for loading and rendering
};

/// Arguments of `bdpt bench`.
struct BenchArguments {
    std::vector<BenchSubject> subjects{};
    std::filesystem::path folder{};
    eval::BenchOptions options{};
    std::optional<Size> size{};
    int pixels = 0;  ///< approximate number per image, if there is no `size`
    Printed printed{};
};

/// Options of `bdpt bench`, as given.
struct BenchRequest {
    std::vector<std::string> files{};
    BenchArguments arguments{};
    std::optional<double> reference_seconds{};
    RenderRequest render{};  ///< options of scenes, views and renders shared with `bdpt render`
    bool quick = false;
};

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

std::optional<std::vector<IntegratorKind>> parse_integrators(const std::string& text)
{
    return parse_each_once<IntegratorKind>(text, [](std::string_view part) {
        return parse_enumerator<IntegratorKind>(lower_case(part));
    });
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
    eval::BenchOptions& bench = request.arguments.options;
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

constexpr const char* bench_footer = R"(Examples:
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
    eval::BenchOptions& bench = result.options;
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

/// Returns the files at the top of the folder: JSON, CSV and the page.
std::array<fs::path, 3> outputs_in(const fs::path& folder)
{
    return {folder / "bench.json", folder / "bench.csv", folder / "report.html"};
}

void make_folder(const fs::path& folder)
{
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) {
        throw Error(ErrorCode::output, fmt::format("{}: {}", folder.string(), failure.message()));
    }
}

std::vector<fs::path> all_files(const BenchArguments& arguments)
{
    const auto outputs = outputs_in(arguments.folder);
    std::vector<fs::path> files(outputs.begin(), outputs.end());
    for (const BenchSubject& subject : arguments.subjects) {
        const auto more = eval::scene_files(arguments.folder, subject.name, arguments.options);
        files.insert(files.end(), more.begin(), more.end());
    }
    return files;
}

void write_all(const eval::BenchRecord& record, const fs::path& folder)
{
    const auto [json, csv, page] = outputs_in(folder);
    write_text(json, eval::bench_json(record));
    write_text(csv, eval::bench_csv(record));
    write_text(page, eval::bench_page(record, folder));
}

std::string time_now()
{
    return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
}

/// Converts planned CPU time to remaining wall-clock time.
class BenchClock {
public:
    BenchClock(Console& console, double seconds_a_scene, std::size_t scenes)
        : console_(&console), seconds_a_scene_(seconds_a_scene), scenes_left_(scenes)
    {}

    void begin_scene(std::string name)
    {
        scene_ = std::move(name);
        worked_before_ += worked_;
        worked_ = 0.0;
        --scenes_left_;
    }
    void tell(const eval::BenchProgress& progress)
    {
        worked_ = progress.worked;
        const double worked = worked_before_ + worked_;
        const double left = progress.left + seconds_a_scene_ * static_cast<double>(scenes_left_);
        const double passed = seconds_since(start_);
        console_->task(
            {.fraction = worked / std::max(worked + left, 1e-9),
             .seconds = passed,
             .seconds_left = worked > 0.0 ? std::optional(passed * left / worked) : std::nullopt,
             .activity = scene_ + ": " + progress.activity});
    }

private:
    Console* console_;
    double seconds_a_scene_;
    std::size_t scenes_left_;
    std::string scene_;
    double worked_before_ = 0.0;
    double worked_ = 0.0;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Returns the result of a scene; none if a stop was requested.
std::optional<eval::SceneResult> run_subject(const BenchSubject& subject,
                                             const BenchArguments& arguments, Console& console,
                                             BenchClock& clock, std::stop_token stop)
{
    const PreparedScene stage = prepare_scene(subject.render);
    check_not_read(all_files(arguments), input_files(subject.render, stage));
    tell_findings(console, stage);
    const Size size = arguments.size.value_or(bench_size(stage.size, arguments.pixels));
    const eval::BenchScene scene{.name = subject.name,
                                 .file = subject.render.file.string(),
                                 .environment = stage.environment_name,
                                 .scene = stage.scene,
                                 .camera = stage.camera,
                                 .width = size.width,
                                 .height = size.height};
    clock.begin_scene(subject.name);
    eval::BenchControl control;
    control.stop = std::move(stop);
    control.on_progress = [&clock](const auto& progress) { clock.tell(progress); };
    control.on_note = [&console](const std::string& note) { console.note(note); };
    auto result = eval::run_scene(scene, arguments.options, arguments.folder, control);
    console.end_progress();
    return result;
}

/// Prints a scene's table on stdout, or an event.
void report_scene(const eval::SceneResult& scene, const BenchArguments& arguments, Console& console)
{
    console.event(
        "scene", {{"name", scene.name}, {"runs", scene.runs.size()}, {"complete", scene.complete}});
    if (arguments.printed.format == Format::text &&
        arguments.printed.verbosity == Verbosity::normal) {
        print_text(bench_text(scene, arguments.options.seconds));
    }
}

/// Runs a benchmark and writes its report. Returns the exit code. Throws `Error`; results of
/// finished runs are written before.
int run_bench(const BenchRequest& request, const OptionList& options,
              const std::vector<std::string>& command)
{
    const BenchArguments arguments = checked(request, options);
    make_folder(arguments.folder);
    const std::vector<fs::path> files = all_files(arguments);
    for (const fs::path& file : outputs_in(arguments.folder)) {
        io::check_writable(file);
    }
    for (const BenchSubject& subject : arguments.subjects) {
        FileSet inputs(input_files(subject.render));
        inputs.add(named_files(subject.render, files));
        if (const auto& reference = arguments.options.reference) {
            inputs.add(*reference);
            inputs.add(*reference / (subject.name + ".exr"));
        }
        check_not_read(files, inputs);
    }
    TerminalConsole console(arguments.printed.format, arguments.printed.verbosity);
    SignalInterrupt interrupt(pending_outputs(files), [&console] {
        console.note("stopping after the current pass; interrupt again to quit at once");
    });
    eval::BenchRecord record{.options = arguments.options,
                             .machine = eval::machine_facts(),
                             .started = time_now(),
                             .command = {},
                             .scenes = {}};
    for (const std::string& word : command) {
        record.command += (record.command.empty() ? "" : " ") + one_line(word);
    }
    BenchClock clock(console, eval::planned_seconds(arguments.options), arguments.subjects.size());
    interrupt.allow_stop();
    std::exception_ptr failure;  // deferred, so that finished scenes are still written
    for (const BenchSubject& subject : arguments.subjects) {
        if (interrupt.stop_token().stop_requested()) {
            break;
        }
        try {
            auto scene = run_subject(subject, arguments, console, clock, interrupt.stop_token());
            if (scene) {
                report_scene(*scene, arguments, console);
                record.scenes.push_back(std::move(*scene));
            }
        } catch (const Error&) {
            failure = std::current_exception();
            break;
        }
    }
    if (failure) {
        console.end_progress();
        try {
            write_all(record, arguments.folder);
        } catch (const Error&) {
            // The first failure is reported; the runs are in separate files.
        }
        std::rethrow_exception(failure);
    }
    write_all(record, arguments.folder);
    const auto [json, csv, page] = outputs_in(arguments.folder);
    console.note(fmt::format("wrote {}, {} and {}", page.string(), json.string(), csv.string()));
    const std::optional<int> signal = interrupt.signal();
    console.event("done", {{"outputs", {page.string(), json.string(), csv.string()}},
                           {"scenes", record.scenes.size()}});
    return signal ? 128 + *signal : 0;
}

}  // namespace

Size bench_size(const Size& whole, int pixels)
{
    const double aspect = static_cast<double>(whole.width) / whole.height;
    const auto side = [](double length) {
        return static_cast<int>(std::clamp(std::round(length), 1.0, 65535.0));
    };
    return {side(std::sqrt(pixels * aspect)), side(std::sqrt(pixels / aspect))};
}

void add_bench_command(Program& program)
{
    add_command<BenchRequest>(program, "bench",
                              "Compare integrators at equal time and equal samples", bench_footer,
                              add_bench_options, run_bench);
}

}  // namespace bdpt::app
