#pragma once

#include <bdpt/image.h>
#include <bdpt/renderer.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>

#include "output/image_files.h"
#include "stage/prepared_scene.h"
#include "state/view_state.h"

namespace bdpt::view {

/// Sequence of coarse pictures before the render, so that the scene moves smoothly under the user's
/// hand.
class CoarseToFine {
public:
    /// Starts again after a change, with a picture that should take about `first_seconds`.
    void restart(const Size& size);
    /// Returns the size of the next picture's pixels in pixels of the image, in width and in
    /// height; none: all pictures were shown, and the render is next.
    [[nodiscard]] std::optional<int> divisor() const;
    /// Tests whether the next picture is the first since the last restart. It should not be
    /// abandoned, as otherwise nothing is shown during a continuous motion.
    [[nodiscard]] bool is_first() const { return is_first_; }
    /// Reports that the picture of `divisor()` took this time [s].
    void done(double seconds);
    /// Skips the remaining pictures.
    void skip() { divisor_.reset(); }

    static constexpr double first_seconds = 0.04;
    static constexpr double max_seconds = 0.25;  ///< maximum of any picture

private:
    /// Returns the expected time of a picture with that divisor [s].
    [[nodiscard]] double seconds(int divisor) const;

    Size size_{};
    double seconds_a_pixel_ = 5e-6;  ///< measured; a guess until the first picture is done
    std::optional<int> divisor_{};
    bool is_first_ = false;
};

/// Returns the size of the picture with that divisor: at least one pixel.
[[nodiscard]] Size coarse_size(const Size& size, int divisor);

/// Stop requests of a pass.
struct PassStops {
    std::stop_token soon;  ///< stop as soon as the samples can be kept
    std::stop_token now;   ///< stop at once: the result is obsolete
};

/// Render of the current view by one integrator: bit-identical to the samples of `bdpt render`.
class LiveRender {
public:
    /// `arguments` have all their options (with_choice). `stage` must outlive this object. Throws
    /// `Error`.
    LiveRender(RenderArguments arguments, const PreparedScene& stage);

    /// Renders more samples, for about half a second. Returns false if stopped at once, which
    /// discards all samples.
    [[nodiscard]] bool advance(const PassStops& stops);
    [[nodiscard]] bool is_done() const;
    /// Sets the display options of saved files.
    void set_display(const DisplayArguments& display) { arguments_.display = display; }

    /// Returns the arguments of the render, with all options.
    [[nodiscard]] const RenderArguments& arguments() const { return arguments_; }
    [[nodiscard]] const Renderer& renderer() const { return renderer_; }
    /// Returns the noise when it was last measured; infinite: not yet.
    [[nodiscard]] double noise() const { return noise_; }

private:
    RenderArguments arguments_;
    Renderer renderer_;
    double noise_;
    double seconds_a_sample_ = 0.0;
};

/// Returns `arguments` with the layers that guide the denoiser, as `bdpt render` adds them for
/// files for screens, if memory suffices.
[[nodiscard]] RenderArguments with_guides(RenderArguments arguments, const PreparedScene& stage);

/// Returns the opacity towards the background that `arguments` request, by the films of `part`;
/// empty without one.
[[nodiscard]] Matte shown_matte(const RenderArguments& arguments, const RenderResult& part);

/// Returns the image of `part` as its files have it.
[[nodiscard]] Image shown_image(const RenderArguments& arguments, const RenderResult& part);

struct CoarsePicture {
    Image image;
    Matte matte{};  ///< without the shadow on the ground
};

/// Renders the view in `size` with one sample per pixel, by an integrator that starts quickly;
/// returns none if stopped.
[[nodiscard]] std::optional<CoarsePicture> coarse_picture(const RenderArguments& arguments,
                                                          const PreparedScene& stage,
                                                          const Size& size,
                                                          const std::stop_token& now);

/// A file that a browser saves.
struct Download {
    int status = 200;     ///< HTTP status
    std::string type;     ///< "image/png"
    std::string name;     ///< for people; empty: none
    std::string content;  ///< contents, or the reason for a failure, one line
};

/// Returns "scene.exr" or "scene.png": the file that `bdpt render` would write for the same
/// samples, with that extension. Throws `Error`.
[[nodiscard]] Download saved_image(const LiveRender& render, const PreparedScene& stage,
                                   std::string_view extension);

/// Returns the exposure [EV] of files for screens. Throws `Error`.
[[nodiscard]] float compute_exposure(const LiveRender& render, const PreparedScene& stage,
                                     const Image& image);

/// Effect of a new task on the pass in flight.
enum class Urgency : std::uint8_t {
    when_idle,  ///< none: the pass completes
    soon,       ///< the pass ends as soon as its samples can be kept
    now,        ///< the pass ends at once: its result is obsolete
};

/// Queue of tasks from other threads for the render thread.
class Mailbox {
public:
    using Task = std::function<void()>;

    /// Adds a task. Thread-safe.
    void post(Task task, Urgency urgency);
    /// Runs all queued tasks. If there are none and `waits` is set, it waits for one. Returns false
    /// if closed.
    [[nodiscard]] bool work_off(bool waits);
    /// Waits for a task, for at most `time`. Returns false if none came.
    [[nodiscard]] bool wait_for(std::chrono::milliseconds time);
    /// Stops the pass in flight and all waiting. Thread-safe.
    void close();

    /// Returns the stop tokens of the next pass, which completes unless `may_be_abandoned`. Queued
    /// tasks that would stop it do so.
    [[nodiscard]] PassStops begin_pass(bool may_be_abandoned);

private:
    void stop_pass(Urgency urgency);

    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<Task> tasks_;
    Urgency urgency_ = Urgency::when_idle;  ///< maximum of the tasks
    bool closed_ = false;
    bool may_be_abandoned_ = false;
    std::stop_source soon_;
    std::stop_source now_;
};

}  // namespace bdpt::view
