#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "options/option_list.h"

namespace bdpt::job {

struct RenderArguments;

/// Frames from `first` to `last`, inclusive.
struct FrameRange {
    int first = 0;
    int last = 0;
    int step = 1;  ///< at least 1
    [[nodiscard]] bool operator==(const FrameRange&) const = default;
};

/// Parses "A:B", "A:B:S" or "A", whole numbers with A not above B and S above 0; at most a million
/// frames.
[[nodiscard]] std::optional<FrameRange> parse_frames(const std::string& text);

/// Parses "24", "23.976" or "24000/1001": frames per second, above 0 and at most 10^6.
[[nodiscard]] std::optional<double> parse_rate(const std::string& text);

/// Random numbers of the images of a sequence.
enum class SequenceNoise : std::uint8_t {
    fresh,  ///< each image has its own
    same,   ///< all images have those of the seed
};

/// Cameras of the file to render.
enum class SequenceCameras : std::uint8_t { one, all };

/// Motion between the views of a turntable; lights of the file always stay with the object.
enum class TurntableMotion : std::uint8_t {
    camera,  ///< moves around the object; the environment stays with the object
    object,  ///< turns before the camera; the environment stays with the camera
};

/// Images that one command renders.
struct Sequence {
    std::optional<FrameRange> frames{};  ///< frames of the animation, or of the turn
    double fps = 0.0;                    ///< frames per second; 0: none
    int orbit = 0;                       ///< views of a full turn; 0: the camera stays
    TurntableMotion motion = TurntableMotion::camera;
    SequenceCameras cameras = SequenceCameras::one;
    SequenceNoise noise = SequenceNoise::fresh;
};

/// One image of a sequence.
struct SequenceView {
    std::optional<int> frame;
    std::optional<double> time;         ///< in the animation [s]
    std::optional<double> turn;         ///< angle of the camera around its target [rad]
    std::optional<std::size_t> camera;  ///< index in the scene
    std::string camera_name{};          ///< name, or the index if it has none
    std::size_t index = 0;              ///< among all images
    std::size_t count = 1;              ///< number of all images
    double fps = 0.0;                   ///< frames per second; 0: none
};

/// Adds --frames, --fps, --orbit, --turn, --cameras and --same-noise, in a section of their own.
void add_sequence_options(OptionList& options, Sequence& sequence);

/// Returns `sequence` if several images are requested; none for a single one. Throws `OptionError`.
[[nodiscard]] std::optional<Sequence> checked(Sequence sequence, const OptionList& options);

/// Throws `OptionError` if file names have no placeholder that distinguishes the images.
void check_patterns(const RenderArguments& arguments);

/// Processes that render the frames of a sequence.
enum class FramesBy : std::uint8_t { one_process, tasks };

/// Returns a warning for frames whose .png files may have different exposures.
[[nodiscard]] std::optional<std::string> warning_of_flicker(const RenderArguments& arguments,
                                                            FramesBy by);

/// Returns all images that `arguments` request; those of a frame next to each other. `cameras` are
/// the names of the scene's cameras; needed for all cameras only. Throws `Error`: invalid_input if
/// cameras have the same name, not_found if there are none.
[[nodiscard]] std::vector<SequenceView> make_views(const RenderArguments& arguments,
                                                   const std::vector<std::string>& cameras);

/// Returns the arguments that render this image alone: files, time, seed.
[[nodiscard]] RenderArguments make_view_arguments(const RenderArguments& arguments,
                                                  const SequenceView& view);

/// Returns `words` of a command line for several images, with words added that select this one.
[[nodiscard]] std::vector<std::string> add_view_words(std::vector<std::string> words,
                                                      const SequenceView& view);

}  // namespace bdpt::job
