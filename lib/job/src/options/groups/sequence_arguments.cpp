#include "options/groups/sequence_arguments.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <string_view>

#include "options/output_files.h"
#include "options/render_arguments.h"
#include "options/value_types.h"

namespace bdpt::job {

namespace {

constexpr int max_frames = 1'000'000;

std::optional<int> parse_int(std::string_view text)
{
    const std::optional<int> value = parse_number<int>(text);
    return value && std::abs(*value) <= 100 * max_frames ? value : std::nullopt;
}

}  // namespace

std::optional<FrameRange> parse_frames(const std::string& text)
{
    const std::vector<std::string_view> parts = split(text, ':');
    if (parts.size() > 3) {
        return std::nullopt;
    }
    const auto first = parse_int(parts[0]);
    const auto last = parts.size() > 1 ? parse_int(parts[1]) : first;
    const auto step = parts.size() > 2 ? parse_int(parts[2]) : 1;
    if (!first || !last || !step || *last < *first || *step < 1 ||
        (*last - *first) / *step >= max_frames) {
        return std::nullopt;
    }
    return FrameRange{.first = *first, .last = *last, .step = *step};
}

std::optional<double> parse_rate(const std::string& text)
{
    constexpr double most = 1e6;
    const std::size_t slash = text.find('/');
    const bool fraction = slash != std::string::npos;
    const auto above = parse_double(std::string_view(text).substr(0, slash));
    const auto below = fraction ? parse_double(std::string_view(text).substr(slash + 1)) : 1.0;
    if (!above || !below || !(*below > 0.0)) {
        return std::nullopt;
    }
    const double rate = *above / *below;
    return rate > 0.0 && rate <= most ? std::optional(rate) : std::nullopt;
}

void add_sequence_options(OptionList& options, Sequence& sequence)
{
    options.section("Several images (their files have #### or {camera} in their names)",
                    {.plan_render = true});
    options
        .add("--frames", "A:B[:S]",
             "Render frames A to B (inclusive), or every S-th: with --fps 24, frame 12 is at 0.5 s "
             "of the animation, plus --frame-time; its file is out.0012.exr for -o out.####.exr. "
             "With --orbit: these of its views",
             sequence.frames,
             parsed_by(parse_frames,
                       "whole numbers FIRST:LAST or FIRST:LAST:STEP, like 1:24, with FIRST not "
                       "above LAST"))
        .uses.python_render = true;
    options.add("--fps", "F", "Frames per second of --frames, like 24 or 24000/1001", sequence.fps,
                parsed_by(parse_rate, "frames per second, like 24 or 24000/1001"));
    options
        .add("--orbit", "N",
             "Turntable: N views, numbered from 1; the camera orbits once about the vertical axis "
             "through --look-at or, by default, its target",
             sequence.orbit, whole_number(1, max_frames))
        .uses.python_render = true;
    const Choices<TurntableMotion> motions{
        {{"camera", TurntableMotion::camera}, {"object", TurntableMotion::object}}};
    add_choice(
        options, "--turn",
        "What --orbit turns: the camera, with lighting fixed to the object (default), or the "
        "object and the lamps of the file, before a fixed camera and environment",
        sequence.motion, motions)
        .uses.python_render = true;
    const Choices<SequenceCameras> cameras{{{"all", SequenceCameras::all}}};
    options.add("--cameras", "all",
                "Render the view of each camera; {camera} in file names becomes the camera's name, "
                "or its index if it has none",
                sequence.cameras, cameras.type());
    options
        .add_flag("--same-noise",
                  "Use the same random numbers for all frames: noise becomes a static pattern "
                  "instead of flickering. Default with --denoise; --same-noise=false turns it off",
                  sequence.noise, on_or_off(SequenceNoise::same, SequenceNoise::fresh))
        .uses.python_render = true;
}

std::optional<Sequence> checked(Sequence sequence, const OptionList& options)
{
    static constexpr std::array needs{
        Need{"--same-noise", "--frames|--orbit"}, Need{"--fps", "--frames|--orbit"},
        Need{"--turn", "--orbit"},
        Need{"--frames", "--fps|--orbit", "a glTF file has no frame rate"}};
    static constexpr std::array conflicts{Conflict{"--cameras", "--camera"},
                                          Conflict{"--cameras", "--from"},
                                          Conflict{"--cameras", "--look-at"}};
    check(needs, options);
    check(conflicts, options);
    if (!options.given("--frames") && !options.given("--orbit") && !options.given("--cameras")) {
        return std::nullopt;
    }
    if (sequence.frames && sequence.orbit > 0 &&
        (sequence.frames->first < 1 || sequence.frames->last > sequence.orbit)) {
        options.reject_value("--frames",
                             fmt::format("views from 1 to {} of --orbit", sequence.orbit));
    }
    if (!sequence.frames && sequence.orbit > 0) {
        sequence.frames = FrameRange{.first = 1, .last = sequence.orbit};
    }
    return sequence;
}

namespace {

namespace fs = std::filesystem;

std::vector<int> list_frames(const FrameRange& range)
{
    std::vector<int> numbers;
    for (std::int64_t frame = range.first; frame <= range.last; frame += range.step) {
        numbers.push_back(static_cast<int>(frame));
    }
    return numbers;
}

/// Throws if two cameras have the same files.
void check_names(const std::vector<std::string>& cameras, const RenderArguments& arguments)
{
    if (cameras.empty()) {
        throw UnknownName(
            fmt::format("{}: the scene has no camera for --cameras all", arguments.file.string()));
    }
    std::map<fs::path, std::string> owners;
    for (const std::string& camera : cameras) {
        const auto [owner, is_new] = owners.try_emplace(with_camera("{camera}", camera), camera);
        if (!is_new) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("{}: the cameras \"{}\" and \"{}\" would have the same files; "
                                    "render each with --camera INDEX",
                                    arguments.file.string(), owner->second, camera));
        }
    }
}

}  // namespace

