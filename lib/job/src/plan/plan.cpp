#include "plan/plan.h"

#include <bdpt/error.h>
#include <bdpt/io/json_value.h>
#include <bdpt/version.h>
#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "messages/text.h"
#include "options/output_files.h"
#include "options/render_arguments.h"

namespace bdpt::job {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view part_start = "task-";
constexpr std::string_view frame_place = ".####";
constexpr std::string_view camera_suffix = ".{camera}";
constexpr std::string_view part_end = ".part.exr";

/// Returns the name of the part of task `task` of `count`: with #### and {camera} if images like
/// `image` have a frame and a camera.
std::string part_name(const PlanImage& image, std::size_t task, std::size_t count)
{
    const std::size_t digits = std::to_string(count - 1).size();
    return fmt::format("{}{:0{}}{}{}{}", part_start, task, digits, image.frame ? frame_place : "",
                       image.camera ? camera_suffix : "", part_end);
}

/// A run of consecutive numbers.
struct Run {
    std::size_t first = 0;
    std::size_t last = 0;
};

std::vector<Run> find_runs(const std::vector<std::size_t>& numbers)
{
    std::vector<Run> runs;
    for (const std::size_t number : numbers) {
        if (!runs.empty() && runs.back().last + 1 == number) {
            runs.back().last = number;
        } else {
            runs.push_back({.first = number, .last = number});
        }
    }
    return runs;
}

/// Returns "frame 3", "camera left" or "frame 3 of camera left".
std::string image_text(const PlanImage& image)
{
    const std::string camera = image.camera ? "camera " + one_line(*image.camera) : "";
    if (!image.frame) {
        return camera;
    }
    return fmt::format("frame {}{}{}", *image.frame, camera.empty() ? "" : " of ", camera);
}

}  // namespace

SampleSet collect_samples(const Plan& plan)
{
    // Sorted, so that each range is added at the end.
    std::vector<SampleRange> ranges;
    for (const PlanTask& task : plan.tasks) {
        ranges.push_back(task.samples);
    }
    std::sort(ranges.begin(), ranges.end(),
              [](const SampleRange& a, const SampleRange& b) { return a.begin < b.begin; });
    SampleSet result;
    for (const SampleRange& range : ranges) {
        result.add(range);
    }
    return result;
}

bool is_sequence(const Plan& plan)
{
    return plan.images.front().seed.has_value();
}

std::vector<std::string> collect_cameras(const Plan& plan)
{
    std::vector<std::string> cameras;
    for (const PlanImage& image : plan.images) {
        if (image.camera && image.frame == plan.images.front().frame) {
            cameras.push_back(*image.camera);
        }
    }
    return cameras;
}

fs::path expand_pattern(const fs::path& pattern, const PlanImage& image)
{
    const fs::path file = image.frame ? with_number(pattern, *image.frame) : pattern;
    return image.camera ? with_camera(file, *image.camera) : file;
}

std::vector<std::vector<fs::path>> parts_by_image(const Plan& plan)
{
    std::vector<std::vector<fs::path>> parts(plan.images.size());
    for (const PlanTask& task : plan.tasks) {
        for (std::size_t i = 0; i < task.images; ++i) {
            const std::size_t image = task.first_image + i;
            parts[image].push_back(expand_pattern(task.part, plan.images[image]));
        }
    }
    return parts;
}

std::vector<std::size_t> tasks_for(const Plan& plan, const std::vector<SampleSet>& missing)
{
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < plan.tasks.size(); ++i) {
        const PlanTask& task = plan.tasks[i];
        const auto begin = missing.begin() + static_cast<std::ptrdiff_t>(task.first_image);
        const SampleSet own(task.samples);
        if (std::any_of(begin, begin + static_cast<std::ptrdiff_t>(task.images),
                        [&](const SampleSet& samples) { return !samples.overlap(own).empty(); })) {
            result.push_back(i);
        }
    }
    return result;
}

ImageLabel make_label(const Plan& plan, std::size_t image)
{
    return {.frame = plan.images[image].frame,
            .camera = plan.images[image].camera,
            .index = image,
            .count = plan.images.size()};
}

std::string images_text(const Plan& plan, const std::vector<std::size_t>& images)
{
    constexpr std::size_t max_runs = 8;
    const std::vector<Run> runs = find_runs(images);
    std::string text;
    for (std::size_t i = 0; i < std::min(runs.size(), max_runs); ++i) {
        text += (text.empty() ? "" : ", ") + image_text(plan.images[runs[i].first]);
        if (runs[i].first != runs[i].last) {
            text += " to " + image_text(plan.images[runs[i].last]);
        }
    }
    return runs.size() > max_runs ? text + ", ..." : text;
}

