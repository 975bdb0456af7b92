#include "options/option_list.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "options/output_files.h"
#include "options/value_types.h"

namespace bdpt::job {
namespace {

namespace fs = std::filesystem;
using io::JsonValue;
using nlohmann::ordered_json;

constexpr const char* format_key = "bdpt_job";
constexpr const char* schema_key = "$schema";  // for editors

bool is_path(const Option& option, const std::string& text)
{
    return option.info.is_path && !text.empty() && !is_among(option.info.words, text);
}

bool is_number(const Option& option)
{
    return option.info.json == JsonType::number || option.info.json == JsonType::whole_number;
}

/// Returns the command-line text for `value`.
std::string to_text(const Option& option, const JsonValue& value)
{
    if (option.info.separator != '\0' && value.is_array()) {
        std::string text;
        for (const JsonValue& element : value.elements()) {
            text +=
                (text.empty() ? "" : std::string(1, option.info.separator)) + element.scalar_text();
        }
        return text;
    }
    const std::string text = value.scalar_text();
    // A number in quotes is an error, except infinity, which JSON cannot express otherwise.
    if (is_number(option) && value.is_text() && text != "inf") {
        value.fail_expecting(option.expected);
    }
    return text;
}

/// Returns a path of a job relative to the working directory.
std::string resolved_path(const std::string& path, const fs::path& folder)
{
    return fs::path(path).is_absolute() ? path : (folder / path).string();
}

/// Checks `value` and stores it into `option`.
void take(Option& option, const JsonValue& value, const fs::path& folder)
{
    const auto add = [&](const JsonValue& element) {
        std::string text = option.spelled(to_text(option, element));
        if (is_path(option, text)) {
            text = resolved_path(text, folder);
        }
        if (!option.store(text)) {
            element.fail_expecting(option.expected);
        }
        option.texts.push_back(std::move(text));
    };
    if (option.repeats && value.is_array()) {
        for (const JsonValue& element : value.elements()) {
            add(element);
        }
    } else {
        add(value);
    }
}

/// Returns the option with the name `key` that may be stated in places like `where`, or null.
Option* find_option(OptionList& options, const std::string& key, StatedIn where)
{
    for (Option& option : options.all()) {
        if (option.uses.stated_in <= where && to_key(option) == key) {
            return &option;
        }
    }
    return nullptr;
}

[[noreturn]] void fail_unknown(const OptionList& options, const std::string& key,
                               const JsonValue& value)
{
    std::vector<std::string> keys;
    for (const Option& option : options.all()) {
        if (option.is_for_jobs()) {
            keys.push_back(to_key(option));
        }
    }
    const std::optional<std::string> meant = closest(key, keys);
    value.fail("is not an option of a job" +
               (meant ? fmt::format(" (did you mean \"{}\"?)", *meant) : ""));
}

/// Throws `Error` if the given `scene` is a job; `members` contain it.
void check_scene(const Option& scene, const JsonValue& members)
{
    if (is_job(scene.texts.back())) {
        members.at("file").fail_expecting("a scene, .gltf or .glb");
    }
}

void check_format(const JsonValue& job)
{
    if (!job.is_object() || !job.has(format_key)) {
        job.fail(fmt::format("is not a job: it has no \"{}\"", format_key));
    }
    const auto format = job.at(format_key).number<std::int64_t>();
    if (format != job_format) {
        job.at(format_key)
            .fail(fmt::format("has format {}{}; this program reads format {}", format,
                              format > job_format ? ", of a newer bdpt" : "", job_format));
    }
}

/// Returns `text`, accepted by the option, as JSON; paths are relative to `folder`.
ordered_json to_json(const Option& option, const std::string& text, const fs::path& folder)
{
    if (is_path(option, text)) {
        const fs::path path = text;
        return path.is_absolute()
                   ? text
                   : fs::weakly_canonical(fs::absolute(path)).lexically_relative(folder).string();
    }
    if (option.is_flag() && (text == "true" || text == "false")) {
        return text == "true";
    }
    if (option.info.json == JsonType::whole_number) {
        if (const auto number = parse_number<std::uint64_t>(text)) {  // none of them is negative
            return *number;
        }
    }
    if (option.info.json == JsonType::number || option.info.may_be_number) {
        if (const std::optional<double> number = parse_double(text)) {
            return *number;
        }
    }
    return text;
}

/// Returns the JSON schema of the values of `option`.
ordered_json make_schema(const Option& option)
{
    const ValueInfo& info = option.info;
    ordered_json schema = ordered_json::object();
    if (is_number(option)) {
        schema["type"] = info.json == JsonType::number ? "number" : "integer";
        if (std::isfinite(info.range.low)) {
            schema[info.range.low_is_excluded ? "exclusiveMinimum" : "minimum"] = info.range.low;
        }
        if (std::isfinite(info.range.high)) {
            schema["maximum"] = info.range.high;
        }
    } else if (option.is_flag()) {
        schema["type"] = info.words.size() > 2 || info.words.empty()
                             ? ordered_json{"boolean", "string"}
                             : ordered_json("boolean");
    } else if (!info.words.empty() && !info.is_path) {
        schema["enum"] = info.words;
        for (const std::string& word : info.words) {
            if (word.find_first_not_of("0123456789") == std::string::npos) {
                schema["enum"].push_back(std::stoi(word));  // the option may also be a number
            }
        }
    } else if (info.may_be_number) {
        schema["type"] = {"number", "string"};
    } else if (info.separator != '\0') {
        schema["type"] = {"string", "number", "array"};
        schema["items"] = {{"type", "number"}};
    } else {
        schema["type"] = "string";
    }
    if (option.repeats) {
        schema = {{"type", "array"}, {"items", std::move(schema)}};
    }
    schema["description"] = option.help;
    return schema;
}

}  // namespace

std::string to_key(const Option& option)
{
    std::string key = option.name();
    key.erase(0, key.find_first_not_of('-'));
    std::replace(key.begin(), key.end(), '-', '_');
    return key;
}

bool is_job(const fs::path& file)
{
    return has_extension(file, ".json");
}

void load_job(const fs::path& file, OptionList& options)
{
    load_job(JsonValue::read(file), file, options);
}

void load_job(const JsonValue& job, const fs::path& file, OptionList& options)
{
    check_format(job);
    Option& scene = *find_option(options, "file", StatedIn::own_folder);
    scene.texts.clear();
    std::vector<const Option*> given;
    for (const Option& option : options.all()) {
        if (option.given()) {
            given.push_back(&option);
        }
    }
    for (const auto& [key, value] : job.members()) {
        if (key == format_key || key == schema_key) {
            continue;
        }
        Option* option = find_option(options, key, StatedIn::own_folder);
        if (option == nullptr) {
            fail_unknown(options, key, value);
        }
        // Values that the command line overrides are checked, too.
        std::vector<std::string> before = option->texts;
        take(*option, job.at(key), file.parent_path());
        if (is_among(given, option)) {
            option->texts = std::move(before);
        } else {
            option->job = file;
        }
    }
    if (!scene.given()) {
        job.fail("has no \"file\", the scene");
    }
    check_scene(scene, job);
    options.store_given();
}

void set_options(const JsonValue& members, OptionList& options)
{
    for (const auto& [key, value] : members.members()) {
        Option* option = find_option(options, key, StatedIn::programs);
        if (option == nullptr) {
            fail_unknown(options, key, value);
        }
        option->texts.clear();
        option->job.clear();
        const bool is_scene = key == "file";
        if (is_scene || !value.is_null()) {
            take(*option, members.at(key), "");
        }
        if (is_scene) {
            check_scene(*option, members);
        }
    }
}

std::string job_text(const OptionList& options, const fs::path& file)
{
    const fs::path folder = fs::weakly_canonical(fs::absolute(file)).parent_path();
    ordered_json job{{format_key, job_format}};
    for (const Option& option : options.all()) {
        if (!option.is_for_jobs() || !option.given()) {
            continue;
        }
        const std::string key = to_key(option);
        if (!option.repeats) {
            job[key] = to_json(option, option.texts.back(), folder);
            continue;
        }
        job[key] = ordered_json::array();
        for (const std::string& text : option.texts) {
            job[key].push_back(to_json(option, text, folder));
        }
    }
    return job.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string job_schema(const OptionList& options)
{
    ordered_json members{
        {format_key, {{"const", job_format}, {"description", "Format of the file"}}},
        {schema_key, {{"type", "string"}}}};
    for (const Option& option : options.all()) {
        if (option.is_for_jobs()) {
            members[to_key(option)] = make_schema(option);
        }
    }
    const ordered_json schema{
        {schema_key, "https://json-schema.org/draft/2020-12/schema"},
        {"title", "A job of bdpt render"},
        {"description",
         "The options of bdpt render, with _ for -. Paths are relative to the file."},
        {"type", "object"},
        {"properties", std::move(members)},
        {"required", {format_key, "file"}},
        {"additionalProperties", false}};
    return schema.dump(2) + "\n";
}

std::vector<std::string> to_words(const OptionList& options)
{
    std::vector<std::string> words;
    for (const Option& option : options.all()) {
        if (!option.given()) {
            continue;
        }
        if (option.is_argument()) {
            words.push_back(option.texts.back());
        } else if (!option.repeats) {
            words.push_back(option.word());
        } else {
            for (const std::string& text : option.texts) {
                words.push_back(option.name() + "=" + text);
            }
        }
    }
    return words;
}

void give_words(const std::vector<std::string>& words, OptionList& options)
{
    for (const std::string& word : words) {
        const bool is_argument = !word.starts_with("--");
        const std::size_t equals = is_argument ? std::string::npos : word.find('=');
        const std::string name = word.substr(0, equals);
        const auto found =
            std::find_if(options.all().begin(), options.all().end(), [&](const Option& option) {
                return is_argument ? option.is_argument() && (option.repeats || !option.given())
                                   : option.name() == name;
            });
        if (found == options.all().end()) {
            throw OptionError(fmt::format("unknown option {}", name));
        }
        found->texts.push_back(is_argument                   ? word
                               : equals == std::string::npos ? "true"
                                                             : word.substr(equals + 1));
    }
    options.store_given();
}

}  // namespace bdpt::job
