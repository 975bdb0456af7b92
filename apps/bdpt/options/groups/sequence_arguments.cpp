#include "options/groups/sequence_arguments.h"

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "options/arguments.h"
#include "options/values/value_types.h"

namespace bdpt::app {
namespace {

constexpr int max_frames = 1'000'000;

std::optional<int> parse_int(std::string_view text)
{
    int value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool good = error == std::errc{} && stop == end && std::abs(value) <= 100 * max_frames;
    return good ? std::optional(value) : std::nullopt;
}

/// Splits `text` at colons.
std::vector<std::string_view> split_at_colons(std::string_view text)
{
    std::vector<std::string_view> parts;
    for (std::size_t colon = text.find(':'); colon != std::string_view::npos;
         colon = text.find(':')) {
        parts.push_back(text.substr(0, colon));
        text.remove_prefix(colon + 1);
    }
    parts.push_back(text);
    return parts;
}

}  // namespace

std::optional<FrameRange> parse_frames(const std::string& text)
{
    const std::vector<std::string_view> parts = split_at_colons(text);
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
             parsed_by([](const std::string& text) { return parse_frames(text); },
                       "whole numbers FIRST:LAST or FIRST:LAST:STEP, like 1:24, with FIRST not "
                       "above LAST"))
        .uses.python_render = true;
    options.add("--fps", "F", "Frames per second of --frames, like 24 or 24000/1001", sequence.fps,
                parsed_by([](const std::string& text) { return parse_rate(text); },
                          "frames per second, like 24 or 24000/1001"));
    options
        .add("--orbit", "N",
             "Turntable: N views, numbered from 1; the camera orbits once about the vertical axis "
             "through --look-at or, by default, its target",
             sequence.orbit, whole_number(1, max_frames))
        .uses.python_render = true;
    const Choices<TurntableMotion> motions{
        {{"camera", TurntableMotion::camera}, {"object", TurntableMotion::object}}};
    options
        .add("--turn", choice_text(motions.words()),
             "What --orbit turns: the camera, with lighting fixed to the object (default), or the "
             "object and the lamps of the file, before a fixed camera and environment",
             sequence.motion, motions.type())
        .uses.python_render = true;
    const Choices<SequenceCameras> cameras{{{"all", SequenceCameras::all}}};
    options.add("--cameras", "all",
                "Render the view of each camera; {camera} in file names becomes the camera's name, "
                "or its index if it has none",
                sequence.cameras, cameras.type());
    const Choices<SequenceNoise> noises{
        {{"true", SequenceNoise::same}, {"false", SequenceNoise::fresh}}};
    options
        .add_flag("--same-noise",
                  "Use the same random numbers for all frames: noise becomes a static pattern "
                  "instead of flickering. Default with --denoise; --same-noise=false turns it off",
                  sequence.noise, noises.type())
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

}  // namespace bdpt::app
