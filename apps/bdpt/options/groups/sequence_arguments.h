#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "options/option_list.h"

namespace bdpt::app {

struct RenderArguments;

/// Frames from `first` to `last`, both of them included.
struct FrameRange {
    int first = 0;
    int last = 0;
    int step = 1;  ///< at least 1
    [[nodiscard]] bool operator==(const FrameRange&) const = default;
};

/// "A:B", "A:B:S" or "A", whole numbers with A not above B and S above 0; at most a million frames.
[[nodiscard]] std::optional<FrameRange> parse_frames(const std::string& text);

/// "24", "23.976" or "24000/1001": frames a second, above 0 and at most 10^6.
[[nodiscard]] std::optional<double> parse_rate(const std::string& text);

/// Which random numbers the images of a sequence have.
enum class SequenceNoise : std::uint8_t {
    fresh,  ///< each its own
    same,   ///< all those of the seed
};

/// Which cameras of the file are rendered.
enum class SequenceCameras : std::uint8_t { one, all };

/// What turns between the views of a turntable: lights of the file always
/// stay with the object.
enum class TurntableMotion : std::uint8_t {
    camera,  ///< goes around the object, in an environment that stays with the object
    object,  ///< turns before the camera, in an environment that stays with the camera
};

/// Several images that one command makes.
struct Sequence {
    std::optional<FrameRange> frames{};  ///< of the animation, or of the turn
    double fps = 0.0;                    ///< frames a second; 0: there is none
    int orbit = 0;                       ///< views of a whole turn; 0: the camera stays
    TurntableMotion motion = TurntableMotion::camera;
    SequenceCameras cameras = SequenceCameras::one;
    SequenceNoise noise = SequenceNoise::fresh;
};

/// One image of a sequence.
struct SequenceView {
    std::optional<int> frame;
    std::optional<double> time;         ///< of the animation [s]
    std::optional<double> turn;         ///< of the camera around its target [rad]
    std::optional<std::size_t> camera;  ///< index in the scene
    std::string camera_name{};          ///< that, or the index
    std::size_t index = 0;              ///< among all
    std::size_t count = 1;              ///< of all
    double fps = 0.0;                   ///< frames a second; 0: there is none
};

/// Adds --frames, --fps, --orbit, --turn, --cameras and --same-noise, in a section of their own.
void add_sequence_options(OptionList& options, Sequence& sequence);

/// `sequence` where several images are asked for; none for a single one. Throws `OptionError`.
[[nodiscard]] std::optional<Sequence> checked(Sequence sequence, const OptionList& options);

/// Throws `OptionError` when the names of files have no place for what tells the images apart.
void check_patterns(const RenderArguments& arguments);

/// Who renders the frames of a sequence.
enum class FramesBy : std::uint8_t { one_process, tasks };

/// For frames of which .png files may have several exposures.
[[nodiscard]] std::optional<std::string> warning_of_flicker(const RenderArguments& arguments,
                                                            FramesBy by);

/// All images that `arguments` ask for; those of a frame next to each other. `cameras` are the
/// names of those that the scene has; needed for all of them only. Throws `Error` (invalid_input)
/// when cameras are named alike, (not_found) when there are none.
[[nodiscard]] std::vector<SequenceView> views_of(const RenderArguments& arguments,
                                                 const std::vector<std::string>& cameras);

/// The arguments that make this image alone: files, time, seed.
[[nodiscard]] RenderArguments arguments_of(const RenderArguments& arguments,
                                           const SequenceView& view);

/// `words` of a command line, and more that choose this image of those that they make.
[[nodiscard]] std::vector<std::string> words_of(std::vector<std::string> words,
                                                const SequenceView& view);

}  // namespace bdpt::app
