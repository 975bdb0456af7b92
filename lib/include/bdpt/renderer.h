#pragma once

/// @file
/// Renders more samples on demand, with an image in between.
///
/// @code{.cpp}
/// void refine(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     bdpt::Renderer renderer(scene, camera, {.film = {.width = 512, .height = 512}});
///     while (renderer.noise() > 0.02) {
///         renderer.render(16);
///         bdpt::io::write_exr("growing.exr", renderer.image(), {});
///     }
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/part/render_result.h>
#include <bdpt/render.h>

#include <cstdint>
#include <memory>

namespace bdpt {

/// A progressive render, whose image can be read between calls:
///
///     bdpt::Renderer renderer(scene, camera, options);
///     while (renderer.noise() > 0.02) {
///         renderer.render(16);
///         show(renderer.image());
///     }
///
/// IntegratorKind::automatic is resolved once, and all state of the render is kept between calls.
/// The samples are bit-identical to one render() of all of them. Not thread-safe; each call uses
/// all threads of the options.
class BDPT_EXPORT Renderer {
public:
    /// Prepares a render of `scene`, which must outlive this. The first sample index is that of
    /// `options`, whose last one matters for `finish()` and, if the integrator is automatic, for
    /// its rates (with_rates()). Throws `Error` like render().
    Renderer(const Scene& scene, const CameraDesc& camera, const RenderOptions& options);
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    /// Renders the next `samples` missing samples of each pixel, at least 1; with rates the next
    /// multiple of SampleRates::group. Throws `Error` (usage) for less than 1, and exceptions of
    /// `control`: the samples rendered until then are kept.
    void render(std::int64_t samples, const RenderControl& control = {});
    /// Renders all missing samples of the options.
    void finish(const RenderControl& control = {});
    /// Adds samples of the same render that were rendered elsewhere. Throws `Error` (invalid_input)
    /// for samples of another render, and for samples that are already here.
    Renderer& operator+=(const RenderResult& part);

    /// Returns the options, in which IntegratorKind::automatic is replaced by `chosen_options`.
    [[nodiscard]] const RenderOptions& options() const;
    /// Returns all samples so far.
    [[nodiscard]] const RenderResult& result() const;
    /// Returns the samples per pixel; their mean, with rates.
    [[nodiscard]] std::int64_t samples() const;
    /// Returns estimate_noise() of the film; infinite before there are two samples.
    [[nodiscard]] double noise() const;
    /// Returns the linear radiance [nit] of the rendered region; black before the first sample.
    [[nodiscard]] Image image() const;
    /// Returns the time that rendering the samples took [s].
    [[nodiscard]] double seconds() const;

    /// Moves all rendered samples out; this renderer then has none.
    [[nodiscard]] RenderResult take();

private:
    friend RenderResult continue_render(const Scene& scene, const CameraDesc& camera,
                                        const RenderOptions& options, RenderResult so_far,
                                        const RenderControl& control);
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace bdpt
