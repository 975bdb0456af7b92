#pragma once

#include <bdpt/eval/bench.h>
#include <bdpt/film/film.h>
#include <bdpt/io/write_image.h>
#include <bdpt/render.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bdpt::eval {

/// File paths of the benchmark of one scene.
class BenchFiles {
public:
    BenchFiles(std::filesystem::path folder, std::string scene);

    [[nodiscard]] std::filesystem::path plan() const;
    [[nodiscard]] std::filesystem::path run(IntegratorKind integrator, std::uint64_t seed) const;
    [[nodiscard]] std::filesystem::path image(IntegratorKind integrator, std::uint64_t seed) const;
    [[nodiscard]] std::filesystem::path strategies() const;
    /// `key` distinguishes the references of a scene.
    [[nodiscard]] std::filesystem::path reference_image(const std::string& key) const;
    [[nodiscard]] std::filesystem::path reference_facts(const std::string& key) const;

    /// Creates the folders. Throws `Error` (output).
    void create() const;

private:
    std::filesystem::path folder_;
    std::string scene_;
};

/// Returns the settings that images of a scene depend on, apart from integrator, samples, seed and
/// machine: components of the render's identity, by name.
[[nodiscard]] nlohmann::ordered_json render_settings(const BenchScene& scene,
                                                     const RenderOptions& options);
/// Returns a hash of what is rendered: scene and camera.
[[nodiscard]] std::string hash_content(const BenchScene& scene);
/// Returns a content hash of 32 hexadecimal digits.
[[nodiscard]] std::string hash_bytes(std::string_view bytes);

/// Reads a JSON file; returns none if there is no such file. Throws `Error`: not_found if it cannot
/// be read, invalid_input if it is no JSON.
[[nodiscard]] std::optional<nlohmann::ordered_json> read_json(const std::filesystem::path& file);
/// Writes a JSON file atomically. Throws `Error` (output).
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json);

/// Returns the metadata of an image of the scene, as it is rendered now.
[[nodiscard]] io::ImageMetadata make_metadata(const BenchScene& scene);

/// Returns the mean over pixels and channels of term(pixel, channel, r) / (r^2 + epsilon), where r
/// is the value of `reference`.
template <typename Term>
[[nodiscard]] double relative_mean(const Image& reference, double epsilon, const Term& term)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double r = static_cast<double>(reference.pixels[i][c]);
            sum += term(i, c, r) / (r * r + epsilon);
        }
    }
    return sum / (3.0 * static_cast<double>(reference.pixels.size()));
}

/// Throws `Error` (invalid_input) for an image of another size.
void check_size(const Image& image, int width, int height, const std::filesystem::path& file);

/// Converts a run to JSON and back. The latter throws `Error` (invalid_input) that names `file`.
[[nodiscard]] nlohmann::ordered_json run_json(const BenchRun& run);
[[nodiscard]] BenchRun parse_run(const nlohmann::ordered_json& json,
                                 const std::filesystem::path& file);

/// Tracks the progress of the work on a scene, and reports it to the caller.
class BenchProgressMeter {
public:
    /// `planned`: total work, in CPU time [s].
    BenchProgressMeter(double planned, const BenchControl& control)
        : left_(planned), control_(&control)
    {}

    /// Begins a piece of work of about `seconds`.
    void begin(const std::string& activity, double seconds)
    {
        activity_ = activity;
        piece_ = seconds;
        tell(0.0);
    }
    /// Reports that `fraction` of the current piece, in [0, 1], is done.
    void tell(double fraction) const
    {
        if (control_->on_progress) {
            const double done = piece_ * std::clamp(fraction, 0.0, 1.0);
            control_->on_progress({.worked = worked_ + done,
                                   .left = std::max(left_ - done, 0.0),
                                   .activity = activity_});
        }
    }
    /// Ends the current piece.
    void end()
    {
        worked_ += piece_;
        skip(piece_);
        piece_ = 0.0;
    }
    /// Removes work of about `seconds` from the plan.
    void skip(double seconds) { left_ = std::max(left_ - seconds, 0.0); }

private:
    double left_;
    double worked_ = 0.0;
    double piece_ = 0.0;
    std::string activity_;
    const BenchControl* control_;
};

/// Resets the peak memory, so that the next peak is measured from here on. Linux only.
void reset_peak_memory();

/// Returns the peak memory of this process since the reset [bytes]; none where it is unknown.
[[nodiscard]] std::optional<std::uint64_t> peak_memory();

