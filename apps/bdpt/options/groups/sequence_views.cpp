#include <bdpt/error.h>
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <numbers>

#include "options/arguments.h"
#include "options/groups/sequence_arguments.h"
#include "options/render_arguments.h"
#include "options/values/file_pattern.h"
#include "options/values/output_files.h"

namespace bdpt::app {
namespace {

namespace fs = std::filesystem;

/// Returns all files of an image.
std::vector<fs::path> collect_files(const RenderArguments& arguments)
{
    std::vector<fs::path> files = arguments.outputs;
    if (arguments.strategies) {
        const std::vector<fs::path> more = arguments.strategies->both();
        files.insert(files.end(), more.begin(), more.end());
    }
    if (arguments.part) {
        files.push_back(arguments.part->file);
    }
    if (arguments.stats) {
        files.push_back(*arguments.stats);
    }
    if (arguments.rates && arguments.rates->saved) {
        files.push_back(*arguments.rates->saved);
    }
    return files;
}

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
        throw Error(
            ErrorCode::not_found,
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
    for (const fs::path& file : collect_files(arguments)) {
        if (many && !takes_number(file)) {
            throw OptionError(
                fmt::format("{}: several frames need #### in the name", file.string()));
        }
        static_cast<void>(with_number(file, 0));
        if (sequence.cameras == SequenceCameras::all && !takes_camera(file)) {
            throw OptionError(
                fmt::format("{}: --cameras all needs {{camera}} in the name", file.string()));
        }
    }
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
    for (fs::path& output : result.outputs) {
        output = expand(output);
    }
    if (result.strategies) {
        result.strategies->layers = expand(result.strategies->layers);
        result.strategies->sheet = expand(result.strategies->sheet);
    }
    if (result.part) {
        result.part->file = expand(result.part->file);
    }
    if (result.stats) {
        result.stats = expand(*result.stats);
    }
    if (result.rates && result.rates->file) {
        result.rates->file = expand(*result.rates->file);
    }
    if (result.rates && result.rates->saved) {
        result.rates->saved = expand(*result.rates->saved);
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

}  // namespace bdpt::app