std::string numbers_text(const std::vector<std::size_t>& numbers)
{
    std::string result;
    for (const Run& run : find_runs(numbers)) {
        result += result.empty() ? "" : ",";
        result += run.first == run.last ? fmt::format("{}", run.first)
                                        : fmt::format("{}-{}", run.first, run.last);
    }
    return result;
}

namespace {

constexpr std::int64_t best_unit = 64;  // samples

std::int64_t divided_up(std::int64_t a, std::int64_t b)
{
    return a / b + (a % b != 0 ? 1 : 0);
}

}  // namespace

std::vector<SampleRange> split_samples(SampleRange samples, std::int64_t parts, std::int64_t least)
{
    std::int64_t unit = best_unit;
    const auto blocks = [&] { return divided_up(samples.end, unit) - samples.begin / unit; };
    while (blocks() < parts && unit > least) {
        unit /= 2;
    }
    const std::int64_t first = samples.begin / unit;
    const auto boundary = [&](std::int64_t part) {
        return std::clamp((first + part * blocks() / parts) * unit, samples.begin, samples.end);
    };
    std::vector<SampleRange> result;
    for (std::int64_t part = 0; part < parts; ++part) {
        result.push_back({.begin = boundary(part), .end = boundary(part + 1)});
    }
    return result;
}

std::int64_t parts_of_time(SampleRange samples, double seconds, double seconds_per_sample,
                           double seconds_to_start, std::int64_t least)
{
    const std::int64_t total = samples.end - samples.begin;
    const double fitting = std::floor((seconds - seconds_to_start) / seconds_per_sample);
    auto count = static_cast<std::int64_t>(std::clamp(fitting, 1.0, static_cast<double>(total)));
    count = std::clamp(count, std::min(least, total), total);
    if (count < total) {
        count = count >= best_unit
                    ? count / best_unit * best_unit
                    : static_cast<std::int64_t>(std::bit_floor(static_cast<std::uint64_t>(count)));
    }
    return divided_up(total, count);
}

std::vector<PlanTask> split_plan(const Plan& plan, SampleRange samples, std::int64_t count,
                                 std::int64_t least)
{
    std::vector<PlanTask> tasks;
    const auto images = static_cast<std::int64_t>(plan.images.size());
    const auto add = [&](std::int64_t first, std::int64_t end, SampleRange range) {
        tasks.push_back({.first_image = static_cast<std::size_t>(first),
                         .images = static_cast<std::size_t>(end - first),
                         .samples = range,
                         .part = part_name(plan.images.front(), tasks.size(),
                                           static_cast<std::size_t>(count))});
    };
    for (std::int64_t task = 0; task < count && count <= images; ++task) {
        add(task * images / count, (task + 1) * images / count, samples);
    }
    for (std::int64_t image = 0; image < images && count > images; ++image) {
        const std::int64_t ranges = count / images + (image < count % images ? 1 : 0);
        for (const SampleRange& range : split_samples(samples, ranges, least)) {
            add(image, image + 1, range);
        }
    }
    return tasks;
}

std::int64_t tasks_of_time(std::size_t images, SampleRange samples, double seconds,
                           double seconds_per_sample, double seconds_to_start, std::int64_t least)
{
    const auto count = static_cast<std::int64_t>(images);
    const std::int64_t parts =
        parts_of_time(samples, seconds, seconds_per_sample, seconds_to_start, least);
    if (parts > 1 || count == 1) {
        return parts * count;
    }
    const double one =
        seconds_to_start + seconds_per_sample * static_cast<double>(samples.end - samples.begin);
    const double fitting = std::clamp(std::floor(seconds / one), 1.0, static_cast<double>(count));
    return static_cast<std::int64_t>(std::ceil(static_cast<double>(count) / fitting));
}

namespace {

/// Removes `start` from the front of `text`; returns false if it is not there.
bool take(std::string_view& text, std::string_view start)
{
    const bool is_there = text.starts_with(start);
    text.remove_prefix(is_there ? start.size() : 0);
    return is_there;
}

/// Tests whether `name` is the name of a part of some task.
bool is_part_of_task(std::string_view name)
{
    if (!take(name, part_start)) {
        return false;
    }
    const std::size_t digits = std::min(name.find_first_not_of("0123456789"), name.size());
    name.remove_prefix(digits);
    take(name, frame_place);
    take(name, camera_suffix);
    return digits > 0 && name == part_end;
}

}  // namespace