/// A reference and its key.
struct KeyedReference {
    Reference reference;
    std::string key;  ///< hash of the options it was requested with, or of the given pixels
    std::filesystem::path file;  ///< path of the image
};

/// Returns the given reference, or the one in `files`, or a new one, which is kept there; none if
/// stopped. Throws `Error` like `run_scene`.
[[nodiscard]] std::optional<KeyedReference> reference_for(const BenchScene& scene,
                                                          const BenchOptions& options,
                                                          const BenchFiles& files,
                                                          BenchProgressMeter& meter,
                                                          const BenchControl& control);

/// Returns the key under which the reference of the options is kept.
[[nodiscard]] std::string reference_key(const BenchScene& scene, const BenchOptions& options);

/// Greatest fraction of a run's time spent on finding its number of samples.
inline constexpr double calibration_share = 1.0 / 3.0;

/// The data that all runs of a scene in a folder share: options, and the samples of each
/// integrator, which are measured once and then kept.
class Plan {
public:
    /// Takes the key of the reference. Throws `Error`: usage if `files` have another plan, with the
    /// difference; those of read_json().
    Plan(const BenchScene& scene, const BenchOptions& options, const BenchFiles& files,
         const std::string& reference);

    /// Measures what is not known yet, and saves it. Returns false if stopped.
    [[nodiscard]] bool complete(const BenchScene& scene, const BenchOptions& options,
                                BenchProgressMeter& meter, const BenchControl& control);

    /// Returns the goals of a complete plan. Throws `Error` (invalid_input) for invalid numbers.
    [[nodiscard]] BenchGoals goals(IntegratorKind kind) const;

private:
    [[nodiscard]] bool known(IntegratorKind kind) const;
    [[nodiscard]] std::int64_t power_of_two_for_all(const BenchOptions& options) const;
    [[nodiscard]] std::int64_t number(const std::string& member, const std::string& name) const;

    std::filesystem::path file_;
    nlohmann::ordered_json json_;
};

/// Measures the contribution of each strategy of bdpt: share of light and of variance, weighted and
/// unweighted, with small images for the report; and the mean path length in each pixel. Kept in a
/// file, and not measured again. Nothing is kept if stopped. Throws `Error` (output, out of
/// memory).
void measure_strategies(const BenchScene& scene, const BenchOptions& options,
                        const BenchFiles& files, const Reference& reference,
                        BenchProgressMeter& meter, const BenchControl& control);

/// Parameters that the renders of a scene share.
struct TrialSetup {
    const BenchScene& scene;
    RenderOptions options;  ///< including integrator, size and seed; samples are ignored
    const BenchControl& control;
};

[[nodiscard]] TrialSetup make_setup(const BenchScene& scene, const RenderOptions& options,
                                    IntegratorKind integrator, std::uint64_t seed,
                                    const BenchControl& control);

/// Seed of references; not used by any run or round.
inline constexpr std::uint64_t reference_seed = 1'000'003;

/// Upper bound of samples: more than anybody has time for.
inline constexpr std::int64_t max_samples = std::int64_t{1} << 20;

/// Returns the even number of samples that take about `seconds` of CPU time, measured by renders
/// that grow until one takes a good part of it. Time for choosing the integrator counts once.
/// Returns none if stopped.
[[nodiscard]] std::optional<std::int64_t> samples_in(const TrialSetup& setup, double seconds);

/// Renders `samples` samples from the first on; returns none if stopped.
[[nodiscard]] std::optional<Film> render_all(const TrialSetup& setup, std::int64_t samples,
                                             const BenchProgressMeter& meter);

/// A run with its image at equal time.
struct Trial {
    BenchRun run;
    Image image;
};

/// Renders a run; returns none if stopped.
[[nodiscard]] std::optional<Trial> make_trial(const TrialSetup& setup, const BenchGoals& goals,
                                              const Reference& reference,
                                              const BenchProgressMeter& meter);

/// Renders `samples` samples from the first on and measures the result; returns none if stopped.
[[nodiscard]] std::optional<Checkpoint> measure_once(const TrialSetup& setup, std::int64_t samples,
                                                     const Reference& reference);

/// Returns the samples at which a run is measured: powers of two and its goals, in order.
[[nodiscard]] std::vector<std::int64_t> checkpoint_samples(const BenchGoals& goals);

}  // namespace bdpt::eval
