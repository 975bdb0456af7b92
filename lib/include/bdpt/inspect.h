#pragma once

#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/render_options.h>
#include <bdpt/scene.h>
#include <bdpt/types.h>

#include <cstdint>
#include <vector>

/// The paths and strategies of one sample of a pixel, for those who write or study integrators.
namespace bdpt {

/// Which sample of which pixel.
struct PixelSample {
    int x = 0;               ///< [pixels], from the left
    int y = 0;               ///< [pixels], from the top
    std::int64_t index = 0;  ///< as in `SampleRange`
};

/// The kind of place where a vertex lies.
enum class InspectedKind : std::uint8_t {
    lens,
    light,  ///< where a light path starts
    surface,
    medium,    ///< where a medium scatters
    infinite,  ///< on a light at infinity
};

/// A vertex of a subpath.
struct InspectedVertex {
    InspectedKind kind = InspectedKind::surface;
    Vec3 position{0.0f};      ///< world [m]; infinite: the unit direction towards the light
    Vec3 normal{0.0f};        ///< unit shading normal of surfaces; else zero
    Rgb beta{1.0f};           ///< throughput up to here, its own scattering not included
    Rgb emission{0.0f};       ///< radiance towards the vertex before, of camera paths [nit]
    float pdf_fwd = 0.0f;     ///< density with which the walk made it [1/m^2]; infinite: [1/sr]
    bool is_light = false;    ///< emits
    bool connectible = true;  ///< has a lobe that is not delta
    bool scattered_delta = false;  ///< the walk left through a delta lobe
};

/// The contribution of one strategy to the pixel.
struct InspectedContribution {
    Strategy strategy;
    int light_path = 0;         ///< as in `PathContribution`
    Rgb unweighted{0.0f};       ///< if it were alone [nit]
    float weight = 1.0f;        ///< by MIS
    std::vector<float> shares;  ///< as in `PathContribution`; empty if they are not known
};

/// All of a sample.
struct InspectedSample {
    Vec2 raster{0.0f};  ///< where its camera path goes through the film [pixels]
    float time = 0.0f;  ///< in [0, 1] while the shutter is open
    std::vector<InspectedVertex> camera_path;
    /// Its own; empty for integrators without, and where all pixels share light paths.
    std::vector<InspectedVertex> light_path;
    /// Only those that count for this pixel: its light path may be seen in others.
    std::vector<InspectedContribution> contributions;
    Rgb value{0.0f};  ///< their weighted sum [nit]
};

/// The sample as render() takes it, with the same random numbers; `options.sampling.samples` are
/// not looked at. IntegratorKind::automatic is what it chooses. Throws `Error` as render() does,
/// and usage for a pixel that is not in the image or for vcm, whose merged paths are of no
/// strategy.
[[nodiscard]] BDPT_EXPORT InspectedSample inspect_sample(const Scene& scene,
                                                         const CameraDesc& camera,
                                                         const RenderOptions& options,
                                                         const PixelSample& sample);

/// The directions from a vertex, as next-event estimation and BSDF sampling see them: images in the
/// form of environments, +y at the top, -z in the centre. Values are means over the pixels.
struct DirectionMaps {
    Image incident;    ///< radiance that comes straight from lights that have an area [nit]
    Image scattering;  ///< BSDF times cosine [1/sr]
    Image product;     ///< of these two: what is to be sampled
    Image bsdf_pdf;    ///< density of BSDF sampling [1/sr]; without its delta lobes
    Image light_pdf;   ///< density of one light sample [1/sr], where its light is visible
};

/// Those of vertex `vertex` of the camera path of the sample: 1 is the first surface. `width`
/// [pixels], even and [2, 8192], is twice the height. Throws `Error` as `inspect_sample`, and usage
/// when the path has no such surface with lobes that are not delta.
[[nodiscard]] BDPT_EXPORT DirectionMaps inspect_directions(const Scene& scene,
                                                           const CameraDesc& camera,
                                                           const RenderOptions& options,
                                                           const PixelSample& sample, int vertex,
                                                           int width = 512);

}  // namespace bdpt
