#pragma once

#include <bdpt/image.h>
#include <bdpt/renderer.h>

#include <cstdint>
#include <optional>
#include <stop_token>

#include "options/render_arguments.h"
#include "report/image/denoised.h"
#include "stage/prepared_scene.h"

namespace bdpt::app {

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

}  // namespace bdpt::app