fs::path file_of_plan(const fs::path& name, const fs::path& folder)
{
    const fs::path file = folder / name;
    std::error_code ignored;
    if (fs::is_symlink(file, ignored)) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("{}: is a symbolic link; the files of a plan must be in its folder",
                                file.string()));
    }
    return file;
}

namespace {

using nlohmann::ordered_json;

std::vector<std::string> to_texts(const std::vector<fs::path>& paths)
{
    std::vector<std::string> result;
    for (const fs::path& path : paths) {
        result.push_back(path.string());
    }
    return result;
}

ordered_json path_or_null(const std::optional<fs::path>& path)
{
    return path ? ordered_json(path->string()) : ordered_json();
}

ordered_json to_json(const PlanImage& image)
{
    ordered_json json = ordered_json::object();
    if (image.frame) {
        json["frame"] = *image.frame;
    }
    if (image.camera) {
        json["camera"] = *image.camera;
    }
    if (image.seed) {
        json["seed"] = *image.seed;
    }
    return json;
}

ordered_json to_json(const PlanTask& task)
{
    const SampleRange images{.begin = static_cast<std::int64_t>(task.first_image),
                             .end = static_cast<std::int64_t>(task.first_image + task.images)};
    return {{"images", SampleSet(images).text()},
            {"samples", SampleSet(task.samples).text()},
            {"part", task.part.string()}};
}

ordered_json to_json(const Identity& identity)
{
    // Names are unique; a search for each would take quadratic time.
    ordered_json::object_t members;
    for (const auto& [name, value] : identity.components) {
        members.emplace_back(name, value);
    }
    return members;
}

}  // namespace

std::string to_text(const Plan& plan)
{
    ordered_json json{{"format", plan_format},
                      {"version", BDPT_VERSION},
                      {"scene", plan.scene.string()},
                      {"environment", path_or_null(plan.environment)},
                      {"render", plan.render_options},
                      {"merge", plan.merge_options},
                      {"outputs", to_texts(plan.outputs)},
                      {"strategies", path_or_null(plan.strategies)},
                      {"engine_files", to_texts(plan.engine_files)},
                      {"images", ordered_json::array()},
                      {"tasks", ordered_json::array()},
                      {"files", to_json(plan.files)},
                      {"identity", to_json(plan.identity)}};
    if (plan.volume) {
        json["volume"] = plan.volume->string();
    }
    if (plan.rates) {
        json["rates"] = plan.rates->string();
    }
    for (const PlanImage& image : plan.images) {
        json["images"].push_back(to_json(image));
    }
    std::size_t parts = 0;
    for (const PlanTask& task : plan.tasks) {
        json["tasks"].push_back(to_json(task));
        parts += task.images;
    }
    try {
        std::string text = json.dump(2) + "\n";
        if (parts > max_planned_parts || text.size() > io::JsonValue::max_bytes) {
            throw Error(ErrorCode::usage,
                        fmt::format("a plan of {} parts is too large: the limits are {} parts and "
                                    "{} bytes of text",
                                    parts, max_planned_parts, io::JsonValue::max_bytes));
        }
        return text;
    } catch (const ordered_json::type_error&) {
        throw Error(ErrorCode::usage,
                    "a plan must be UTF-8: the name of a file or a value of an option is not");
    }
}

