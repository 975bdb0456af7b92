#include "options/groups/sequence_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

#include "options/arguments.h"
#include "options/render_arguments.h"
#include "options/values/value_checks.h"

namespace bdpt::app {
namespace {

constexpr int most_frames = 1'000'000;

std::optional<int> parse_int(std::string_view text)
{
    int value = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    const bool good = error == std::errc{} && stop == end && std::abs(value) <= 100 * most_frames;
    return good ? std::optional(value) : std::nullopt;
}

/// The parts of `text` between colons.
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

FrameRange to_frames(const std::string& word, int orbit)
{
    const std::optional<FrameRange> frames = parse_frames(word);
    if (!frames) {
        reject("--frames", word,
               "whole numbers FIRST:LAST or FIRST:LAST:STEP, like 1:24, with FIRST not above LAST");
    }
    if (orbit > 0 && (frames->first < 1 || frames->last > orbit)) {
        reject("--frames", word, fmt::format("views from 1 to {}, as --orbit has them", orbit));
    }
    return *frames;
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
        (*last - *first) / *step >= most_frames) {
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

void add_sequence_options(CLI::App& command, SequenceWords& words)
{
    const auto group = sequence_group;
    command
        .add_option("--frames", words.frames,
                    "Render the frames A to B, B included, or every S-th of them: frame 12 with 24 "
                    "frames a second is at 0.5 s of the animation, or --frame-time after that; its "
                    "file is out.0012.exr for -o out.####.exr. With --orbit: these of its views")
        ->type_name("A:B[:S]")
        ->group(group);
    command.add_option("--fps", words.fps, "Frames a second for --frames, like 24 or 24000/1001")
        ->type_name("F")
        ->group(group);
    command
        .add_option("--orbit", words.orbit,
                    "Turntable: N views, numbered from 1, by a camera that goes once around the "
                    "vertical axis through --look-at or, without it, what it looks at")
        ->check(whole_number(1, most_frames))
        ->type_name("N")
        ->group(group);
    command
        .add_option("--cameras", words.cameras,
                    "Render what each camera of the scene sees; {camera} in names of files becomes "
                    "its name, or its index if it has none")
        ->check(one_of({"all"}))
        ->type_name("all")
        ->group(group);
    command
        .add_flag("--same-noise", words.same_noise,
                  "Give all frames the same random numbers: noise stands still, like dirt on a "
                  "window, and does not average out")
        ->group(group);
}

std::optional<Sequence> sequence(const RenderWords& render_words)
{
    const SequenceWords& words = render_words.sequence;
    if (words.same_noise && !words.frames && !words.orbit) {
        throw OptionError("--same-noise: expected --frames or --orbit with it");
    }
    if (words.fps && !words.frames && !words.orbit) {
        reject("--fps", *words.fps, "--frames or --orbit with it");
    }
    if (!words.frames && !words.orbit && !words.cameras) {
        return std::nullopt;
    }
    Sequence result;
    result.orbit = words.orbit.value_or(0);
    if (words.frames) {
        result.frames = to_frames(*words.frames, result.orbit);
        if (!words.fps && !words.orbit) {
            reject("--frames", *words.frames, "--fps with it: a glTF file has no frame rate");
        }
    } else if (words.orbit) {
        result.frames = FrameRange{.first = 1, .last = result.orbit};
    }
    if (words.fps) {
        const std::optional<double> fps = parse_rate(*words.fps);
        if (!fps) {
            reject("--fps", *words.fps, "frames a second, like 24 or 24000/1001");
        }
        result.fps = *fps;
    }
    if (words.cameras) {
        if (render_words.camera || render_words.from || render_words.look_at) {
            reject("--cameras", *words.cameras, "no --camera, --from or --look-at with it");
        }
        result.cameras = SequenceCameras::all;
    }
    result.noise = words.same_noise ? SequenceNoise::same : SequenceNoise::fresh;
    return result;
}

}  // namespace bdpt::app
