#include <bdpt/error.h>
#include <bdpt/io/json_value.h>
#include <bdpt/job.h>
#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "machine/machine_limits.h"
#include "messages/console.h"
#include "messages/text.h"
#include "options/option_list.h"
#include "options/output_files.h"
#include "options/render_arguments.h"
#include "run/run_render.h"

namespace bdpt {
namespace {

std::string to_json(std::string_view text)
{
    using nlohmann::json;
    return json(std::string(text)).dump(-1, ' ', false, json::error_handler_t::replace);
}

/// Returns JSON; a text for infinity, as in job files, and for what is no number.
std::string to_json(double value)
{
    const std::string text = fmt::format("{}", value);
    return std::isfinite(value) ? text : to_json(std::string_view(text));
}

template <typename Values>
std::string to_list(const Values& values)
{
    std::string list;
    for (const JobValue& value : values) {
        list += (list.empty() ? "" : ",") + value.json();
    }
    return "[" + list + "]";
}

/// The options of `bdpt render` with the texts of settings.
struct JobOptions : job::RenderOptionList {
    explicit JobOptions(const std::vector<JobSetting>& settings = {})
    {
        for (job::Option& option : list.all()) {
            for (const JobSetting& setting : settings) {
                if (setting.name == to_key(option)) {
                    option.texts = setting.texts;
                    option.job = setting.job;
                }
            }
        }
    }

    /// Returns the options that have a value.
    [[nodiscard]] std::vector<JobSetting> settings() const
    {
        std::vector<JobSetting> settings;
        for (const job::Option& option : list.all()) {
            if (option.given()) {
                settings.push_back(
                    {.name = to_key(option), .texts = option.texts, .job = option.job});
            }
        }
        return settings;
    }
};

/// Passes messages and progress to the callbacks of a program.
class CallbackConsole final : public job::Console {
public:
    explicit CallbackConsole(const JobControl& control) : control_(control) {}

private:
    void show_note(const job::Note& note) override { tell(MessageKind::note, note.text); }
    void show_warning(std::string_view message) override { tell(MessageKind::warning, message); }
    void show_progress(const Progress& progress, const job::Goal& goal) override
    {
        if (control_.on_progress) {
            control_.on_progress({.image = label().index,
                                  .images = label().count,
                                  .fraction = fraction_done(progress, goal),
                                  .seconds_left = time_left(progress, goal),
                                  .render = progress});
        }
    }

    void tell(MessageKind kind, std::string_view message)
    {
        if (control_.on_message) {
            control_.on_message(kind, job::one_line(message));
        }
    }

    const JobControl& control_;
};

/// Stops a render by the token of a program.
class TokenInterrupt final : public job::Interrupt {
public:
    explicit TokenInterrupt(std::stop_token stop) : stop_(std::move(stop)) {}

    void set_outputs(job::PendingOutputs /*outputs*/) override {}
    void allow_stop() override {}
    void forbid_stop() override {}
    [[nodiscard]] std::stop_token stop_token() const override { return stop_; }
    [[nodiscard]] std::optional<std::string> stopped_by() const override
    {
        return stop_.stop_requested() ? std::optional<std::string>("the program") : std::nullopt;
    }
    [[nodiscard]] bool take_checkpoint_request() override { return false; }

private:
    std::stop_token stop_;
};

/// Throws `Error` (usage) if one of `options` names the standard input or output.
void refuse_streams(const job::OptionList& options)
{
    for (const job::Option& option : options.all()) {
        for (const std::string& text : option.texts) {
            if (option.info.is_path && job::is_standard_output(text)) {
                throw Error(ErrorCode::usage,
                            fmt::format("{} \"{}\": the standard input and output belong to the "
                                        "program that runs the job",
                                        to_key(option), text));
            }
        }
    }
}

}  // namespace

JobValue::JobValue(std::nullptr_t /*value*/) : json_("null") {}

JobValue::JobValue(bool value) : json_(value ? "true" : "false") {}

JobValue::JobValue(double value) : json_(to_json(value)) {}

JobValue::JobValue(Quoted value) : json_(to_json(value.text)) {}

JobValue::JobValue(std::initializer_list<JobValue> values) : json_(to_list(values)) {}

JobValue::JobValue(const std::vector<JobValue>& values) : json_(to_list(values)) {}

RenderJob::RenderJob(const std::filesystem::path& scene)
{
    set("file", scene);
}

RenderJob RenderJob::from_file(const std::filesystem::path& file)
{
    JobOptions options;
    job::load_job(file, options.list);
    RenderJob result;
    result.settings_ = options.settings();
    return result;
}

RenderJob RenderJob::from_json(std::string_view text, const std::filesystem::path& folder)
{
    JobOptions options;
    job::load_job(io::JsonValue::parse(text), folder / "job.json", options.list);
    RenderJob result;
    result.settings_ = options.settings();
    return result;
}

RenderJob& RenderJob::set(std::string_view name, const JobValue& value)
{
    JobOptions options(settings_);
    const std::string member = fmt::format("{{{}: {}}}", bdpt::to_json(name), value.json());
    set_options(io::JsonValue::parse(member), options.list);
    settings_ = options.settings();
    return *this;
}

std::string RenderJob::to_json(const std::filesystem::path& folder) const
{
    JobOptions options(settings_);
    return job_text(options.list, folder / "job.json");
}

JobResult run(const RenderJob& job, const JobControl& control)
{
    JobOptions options(job.settings());
    refuse_streams(options.list);
    options.list.store_given();
    const job::RenderArguments asked = checked(options.request, options.list);
    std::vector<std::string> words{"bdpt", "render"};
    const std::vector<std::string> more = to_words(options.list);
    words.insert(words.end(), more.begin(), more.end());
    CallbackConsole console(control);
    TokenInterrupt interrupt(control.stop);
    JobResult result;
    job::within_quota(
        [&] { result = run_render(for_scene(asked, asked.file), words, console, interrupt); });
    return result;
}

}  // namespace bdpt
