#include "dataset/dataset.h"

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <list>
#include <map>
#include <new>
#include <nlohmann/json.hpp>

#include "messages/text.h"
#include "options/output_files.h"

namespace bdpt::job {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::string name_of(const fs::path& file, const std::optional<fs::path>& root)
{
    if (!root) {
        const std::string stem = file.stem().string();
        if (stem.empty() || stem == "." || stem == "..") {
            throw OptionError(fmt::format("{}: has no name for a folder", file.string()));
        }
        return stem;
    }
    const fs::path relative =
        fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(*root));
    if (relative.empty() || *relative.begin() == "..") {
        throw OptionError(fmt::format("{}: is not below --root {}", file.string(), root->string()));
    }
    return (relative.parent_path() / relative.stem()).generic_string();
}

bool runs_processes(const DatasetArguments& arguments)
{
    return arguments.isolation == Isolation::on ||
           (arguments.isolation == Isolation::automatic &&
            (arguments.models.size() > 1 || arguments.model_seconds));
}

/// Counts what became of models, and tells it.
class Tally {
public:
    Tally(const DatasetArguments& arguments, Console& console, const OnFailure& on_failure,
          std::size_t all)
        : arguments_(arguments), console_(console), on_failure_(on_failure), all_(all)
    {}

    void done(const DatasetModel& model, const ModelResult& result)
    {
        ++ended_;
        views_ += result.views;
        console_.end_progress();
        if (result.rendered == 0) {
            console_.note(
                fmt::format("{}: {} were there", model.name, counted(result.views, "view")));
        } else {
            console_.note(fmt::format("{}: {} in {:.1f} s", model.name,
                                      counted(result.views, "view"), result.seconds));
        }
        console_.event("model", {{"model", model.name},
                                 {"views", result.views},
                                 {"rendered", result.rendered},
                                 {"seconds", result.seconds}});
    }
    void failed(const DatasetModel& model, int code, const std::string& message)
    {
        ++ended_;
        ++failures_;
        first_failure_ = first_failure_ == 0 ? code : first_failure_;
        console_.end_progress();
        on_failure_(code, message.find(model.file.string()) != std::string::npos
                              ? message
                              : fmt::format("{}: {}", model.file.string(), message));
        console_.event("model", {{"model", model.name}, {"error", message}, {"code", code}});
    }
    void show(const DatasetModel& model, std::size_t views, std::size_t all_views)
    {
        const double share = static_cast<double>(views) / static_cast<double>(all_views);
        const double passed = seconds_since(start_);
        const double fraction = (static_cast<double>(ended_) + share) / static_cast<double>(all_);
        TaskProgress progress{.fraction = fraction, .seconds = passed, .activity = {}};
        if (fraction > 0.0) {
            progress.seconds_left = passed * (1.0 - fraction) / fraction;
        }
        progress.activity = fmt::format("{}, model {} of {}", model.name, ended_ + 1, all_);
        console_.task(progress);
    }
    void tell_all()
    {
        console_.note(fmt::format(
            "wrote {}: {} of {}{}", arguments_.folder.string(), counted(views_, "view"),
            counted(all_ - failures_, "model"),
            failures_ > 0 ? fmt::format("; {} failed (manifest.jsonl)", failures_) : ""));
        console_.event("done", {{"models", all_},
                                {"failed", failures_},
                                {"views", views_},
                                {"outputs", {arguments_.folder.string()}}});
    }
    [[nodiscard]] int exit_code() const { return first_failure_; }

private:
    const DatasetArguments& arguments_;
    Console& console_;
    const OnFailure& on_failure_;
    std::size_t all_;
    std::size_t ended_ = 0;
    std::size_t failures_ = 0;
    std::size_t views_ = 0;
    int first_failure_ = 0;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Returns what `work()` returns; an exception becomes a failure of the model.
template <typename Work>
void guarded(const DatasetArguments& arguments, const DatasetModel& model, Tally& tally,
             const Work& work)
{
    const auto fail = [&](ErrorCode code, const std::string& message) {
        record_failure(arguments, model, static_cast<int>(code), message);
        tally.failed(model, static_cast<int>(code), message);
    };
    try {
        work();
    } catch (const Error& error) {
        fail(error.code(), error.what());
    } catch (const std::bad_alloc&) {
        fail(ErrorCode::out_of_memory, "out of memory");
    }
}

/// A process and what it said.
struct Running {
    const DatasetModel* model = nullptr;
    ModelProcess process;
    bool is_loaded = false;
    std::size_t done = 0;
    std::size_t all = 0;
};

/// Renders each model in a process of its own. The next one is loaded while one is rendered.
class Processes {
public:
    Processes(const DatasetArguments& arguments, Tally& tally, Interrupt& interrupt)
        : arguments_(arguments), tally_(tally), interrupt_(interrupt)
    {}