namespace {

using io::JsonValue;

std::vector<fs::path> read_paths(const JsonValue& json)
{
    const std::vector<std::string> texts = json.texts();
    return {texts.begin(), texts.end()};
}

std::optional<fs::path> read_optional_path(const JsonValue& json, const char* key)
{
    if (!json.has(key) || json.at(key).is_null()) {
        return std::nullopt;
    }
    return json.at(key).text();
}

/// Reads words of a command, which may come from anybody: only `allowed` options are accepted.
std::vector<std::string> read_words(const JsonValue& json, const std::vector<std::string>& allowed)
{
    std::vector<std::string> words;
    for (const JsonValue& element : json.elements()) {
        words.push_back(element.text());
        const std::string& word = words.back();
        const std::string name = word.substr(0, word.find('='));
        const bool names_file = name == "--env" && word != "--env=none" && word != "--env=default";
        if (!is_among(allowed, name) || names_file) {
            element.fail_expecting("an option that a plan may have");
        }
    }
    return words;
}

SampleRange read_range(const JsonValue& json)
{
    const auto set = SampleSet::parse(json.text());
    if (!set || set->ranges().size() != 1) {
        json.fail_expecting("a range, like 0:64");
    }
    return set->ranges().front();
}

PlanTask read_task(const JsonValue& json, std::size_t images)
{
    const SampleRange range = read_range(json.at("images"));
    const auto first = static_cast<std::size_t>(range.begin);
    const auto end = static_cast<std::size_t>(range.end);
    if (end > images) {
        json.at("images").fail_expecting(fmt::format("a range of the {} images", images));
    }
    PlanTask task{.first_image = first,
                  .images = end - first,
                  .samples = read_range(json.at("samples")),
                  .part = json.at("part").text()};
    if (!is_part_of_task(task.part.string())) {
        json.at("part").fail_expecting("a name like task-0.part.exr");
    }
    return task;
}

PlanImage read_image(const JsonValue& json)
{
    PlanImage image;
    if (json.has("frame")) {
        image.frame = json.at("frame").number<int>();
    }
    if (json.has("camera")) {
        image.camera = json.at("camera").text();
    }
    if (json.has("seed")) {
        image.seed = json.at("seed").number<std::uint64_t>();
    }
    return image;
}

Identity read_identity(const JsonValue& json)
{
    Identity identity;
    for (const auto& [name, value] : json.members()) {
        identity.components.push_back({.name = name, .value = value.text()});
    }
    return identity;
}

void read_images_and_tasks(const JsonValue& json, Plan& plan)
{
    plan.images.clear();
    for (const JsonValue& image : json.at("images").elements()) {
        plan.images.push_back(read_image(image));
    }
    std::size_t parts = 0;
    for (const JsonValue& task : json.at("tasks").elements()) {
        plan.tasks.push_back(read_task(task, plan.images.size()));
        parts += plan.tasks.back().images;
        if (parts > max_planned_parts) {
            task.fail(fmt::format("has more than {} parts, the maximum", max_planned_parts));
        }
    }
    if (plan.tasks.empty()) {  // each task names existing images
        json.at("tasks").fail_expecting("an array of one value or more");
    }
}

Plan read(const JsonValue& json)
{
    if (!json.is_object() || !json.has("format") || !json.has("tasks")) {
        json.fail("is not a plan of bdpt plan");
    }
    if (const std::string format = json.at("format").scalar_text();
        format != std::to_string(plan_format)) {
        int number = 0;
        if (std::from_chars(format.data(), format.data() + format.size(), number).ec ==
                std::errc() &&
            number > plan_format) {
            json.fail(
                fmt::format("is a plan of format {}, which a newer bdpt wrote; this program "
                            "reads format {}",
                            format, plan_format));
        }
        json.fail(fmt::format("is not a plan of bdpt plan: format {}, but this program reads {}",
                              format, plan_format));
    }
    const PlannableOptions allowed = plannable_options();
    Plan plan{.scene = json.at("scene").text(),
              .environment = read_optional_path(json, "environment"),
              .volume = read_optional_path(json, "volume"),
              .rates = read_optional_path(json, "rates"),
              .render_options = read_words(json.at("render"), allowed.render),
              .merge_options = read_words(json.at("merge"), allowed.merge),
              .outputs = read_paths(json.at("outputs")),
              .strategies = read_optional_path(json, "strategies"),
              .engine_files = read_paths(json.at("engine_files"))};
    if (plan.rates && *plan.rates != rates_name) {
        json.at("rates").fail_expecting(rates_name);
    }
    for (const JsonValue& name : json.at("engine_files").elements()) {
        if (!is_engine_file(name.text())) {
            name.fail_expecting("the name of a file of an engine");
        }
    }
    read_images_and_tasks(json, plan);
    plan.identity = read_identity(json.at("identity"));
    plan.files = read_identity(json.at("files"));
    return plan;
}

}  // namespace

Plan read_plan(const fs::path& file)
{
    return read(JsonValue::read(file));
}

fs::path resolved(const fs::path& path, const fs::path& plan_file)
{
    // "job/.." is resolved by the system, even if job is a symbolic link.
    std::error_code ignored;
    const fs::path folder = fs::absolute(plan_file, ignored).parent_path();
    const fs::path result = fs::weakly_canonical(path == "." ? folder : folder / path, ignored);
    return result.empty() ? folder / path : result;
}

}  // namespace bdpt::job
