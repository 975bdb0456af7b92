#include "commands/commands.h"

#include <bdpt/error.h>
#include <bdpt/eval/bench.h>
#include <bdpt/eval/bench_report.h>
#include <bdpt/io/output_file.h>
#include <fmt/core.h>

#include <chrono>
#include <ctime>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>
#include <utility>

#include "options/output_files.h"
#include "report/eval_text.h"
#include "stage/prepared_scene.h"
#include "stage/render_preparation.h"
#include "terminal/interrupt.h"
#include "terminal/text.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

/// Files at the top of the folder.
struct Outputs {
    fs::path json;
    fs::path csv;
    fs::path page;
};

Outputs outputs_in(const fs::path& folder)
{
    return {
        .json = folder / "bench.json", .csv = folder / "bench.csv", .page = folder / "report.html"};
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
    const Outputs outputs = outputs_in(arguments.folder);
    std::vector<fs::path> files{outputs.json, outputs.csv, outputs.page};
    for (const BenchSubject& subject : arguments.subjects) {
        const auto more = eval::scene_files(arguments.folder, subject.name, arguments.options);
        files.insert(files.end(), more.begin(), more.end());
    }
    return files;
}

void write_all(const eval::BenchRecord& record, const fs::path& folder)
{
    const Outputs outputs = outputs_in(folder);
    write_text(outputs.json, eval::bench_json(record));
    write_text(outputs.csv, eval::bench_csv(record));
    write_text(outputs.page, eval::bench_page(record, folder));
}

std::string time_now()
{
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1,
                       utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
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
        const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
        console_->task({.fraction = worked / std::max(worked + left, 1e-9),
                        .seconds = passed.count(),
                        .seconds_left = worked > 0.0 ? std::optional(passed.count() * left / worked)
                                                     : std::nullopt,
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

class BenchSession {
public:
    BenchSession(const BenchArguments& arguments, Console& console, std::stop_token stop)
        : arguments_(arguments),
          console_(console),
          clock_(console, eval::planned_seconds(arguments.options), arguments.subjects.size()),
          stop_(std::move(stop))
    {}

    [[nodiscard]] std::optional<eval::SceneResult> run(const BenchSubject& subject)
    {
        const PreparedScene stage = prepare_scene(subject.render);
        check_not_read(all_files(arguments_), input_files(subject.render, stage));
        tell_findings(console_, stage);
        const Size size = arguments_.size.value_or(bench_size(stage.size, arguments_.pixels));
        const eval::BenchScene scene{.name = subject.name,
                                     .file = subject.render.file.string(),
                                     .environment = stage.environment_name,
                                     .scene = stage.scene,
                                     .camera = stage.camera,
                                     .width = size.width,
                                     .height = size.height};
        clock_.begin_scene(subject.name);
        eval::BenchControl control;
        control.stop = stop_;
        control.on_progress = [this](const auto& progress) { clock_.tell(progress); };
        control.on_note = [this](const std::string& note) { console_.note(note); };
        auto result = eval::run_scene(scene, arguments_.options, arguments_.folder, control);
        console_.end_progress();
        return result;
    }

private:
    const BenchArguments& arguments_;
    Console& console_;
    BenchClock clock_;
    std::stop_token stop_;
};

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

}  // namespace

int run_bench(const BenchArguments& arguments, const std::vector<std::string>& command)
{
    make_folder(arguments.folder);
    const std::vector<fs::path> files = all_files(arguments);
    for (const fs::path& file : std::span(files).first(3)) {
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
    BenchSession session(arguments, console, interrupt.stop_token());
    interrupt.allow_stop();
    std::exception_ptr failure;  // deferred, so that finished scenes are still written
    for (const BenchSubject& subject : arguments.subjects) {
        if (interrupt.stop_token().stop_requested()) {
            break;
        }
        try {
            auto scene = session.run(subject);
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
    const Outputs outputs = outputs_in(arguments.folder);
    console.note(fmt::format("wrote {}, {} and {}", outputs.page.string(), outputs.json.string(),
                             outputs.csv.string()));
    const std::optional<int> signal = interrupt.signal();
    console.event(
        "done", {{"outputs", {outputs.page.string(), outputs.json.string(), outputs.csv.string()}},
                 {"scenes", record.scenes.size()}});
    return signal ? 128 + *signal : 0;
}

}  // namespace bdpt::app