    void run(const std::vector<DatasetModel>& models)
    {
        std::size_t next = 0;
        while (next < models.size() || !running_.empty()) {
            if (interrupt_.stopped_by() && !std::exchange(stopping_, true)) {
                next = models.size();
                for (const Running& each : running_) {
                    each.process.stop();
                }
            }
            const bool may_start =
                running_.empty() || (running_.size() == 1 && running_.front().is_loaded);
            if (next < models.size() && may_start) {
                start(models[next++]);
                continue;
            }
            wait();
        }
    }

private:
    void start(const DatasetModel& model)
    {
        std::vector<std::string> words = arguments_.words;
        words.push_back("--isolate=false");
        words.emplace_back("--quiet");
        words.emplace_back("--");
        words.push_back(model.file.string());
        guarded(arguments_, model, tally_,
                [&] { running_.push_back({.model = &model, .process = ModelProcess(words)}); });
    }

    void wait()
    {
        std::vector<int> descriptors;
        for (const Running& each : running_) {
            const std::vector<int> own = each.process.descriptors();
            descriptors.insert(descriptors.end(), own.begin(), own.end());
        }
        wait_for_any(descriptors);
        for (auto each = running_.begin(); each != running_.end();) {
            read(*each);
            const std::optional<ModelEnd> end = each->process.end(arguments_.model_seconds);
            if (end) {
                read(*each);
                finish(*each, *end);
                each = running_.erase(each);
            } else {
                ++each;
            }
        }
        if (!running_.empty() && running_.front().all > 0) {
            const Running& first = running_.front();
            tally_.show(*first.model, first.done, first.all);
        }
    }

    static void read(Running& running)
    {
        for (const std::string& line : running.process.new_lines()) {
            running.is_loaded = true;
            if (std::sscanf(line.c_str(), "view %zu %zu", &running.done, &running.all) == 2) {
                continue;
            }
            std::sscanf(line.c_str(), "done %zu %zu", &running.all, &running.done);
        }
    }

    void finish(const Running& running, const ModelEnd& end)
    {
        const DatasetModel& model = *running.model;
        if (end.exit_code == 0) {
            tally_.done(model, {.views = running.all,
                                .rendered = running.done,
                                .seconds = running.process.seconds()});
            return;
        }
        if (stopping_) {
            return;
        }
        constexpr int of_signals = 128;
        int code = end.exit_code;
        std::string message = end.message;
        if (end.timed_out) {
            code = static_cast<int>(ErrorCode::out_of_memory);
            message =
                fmt::format("took longer than {:g} s (--model-time)", *arguments_.model_seconds);
        } else if (code > of_signals) {
            message = fmt::format("its process ended by signal {}{}", code - of_signals,
                                  message.empty() ? "" : ": " + message);
        }
        record_failure(arguments_, model, code, message);
        tally_.failed(model, code, message);
    }

