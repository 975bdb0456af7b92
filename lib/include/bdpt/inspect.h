#pragma once

/// @file
/// Shows the paths and the strategies of one sample of a pixel.
///
/// @code{.cpp}
/// void explain_pixel(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     const auto sample = bdpt::inspect_sample(scene, camera, {}, {.x = 640, .y = 360});
///     for (const bdpt::InspectedContribution& found : sample.contributions) {
///         std::cout << bdpt::strategy_name(found.strategy) << ": " << found.weight << '\n';
///     }
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/render_options.h>
#include <bdpt/scene.h>
#include <bdpt/types.h>

#include <cstdint>
#include <vector>

/// The paths and strategies of one sample of a pixel, for those who develop or study integrators.
namespace bdpt {

/// Identifies one sample of one pixel.
struct PixelSample {
    int x = 0;               ///< [pixels], from the left
    int y = 0;               ///< [pixels], from the top
    std::int64_t index = 0;  ///< among the samples of the pixel
};

/// The kind of place where a vertex lies.
enum class InspectedKind : std::uint8_t {
    lens,
    light,  ///< start of a light path
    surface,
    medium,    ///< scattering event in a medium
    infinite,  ///< point on a light at infinity
};

/// A vertex of a subpath.
struct InspectedVertex {
    InspectedKind kind = InspectedKind::surface;
    /// Position in world space [m]; for `infinite`: the unit direction towards the light.
    Vec3 position{0.0f};
    Vec3 normal{0.0f};   ///< unit shading normal of surfaces; else zero
    Rgb beta{1.0f};      ///< throughput up to this vertex, excluding its own scattering
    Rgb emission{0.0f};  ///< camera paths: radiance emitted towards the previous vertex [nit]
    /// Density with which the walk sampled the vertex [1/m^2]; for `infinite`: [1/sr].
    float pdf_fwd = 0.0f;
    bool is_light = false;         ///< the vertex emits
    bool connectible = true;       ///< the vertex has a lobe that is not delta
    bool scattered_delta = false;  ///< the walk left the vertex through a delta lobe
};

/// The contribution of one strategy to the pixel.
struct InspectedContribution {
    Strategy strategy;
    int light_path = 0;         ///< as in `PathContribution`
    Rgb unweighted{0.0f};       ///< contribution if this were the only strategy [nit]
    float weight = 1.0f;        ///< MIS weight
    std::vector<float> shares;  ///< as in `PathContribution`; empty if unknown
};

/// All data of a sample.
struct InspectedSample {
    Vec2 raster{0.0f};  ///< raster position of its camera path on the film [pixels]
    float time = 0.0f;  ///< time within the shutter interval, in [0, 1]
    std::vector<InspectedVertex> camera_path;
    /// The sample's own light path; empty for integrators without one, and where all pixels share
    /// light paths.
    std::vector<InspectedVertex> light_path;
    /// Only the contributions to this pixel: its light path may also contribute to others.
    std::vector<InspectedContribution> contributions;
    Rgb value{0.0f};  ///< weighted sum of the contributions [nit]
};

/// Traces the sample as render() does, with the same random numbers, which depend on
/// `options.sampling.planned_samples`. `options.sampling.samples` only decide whether the render
/// has rates (`with_rates`); with rates, the light paths that pixels share are others.
/// IntegratorKind::automatic is resolved as usual. Throws `Error` like render(), and usage for a
/// pixel outside of the image or for vcm, whose merged paths belong to no strategy.
[[nodiscard]] BDPT_EXPORT InspectedSample inspect_sample(const Scene& scene,
                                                         const CameraDesc& camera,
                                                         const RenderOptions& options,
                                                         const PixelSample& sample);

/// The directions around a vertex, as next-event estimation and BSDF sampling see them: images in
/// the format of environments, +y at the top, -z in the centre. Values are means over the pixels.
struct DirectionMaps {
    Image incident;    ///< radiance that arrives directly from lights that have an area [nit]
    Image scattering;  ///< BSDF times cosine [1/sr]
    Image product;     ///< product of `incident` and `scattering`: the integrand to be sampled
    Image bsdf_pdf;    ///< density of BSDF sampling [1/sr], excluding delta lobes
    Image light_pdf;   ///< density of one light sample [1/sr], where its light is visible
};

/// Returns the maps of vertex `vertex` of the sample's camera path: 1 is the first surface. `width`
/// [pixels], even and in [2, 8192], is twice the height. Throws `Error` like `inspect_sample`, and
/// usage if the path has no such surface with lobes that are not delta.
[[nodiscard]] BDPT_EXPORT DirectionMaps inspect_directions(const Scene& scene,
                                                           const CameraDesc& camera,
                                                           const RenderOptions& options,
                                                           const PixelSample& sample, int vertex,
                                                           int width = 512);

}  // namespace bdpt
