#include "dataset/dataset_arguments.h"

#include <fmt/core.h>
#include <glob.h>

#include <array>
#include <numbers>
#include <utility>

namespace bdpt::job {
namespace {

namespace fs = std::filesystem;

constexpr double radians_per_degree = std::numbers::pi / 180.0;

/// Options of `bdpt render` about its files and its processes, which a data set chooses itself, and
/// those that have another meaning there.
constexpr std::array<std::string_view, 22> not_for_datasets{
    "file",    "others",  "--output", "--samples",    "--time",       "--stats",
    "--part",  "--plan",  "--task",   "--restart",    "--display",    "--save-job",
    "--rates", "--aov",   "--crop",   "--save-rates", "--strategies", "--strategy-depth",
    "--half",  "--float", "--tiled",  "--env"};

/// Options that change no view: how models are shared among processes, and what is printed.
constexpr std::array<std::string_view, 13> without_effect{
    "models", "--output", "--threads", "--max-memory", "--isolate", "--model-time", "--share",
    "--coco", "--root",   "--restart", "--quiet",      "--verbose", "--json"};

/// Options of the process that renders all models alone.
constexpr std::array<std::string_view, 7> of_all_models{
    "models", "--isolate", "--model-time", "--share", "--coco", "--json", "--verbose"};

Choices<DatasetLayer> layer_choices()
{
    return {{{"depth", DatasetLayer::depth},
             {"distance", DatasetLayer::distance},
             {"normal", DatasetLayer::normal},
             {"camera-normal", DatasetLayer::camera_normal},
             {"uv", DatasetLayer::uv},
             {"position", DatasetLayer::position},
             {"mask", DatasetLayer::mask},
             {"flow", DatasetLayer::flow}}};
}

std::optional<std::vector<DatasetLayer>> parse_layers(const std::string& text)
{
    return parse_each_once<DatasetLayer>(text, [](std::string_view part) {
        return layer_choices().type().parse(std::string(part));
    });
}

NumberRange in_radians(NumberRange degrees)
{
    return {degrees.low * radians_per_degree, degrees.high * radians_per_degree};
}

/// Parses "A" or "A:B", finite, A not above B.
std::optional<NumberRange> parse_interval(std::string_view text)
{
    const std::vector<std::string_view> parts = split(text, ':');
    const std::optional<double> low = parse_double(parts.front());
    const std::optional<double> high = parse_double(parts.back());
    if (parts.size() > 2 || !low || !high || *low > *high) {
        return std::nullopt;
    }
    return NumberRange{*low, *high};
}

/// Parses "AZ0:AZ1,EL0:EL1" [degrees]; elevations in [-90, 90].
std::optional<ViewRange> parse_view_range(std::string_view text)
{
    const std::vector<std::string_view> parts = split(text, ',');
    const std::optional<NumberRange> azimuth = parse_interval(parts.front());
    const std::optional<NumberRange> elevation = parse_interval(parts.back());
    constexpr double zenith = 90.0;
    if (parts.size() != 2 || !azimuth || !elevation || elevation->low < -zenith ||
        elevation->high > zenith) {
        return std::nullopt;
    }
    return ViewRange{.azimuth = in_radians(*azimuth), .elevation = in_radians(*elevation)};
}

/// Parses "K/N" with K from 0 to N - 1.
std::optional<Share> parse_model_share(const std::string& text)
{
    const std::vector<std::string_view> parts = split(text, '/');
    const std::optional<std::size_t> index = parse_index(parts.front());
    const std::optional<std::size_t> count = parse_index(parts.back());
    if (parts.size() != 2 || !index || !count || *index >= *count) {
        return std::nullopt;
    }
    return Share{static_cast<std::int64_t>(*index), static_cast<std::int64_t>(*count)};
}

std::optional<NumberRange> parse_positive_interval(const std::string& text, double most)
{
    const std::optional<NumberRange> interval = parse_interval(text);
    return interval && interval->low > 0.0 && interval->high <= most ? interval : std::nullopt;
}

void add_views(OptionList& options, DatasetArguments& arguments)
{
    options.section("Views");
    options.add("--views", "N",
                "Number of views, spread evenly over a sphere around the model, or random with "
                "--view-range. Default: 24. --orbit, --cameras all and --frames choose other views",
                arguments.views.count, whole_number(1, 1'000'000));
    options.add(
        "--view-range", "AZ0:AZ1,EL0:EL1",
        "Random directions in this range of azimuths and elevations [degrees]: azimuth 0 is "
        "the front (+z), 90 the right side; all areas of the sphere are equally likely",
        arguments.views.range,
        parsed_by(parse_view_range, "AZ0:AZ1,EL0:EL1 in degrees, like -60:60,0:45"));
    options.add(
        "--distance", "D|A:B",
        "Distance from the model's middle, or a range of it; at 1 (default) the model's "
        "bounding sphere just fits into the image",
        arguments.views.distance,
        parsed_by([](const std::string& text) { return parse_positive_interval(text, 1e6); },
                  "a number above 0, or a range like 0.8:1.5"));
    options.add(
        "--fov-range", "A:B", "Random vertical field of view [degrees], instead of --fov",
        arguments.views.vertical_fov,
        converted(
            parsed_by([](const std::string& text) { return parse_positive_interval(text, 179.0); },
                      "a range of degrees like 30:60"),
            in_radians));
    options.add(
        "--poses", "FILE",
        "Cameras from a file, the transforms.json of a data set, of NeRF's Blender scenes or "
        "of nerfstudio, in place of drawn ones",
        arguments.poses, file_path());
}

void add_outputs(OptionList& options, DatasetArguments& arguments)
{
    options.section("Output");
    options
        .add("-o,--output", "FOLDER",
             "Folder of the data set, created if missing: NAME/0000.png, NAME/transforms.json and "
             "so on for the model NAME.glb, and manifest.jsonl",
             arguments.folder, file_path())
        .required = true;
    options.add("--aov", "LAYER,...",
                "More files for each view: depth, distance, normal, camera-normal, uv, position, "
                "mask (integers of objects, instances and materials), flow (to the next view)",
                arguments.layers,
                parsed_by(parse_layers, "some of " + words_text(layer_choices().words())));
    const Choices<std::string> types{
        {{"png", "png"}, {"jpg", "jpg"}, {"webp", "webp"}, {"exr", "exr"}}};
    add_choice(options, "--image", "Type of the images. Default: png", arguments.image_type, types);
    options.add(
        "--coco", "FILE",
        "Write boxes, areas and masks of all instances to this .json file, as COCO has them",
        arguments.coco, file_named({".json"}, "a file name that ends in .json"));
    options.add(
        "--root", "FOLDER",
        "Name models by their paths from this folder, not by the names of their files alone",
        arguments.root, file_path());
}

void add_processes(OptionList& options, DatasetArguments& arguments)
{
    options.section("Processes");
    options
        .add_flag("--isolate",
                  "Render each model in a process of its own, so that one that breaks or takes "
                  "too much stops no other. Default for several models; --isolate=false: none",
                  arguments.isolation, on_or_off(Isolation::on, Isolation::off))
        .default_is_chosen = true;
    options.add("--model-time", "TIME", "Limit for each model, like 90s or 10m; needs --isolate",
                arguments.model_seconds, duration());
    options.add(
        "--share", "K/N",
        "Render every Nth model from number K on, counted from 0: one of N tasks of a farm, "
        "which may share the folder or not",
        arguments.share, parsed_by(parse_model_share, "K/N with K from 0 to N - 1, like 0/8"));
    options.add_flag(
        "--restart",
        "Replace views of other options or of a changed model, which are an error else",
        arguments.existing, on_or_off(ExistingViews::replace, ExistingViews::refuse));
}

/// Returns the files that match `pattern`, sorted; a text without special characters is a file.
std::vector<fs::path> matching_files(const std::string& pattern)
{
    std::error_code ignored;
    if (pattern.find_first_of("*?[") == std::string::npos || fs::exists(pattern, ignored)) {
        return {pattern};
    }
    glob_t found{};
    const int failure = ::glob(pattern.c_str(), 0, nullptr, &found);
    std::vector<fs::path> files;
    for (std::size_t i = 0; failure == 0 && i < found.gl_pathc; ++i) {
        files.emplace_back(found.gl_pathv[i]);
    }
    ::globfree(&found);
    if (files.empty()) {
        throw Error(ErrorCode::not_found, fmt::format("{}: no file matches", pattern));
    }
    return files;
}

void check_datasets(const OptionList& options)
{
    static constexpr std::array conflicts{
        Conflict{"--poses", "--views"},      Conflict{"--poses", "--view-range"},
        Conflict{"--poses", "--fov"},        Conflict{"--poses", "--orbit"},
        Conflict{"--poses", "--cameras"},    Conflict{"--poses", "--frames"},
        Conflict{"--poses", "--fov-range"},  Conflict{"--poses", "--distance"},
        Conflict{"--fov-range", "--fov"},    Conflict{"--views", "--orbit"},
        Conflict{"--views", "--cameras"},    Conflict{"--views", "--frames"},
        Conflict{"--view-range", "--orbit"}, Conflict{"--view-range", "--cameras"},
        Conflict{"--view-range", "--frames"}};
    check(conflicts, options);
}

}  // namespace

bool DatasetArguments::has(DatasetLayer layer) const
{
    return is_among(layers, layer);
}

void add_dataset_options(OptionList& options, DatasetRequest& request)
{
    options.section("");
    options
        .add_repeated("models", "FILE",
                      "Models: .gltf or .glb; patterns in quotes, like 'models/*.glb', match files",
                      request.models, file_path())
        .required = true;
    add_views(options, request.arguments);
    add_outputs(options, request.arguments);
    add_processes(options, request.arguments);
    options.section("What to render");
    options.add(
        "--env", "FILE|none|default|object|studio",
        "Environment map, as in bdpt render; of a pattern in quotes, like 'hdr/*.exr', each "
        "model draws one",
        request.render.arguments.environment, any_text());
    OptionList render;
    add_render_options(render, request.render);
    for (const Option& option : render.all()) {
        if (!is_among(not_for_datasets, option.name())) {
            options.all().push_back(option);
        }
    }
    for (Option& option : options.all()) {
        option.uses = {.stated_in = StatedIn::command_line};
        if (option.name() == "--size") {
            option.help = "Size of all images. Default: 512x512";
        }
    }
}

DatasetArguments checked(const DatasetRequest& request, const OptionList& options)
{
    check_datasets(options);
    DatasetArguments result = request.arguments;
    if (result.isolation == Isolation::off && result.model_seconds) {
        throw OptionError("--model-time needs --isolate");
    }
    if (result.coco && !result.has(DatasetLayer::mask)) {
        throw OptionError("--coco needs --aov mask");
    }
    for (const std::string& model : request.models) {
        for (fs::path& file : matching_files(model)) {
            result.models.push_back(std::move(file));
        }
    }
    RenderRequest render = request.render;
    render.arguments.outputs = {"0000." + result.image_type};
    const std::string environment = render.arguments.environment.value_or("");
    if (environment.find_first_of("*?[") != std::string::npos) {
        result.environments = matching_files(environment);
        render.arguments.environment.reset();
    }
    result.render = checked(render, options);
    result.render.outputs.clear();
    result.render.may_add_ground = false;  // layers do not show it
    for (const Option& option : options.all()) {
        for (const std::string& text : option.texts) {
            const std::string word = option.name() + "=" + text;
            if (!is_among(of_all_models, option.name())) {
                result.words.push_back(word);
            }
            if (!is_among(without_effect, option.name())) {
                result.key_words.push_back(word);
            }
        }
    }
    return result;
}

}  // namespace bdpt::job