    const DatasetArguments& arguments_;
    Tally& tally_;
    Interrupt& interrupt_;
    std::list<Running> running_;
    bool stopping_ = false;
};

/// Renders a model in a process that another one has started, and tells that one the progress by
/// lines on the standard output.
int run_for_parent(const DatasetArguments& arguments, Interrupt& interrupt)
{
    const DatasetModel model{.file = arguments.models.front(),
                             .name = name_of(arguments.models.front(), arguments.root)};
    const auto put = [](const std::string& line) {
        std::puts(line.c_str());
        std::fflush(stdout);
    };
    const ModelResult result = render_model(
        arguments, model,
        {.loaded = [&] { put("loaded"); },
         .viewed = [&](std::size_t done,
                       std::size_t all) { put(fmt::format("view {} {}", done, all)); }},
        interrupt);
    std::fputs(fmt::format("done {} {}\n", result.views, result.rendered).c_str(), stdout);
    return 0;
}

/// Returns the models of this share, sorted by name. Throws `Error` (usage) for two models of the
/// same name, and for one that is not below --root.
std::vector<DatasetModel> dataset_models(const DatasetArguments& arguments)
{
    std::map<std::string, fs::path> files;
    for (const fs::path& file : arguments.models) {
        const std::string name = name_of(file, arguments.root);
        const auto [known, is_new] = files.try_emplace(name, file);
        if (!is_new && known->second != file) {
            throw OptionError(
                fmt::format("{} and {} have the same name, {}: --root FOLDER names models by their "
                            "paths from a folder",
                            known->second.string(), file.string(), name));
        }
    }
    std::vector<DatasetModel> models;
    std::int64_t number = 0;
    for (const auto& [name, file] : files) {
        if (number++ % arguments.share.count == arguments.share.index) {
            models.push_back({.file = file, .name = name});
        }
    }
    return models;
}

/// Writes what belongs to all models: manifest.jsonl, a line for each view and failure in the order
/// of models and views, and the file of --coco. Throws `Error`.
void write_summary(const DatasetArguments& arguments, const std::vector<DatasetModel>& models)
{
    std::string text;
    std::vector<AnnotatedView> annotated;
    for (const DatasetModel& model : models) {
        const fs::path folder = arguments.folder / model.name;
        for (const ordered_json& line : final_lines(folder)) {
            text += line.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
            const std::vector<std::string> files = files_of(line);
            if (arguments.coco && line.contains("view") && !files.empty()) {
                const std::string& image = files.front();
                const fs::path stem = folder / fs::path(image).stem();
                annotated.push_back({.image = (fs::path(model.name) / image).generic_string(),
                                     .instances = stem.string() + ".instance.png",
                                     .objects = stem.string() + ".object.png",
                                     .mask_names = folder / "masks.json"});
            }
        }
    }
    write_text(arguments.folder / "manifest.jsonl", text);
    if (arguments.coco) {
        write_coco(*arguments.coco, annotated);
    }
}

}  // namespace

int run_dataset(const DatasetArguments& arguments, Console& console, Interrupt& interrupt,
                const OnFailure& on_failure)
{
    if (end_with_dataset()) {
        return run_for_parent(arguments, interrupt);
    }
    DatasetArguments all = arguments;
    all.share = {};
    const std::vector<DatasetModel> summary = dataset_models(all);
    const std::vector<DatasetModel> models = dataset_models(arguments);
    std::error_code error;
    fs::create_directories(arguments.folder, error);
    io::check_writable(arguments.folder / "manifest.jsonl");
    if (arguments.coco) {
        io::check_writable(*arguments.coco);
    }
    Tally tally(arguments, console, on_failure, models.size());
    if (runs_processes(arguments)) {
        interrupt.allow_stop();
        Processes(arguments, tally, interrupt).run(models);
    } else {
        for (const DatasetModel& model : models) {
            if (interrupt.stopped_by()) {
                break;
            }
            guarded(arguments, model, tally, [&] {
                const ModelProgress progress{
                    .loaded = [] {},
                    .viewed = [&](std::size_t done,
                                  std::size_t of) { tally.show(model, done, of); }};
                const ModelResult result = render_model(arguments, model, progress, interrupt);
                if (!result.stopped) {
                    tally.done(model, result);
                }
            });
        }
    }
    write_summary(arguments, summary);
    if (!interrupt.stopped_by()) {
        tally.tell_all();
    }
    return tally.exit_code();
}

}  // namespace bdpt::job
