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
             "Render the frames A to B, B included, or every S-th of them: frame 12 with 24 "
             "frames a second is at 0.5 s of the animation, or --frame-time after that; its "
             "file is out.0012.exr for -o out.####.exr. With --orbit: these of its views",
             sequence.frames,
             parsed_by([](const std::string& text) { return parse_frames(text); },
                       "whole numbers FIRST:LAST or FIRST:LAST:STEP, like 1:24, with FIRST not "
                       "above LAST"))
        .uses.python_render = true;
    options.add("--fps", "F", "Frames a second for --frames, like 24 or 24000/1001", sequence.fps,
                parsed_by([](const std::string& text) { return parse_rate(text); },
                          "frames a second, like 24 or 24000/1001"));
    options
        .add("--orbit", "N",
             "Turntable: N views, numbered from 1, by a camera that goes once around the "
             "vertical axis through --look-at or, without it, what it looks at",
             sequence.orbit, whole_number(1, max_frames))
        .uses.python_render = true;
    const Choices<TurntableMotion> motions{
        {{"camera", TurntableMotion::camera}, {"object", TurntableMotion::object}}};
    options
        .add("--turn", choice_text(motions.words()),
             "What turns with --orbit: the camera, around an object whose light stays with it "
             "(default), or the object, before a camera and an environment that stand still; "
             "lamps of the file turn with it",
             sequence.motion, motions.type())
        .uses.python_render = true;
    const Choices<SequenceCameras> cameras{{{"all", SequenceCameras::all}}};
    options.add("--cameras", "all",
                "Render what each camera of the scene sees; {camera} in names of files becomes its "
                "name, or its index if it has none",
                sequence.cameras, cameras.type());
    const Choices<SequenceNoise> noises{
        {{"true", SequenceNoise::same}, {"false", SequenceNoise::fresh}}};
    options
        .add_flag("--same-noise",
                  "Give all frames the same random numbers: noise stands still, like dirt on a "
                  "window, and does not average out. Default with --denoise, for what is left of "
                  "noise flickers more than it shows; --same-noise=false takes it away",
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
    if (options.given("--denoise") && !options.given("--same-noise")) {
        sequence.noise = SequenceNoise::same;
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