void check_patterns(const RenderArguments& arguments)
{
    if (!arguments.sequence) {
        return;
    }
    const Sequence& sequence = *arguments.sequence;
    const bool many = sequence.frames && list_frames(*sequence.frames).size() > 1;
    for_each_written_file(arguments, [&](std::string_view /*option*/, const fs::path& file) {
        if (many && !takes_number(file)) {
            throw OptionError(
                fmt::format("{}: several frames need #### in the name", file.string()));
        }
        static_cast<void>(with_number(file, 0));
        if (sequence.cameras == SequenceCameras::all && !takes_camera(file)) {
            throw OptionError(
                fmt::format("{}: --cameras all needs {{camera}} in the name", file.string()));
        }
    });
}

std::optional<std::string> warning_of_flicker(const RenderArguments& arguments, FramesBy by)
{
    const bool writes_pictures =
        std::any_of(arguments.outputs.begin(), arguments.outputs.end(), is_for_screens);
    if (!arguments.sequence || !arguments.sequence->frames || !writes_pictures) {
        return std::nullopt;
    }
    const ExposureBase base =
        arguments.display.exposure ? arguments.display.exposure->base : ExposureBase::light;
    if (base == ExposureBase::automatic) {
        return "each .png file has its own exposure, so frames may flicker; --exposure EV sets the "
               "same for all";
    }
    if (base == ExposureBase::light && by == FramesBy::tasks && arguments.sequence->orbit == 0) {
        return "each task meters the light of its first frame, so frames may flicker; --exposure "
               "EV sets the same for all";
    }
    return std::nullopt;
}

std::vector<SequenceView> make_views(const RenderArguments& arguments,
                                     const std::vector<std::string>& cameras)
{
    if (!arguments.sequence) {
        return {SequenceView{}};
    }
    const Sequence& sequence = *arguments.sequence;
    std::vector<SequenceView> views;
    const auto add = [&](SequenceView view) {
        view.fps = sequence.fps;
        if (sequence.cameras == SequenceCameras::one) {
            views.push_back(view);
            return;
        }
        for (std::size_t i = 0; i < cameras.size(); ++i) {
            view.camera = i;
            view.camera_name = cameras[i];
            views.push_back(view);
        }
    };
    if (sequence.cameras == SequenceCameras::all) {
        check_names(cameras, arguments);
    }
    if (!sequence.frames) {
        add({});
    } else {
        for (const int number : list_frames(*sequence.frames)) {
            SequenceView view;
            view.frame = number;
            if (sequence.orbit > 0) {
                view.turn = 2.0 * std::numbers::pi * (number - 1) / sequence.orbit;
            } else {
                view.time = arguments.scene.time.value_or(0.0) + number / sequence.fps;
            }
            add(view);
        }
    }
    for (std::size_t i = 0; i < views.size(); ++i) {
        views[i].index = i;
        views[i].count = views.size();
    }
    return views;
}

RenderArguments make_view_arguments(const RenderArguments& arguments, const SequenceView& view)
{
    RenderArguments result = arguments;
    if (!arguments.sequence) {
        return result;
    }
    const auto expand = [&view](const fs::path& pattern) {
        const fs::path file = view.frame ? with_number(pattern, *view.frame) : pattern;
        return view.camera ? with_camera(file, view.camera_name) : file;
    };
    for_each_written_file(
        result, [&](std::string_view /*option*/, fs::path& file) { file = expand(file); });
    if (result.rates && result.rates->file) {
        result.rates->file = expand(*result.rates->file);
    }
    if (view.time) {
        result.scene.time = view.time;
    }
    if (view.frame && arguments.sequence->noise == SequenceNoise::fresh) {
        std::uint64_t& seed = result.options.sampling.seed;
        seed = seed_of_frame(seed, *view.frame);
    }
    result.sequence_view = view;
    return result;
}

std::vector<std::string> add_view_words(std::vector<std::string> words, const SequenceView& view)
{
    if (view.frame) {
        words.emplace_back("--frames");  // the last one counts
        words.push_back(fmt::format("{0}:{0}", *view.frame));
    }
    if (view.camera) {
        words.emplace_back("--camera");
        words.push_back(view.camera_name);
    }
    return words;
}

}  // namespace bdpt::job
