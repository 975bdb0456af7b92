#pragma once

#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/part/render_part.h>
#include <bdpt/render.h>

#include <cstdint>
#include <memory>

namespace bdpt {

/// A render that one holds, to look at while it grows:
///
///     bdpt::Renderer renderer(scene, camera, options);
///     while (renderer.noise() > 0.02) {
///         renderer.render(16);
///         show(renderer.image());
///     }
///
/// What IntegratorKind::automatic stands for is chosen once, and all that a render needs is kept
/// between the calls. The samples have the bits of one render() of all of them. Not for several
/// threads at once; each call uses all threads of the options.
class BDPT_EXPORT Renderer {
public:
    /// `scene` must outlive this. The first sample index is that of `options`, whose last one
    /// counts for `finish()` alone. Throws `Error` as render() does.
    Renderer(const Scene& scene, const CameraDesc& camera, const RenderOptions& options);
    Renderer(Renderer&&) noexcept;
    Renderer& operator=(Renderer&&) noexcept;
    ~Renderer();

    /// The next `samples` of each pixel that are missing; at least 1, with rates of samples a
    /// multiple of SampleRates::group. Throws `Error` (usage) for others, and what `control`
    /// throws: what was rendered until then stays.
    void render(std::int64_t samples, const RenderControl& control = {});
    /// Renders the missing samples of those in the options.
    void finish(const RenderControl& control = {});
    /// Adds samples of the same render that were rendered elsewhere. Throws `Error` (invalid_input)
    /// for those of another one, and for samples that are here already.
    Renderer& operator+=(const RenderPart& part);

    /// The options, in which IntegratorKind::automatic is replaced by its choice.
    [[nodiscard]] const RenderOptions& options() const;
    /// All samples so far.
    [[nodiscard]] const RenderPart& part() const;
    /// How many samples each pixel has; in the mean, with rates.
    [[nodiscard]] std::int64_t samples() const;
    /// noise_of() the film; infinite before there are two samples.
    [[nodiscard]] double noise() const;
    /// Linear radiance [nit] of the region that is rendered; black where there is no sample yet.
    [[nodiscard]] Image image() const;
    /// [s] that calls of render() and finish() took.
    [[nodiscard]] double seconds() const;

    /// Gives all away that was rendered; this then has no samples.
    [[nodiscard]] RenderPart take();

private:
    friend PartResult render_part(const Scene& scene, const CameraDesc& camera,
                                  const RenderOptions& options, RenderPart so_far,
                                  const RenderControl& control);
    class Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace bdpt
