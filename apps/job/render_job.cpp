#include <bdpt/io/json_value.h>
#include <fmt/core.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "job_options.h"
#include "options/job_file.h"

namespace bdpt {
namespace job {

JobOptions::JobOptions(const std::vector<JobSetting>& settings)
{
    add_render_options(list_, request_);
    for (app::Option& option : list_.all()) {
        for (const JobSetting& setting : settings) {
            if (setting.name == to_key(option)) {
                option.texts = setting.texts;
                option.job = setting.job;
            }
        }
    }
}

std::vector<JobSetting> JobOptions::settings() const
{
    std::vector<JobSetting> settings;
    for (const app::Option& option : list_.all()) {
        if (option.given()) {
            settings.push_back({.name = to_key(option), .texts = option.texts, .job = option.job});
        }
    }
    return settings;
}

}  // namespace job

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
    job::JobOptions options({});
    app::load_job(file, options.list());
    RenderJob result;
    result.settings_ = options.settings();
    return result;
}

RenderJob RenderJob::from_json(std::string_view text, const std::filesystem::path& folder)
{
    job::JobOptions options({});
    app::load_job(io::JsonValue::parse(text), folder / "job.json", options.list());
    RenderJob result;
    result.settings_ = options.settings();
    return result;
}

RenderJob& RenderJob::set(std::string_view name, const JobValue& value)
{
    job::JobOptions options(settings_);
    const std::string member = fmt::format("{{{}: {}}}", bdpt::to_json(name), value.json());
    set_options(io::JsonValue::parse(member), options.list());
    settings_ = options.settings();
    return *this;
}

std::string RenderJob::to_json(const std::filesystem::path& folder) const
{
    job::JobOptions options(settings_);
    return job_text(options.list(), folder / "job.json");
}

}  // namespace bdpt
