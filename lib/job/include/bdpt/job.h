#pragma once

/// @file
/// Does in this process what the command `bdpt render` does.
///
/// @code{.cpp}
/// bdpt::RenderJob job("room.glb");
/// job.set("output", {"room.exr", "room.png"}).set("spp", 256).set("size", {640, 480});
/// job.set("denoise", true);
/// const bdpt::JobResult result = bdpt::run(job);
/// std::cout << result.images.at(0).samples_per_pixel << '\n';
/// @endcode

#include <bdpt/export.h>
#include <bdpt/render.h>

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt {

/// The value of an option of a job: true or false, a number, a text, a path, or a list of these; or
/// nullptr, which stands for the default. All of them convert to it.
class BDPT_EXPORT JobValue {
public:
    JobValue(std::nullptr_t value);
    JobValue(bool value);
    JobValue(double value);
    template <std::integral Whole>
    requires(!std::same_as<Whole, bool>) JobValue(Whole value) : json_(std::to_string(value)) {}
    template <typename Text>
    requires std::convertible_to<Text, std::string_view> JobValue(const Text& value)
        : JobValue(Quoted{std::string_view(value)})
    {}
    JobValue(const std::filesystem::path& value) : JobValue(std::string_view(value.native())) {}
    JobValue(std::initializer_list<JobValue> values);
    JobValue(const std::vector<JobValue>& values);

    /// Returns the value as JSON.
    [[nodiscard]] const std::string& json() const { return json_; }

private:
    struct Quoted {
        std::string_view text;
    };
    explicit JobValue(Quoted value);

    std::string json_;
};

/// An option of a job that has a value.
struct JobSetting {
    std::string name;
    std::vector<std::string> texts;  ///< as on the command line; several if the option repeats
    std::filesystem::path job{};     ///< the job file that gave it; empty: the program did
    /// Compares what is set, not by whom.
    friend bool operator==(const JobSetting& a, const JobSetting& b)
    {
        return a.name == b.name && a.texts == b.texts;
    }
};

/// A render, from the scene to the files, as plain data: the options of `bdpt render` by name, as
/// in a job file (docs/job.schema.json): `light_samples` for --light-samples, `file` for the scene.
/// Relative paths are those of the working directory.
class BDPT_EXPORT RenderJob {
public:
    /// Renders `scene`, a .gltf or .glb file. Without `output` the image is NAME.png in the working
    /// directory. Throws `Error` as `set()`.
    explicit RenderJob(const std::filesystem::path& scene);

    /// Reads a job file; paths in it are relative to its folder. Files that it names are written
    /// only there or below, and replace only files of bdpt; `set()` chooses others. Throws `Error`:
    /// not_found, and invalid_input that names the place in the file.
    [[nodiscard]] static RenderJob from_file(const std::filesystem::path& file);
    /// Parses the text of a job file, job.json in `folder`. Throws `Error` (invalid_input).
    [[nodiscard]] static RenderJob from_json(std::string_view text,
                                             const std::filesystem::path& folder = {});

    /// Sets an option, replacing its value. Beside the options of job files there are those that no
    /// file may state: `restart`, `denoiser_library`, `ktx_library` and `allow_folder`. Throws
    /// `Error` (invalid_input) for an unknown name, and for a value of a wrong type or out of
    /// range.
    RenderJob& set(std::string_view name, const JobValue& value);

    /// Returns the text of a job file in `folder`, to which relative paths are then relative.
    [[nodiscard]] std::string to_json(const std::filesystem::path& folder = {}) const;

    /// Returns the options that have a value.
    [[nodiscard]] const std::vector<JobSetting>& settings() const { return settings_; }
    friend bool operator==(const RenderJob&, const RenderJob&) = default;

private:
    RenderJob() = default;

    std::vector<JobSetting> settings_;  // in the order of the help of the command
};

/// Importance of a message.
enum class MessageKind : std::uint8_t {
    note,     ///< for people, such as "wrote out.png: 64 spp in 3.2 s"
    warning,  ///< the image may not be what was wanted
};

/// Progress of a job, between the passes of an image.
struct JobProgress {
    std::size_t image = 0;                 ///< index of the image
    std::size_t images = 1;                ///< number of images of the job
    double fraction = 0.0;                 ///< of the image, in [0, 1], by samples, time or noise
    std::optional<double> seconds_left{};  ///< for the image, estimated [s]
    Progress render{};                     ///< of the image
};

/// Observation and control of a job. Everything is optional.
struct JobControl {
    /// A request ends the render after the current pass, and the samples so far are written, as
    /// Ctrl-C does in the command. Images that are not begun yet are not written.
    std::stop_token stop;
    /// Called after each pass of an image. What it throws ends the job and reaches the caller; the
    /// files of the image are not written.
    std::function<void(const JobProgress&)> on_progress;
    /// Called with each message of the command, without its "bdpt: ": one line.
    std::function<void(MessageKind, std::string_view)> on_message;
};

/// An image that a job rendered and wrote.
struct JobImage {
    /// All files that were written: images, then those of `strategies`, `part`, `save_rates` and
    /// `stats`.
    std::vector<std::filesystem::path> files{};
    std::optional<int> frame{};           ///< number of the frame or view, in a sequence
    std::optional<std::string> camera{};  ///< its name, if the job renders several
    std::int64_t samples_per_pixel = 0;   ///< all in the image, also those of a continued part
    double seconds = 0.0;                 ///< time of rendering [s]
    /// As by estimate_noise(); infinite if it is unknown.
    double noise = std::numeric_limits<double>::infinity();
    std::optional<float> exposure{};  ///< of the files for screens [EV], if there are any
    bool stopped = false;             ///< true: a stop was requested while it was rendered
};

/// The result of run().
struct JobResult {
    std::vector<JobImage> images{};  ///< one; several of a sequence (`orbit`, `frames`, `cameras`)
    bool stopped = false;            ///< true: a stop was requested, and images may be missing
};

/// Renders `job` as `bdpt render` does, with the same bits: loads the scene, adds light and a
/// camera where there are none, renders or continues a part, denoises, and writes all files. It
/// prints nothing and handles no signals. May be called from several threads at once, for jobs that
/// write different files. Throws `Error` with the messages and codes of the command; usage if the
/// standard input or output ("-") is among the files, because it belongs to the program.
BDPT_EXPORT JobResult run(const RenderJob& job, const JobControl& control = {});

}  // namespace bdpt
