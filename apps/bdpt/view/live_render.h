#pragma once

#include <bdpt/image.h>
#include <bdpt/renderer.h>

#include <cstdint>
#include <optional>
#include <stop_token>

#include "options/render_arguments.h"
#include "report/image/matte.h"
#include "stage/prepared_scene.h"

namespace bdpt::app {

/// When a pass ends early.
struct PassStops {
    std::stop_token soon;  ///< as soon as what it has can be kept
    std::stop_token now;   ///< nobody wants to see it any more
};

/// The render of what is seen by one integrator: the samples of `bdpt render`, to the bit.
class LiveRender {
public:
    /// `arguments` have all their options (with_choice). `stage` must outlive this. Throws `Error`.
    LiveRender(RenderArguments arguments, const PreparedScene& stage);

    /// Renders a few more samples, for about half a second. False: it was told to stop now, and has
    /// none any more.
    [[nodiscard]] bool advance(const PassStops& stops);
    [[nodiscard]] bool is_done() const;
    /// From now on files look like that.
    void set_display(const DisplayArguments& display) { arguments_.display = display; }

    /// What is rendered, with all options.
    [[nodiscard]] const RenderArguments& arguments() const { return arguments_; }
    [[nodiscard]] const Renderer& renderer() const { return renderer_; }
    /// When it was looked at last; infinite: not yet.
    [[nodiscard]] double noise() const { return noise_; }

private:
    RenderArguments arguments_;
    Renderer renderer_;
    double noise_;
    double seconds_a_sample_ = 0.0;
};

/// What covers the background that `arguments` ask for, by the films of `part`; empty without one.
[[nodiscard]] Matte shown_matte(const RenderArguments& arguments, const RenderPart& part);

struct CoarsePicture {
    Image image;
    Matte matte{};  ///< without the shadow on the ground
};

/// What is seen, in `size` and with one sample a pixel, by an integrator that is quick to begin;
/// none: it was told to stop.
[[nodiscard]] std::optional<CoarsePicture> coarse_picture(const RenderArguments& arguments,
                                                          const PreparedScene& stage,
                                                          const Size& size,
                                                          const std::stop_token& now);

}  // namespace bdpt::app
