#pragma once

#include "geometry/segment_end.h"
#include "math/pdf.h"

#include <bdpt/render_options.h>
#include <bdpt/types.h>

#include <cstdint>

namespace bdpt {

class EnvironmentVisibility;

enum class LightId : std::uint32_t {};

/// How next-event estimation samples lights. Whoever evaluates its density needs to know.
struct NextEventSampling {
    EnvironmentSampling environments = EnvironmentSampling::plain;
    LightSampling lights = LightSampling::automatic;
    int samples = 1;  ///< of each camera vertex
    /// What is visible of the environment; null: that is not known.
    const EnvironmentVisibility* visibility = nullptr;
};

/// A point of a light, whatever found it: all that its densities depend on.
struct LightPoint {
    Vec3 p{0.0f};             ///< infinite lights: the unit direction towards the light
    Vec3 ng{0.0f};            ///< unit; zero when on no surface
    Vec2 barycentrics{0.0f};  ///< of triangles
    float time = 0.0f;        ///< of the sample, as everywhere: in [0, 1] while the shutter is open
};

/// Light leaving a light: the first vertex of a light subpath and the direction to the second. The
/// probability of choosing this light is in none of the densities.
struct EmissionSample {
    SegmentEnd end;               ///< on the light; infinite: where the ray enters the scene
    Vec2 barycentrics{0.0f};      ///< of triangles
    Vec3 direction{0.0f};         ///< unit, the way the light travels
    Rgb weight{0.0f};             ///< Le |cos| / (both densities)
    AreaPdf pdf_position;         ///< of x_0; infinite: of the direction; 1 for a delta light
    SolidAnglePdf pdf_direction;  ///< finite lights
};

/// Light arriving at a point from a sampled point of a light: next-event estimation, s = 1.
struct IncidentSample {
    SegmentEnd end;           ///< on the light; not set for infinite lights
    Vec2 barycentrics{0.0f};  ///< of triangles; environments: the place in the image
    Vec3 wi{0.0f};            ///< unit, from the receiver towards the light
    float distance = 0.0f;    ///< infinite lights: infinity
    /// Incident radiance over the density of wi, to be multiplied by f_cos; environments: one over
    /// the density, for most of their light is blocked. `Light::incident_weight` looks it up.
    Rgb weight{0.0f};
    AreaPdf pdf;  ///< of x_0 given the receiver (EmissionSample::pdf_position's measure)
    SolidAnglePdf pdf_solid_angle;  ///< of wi at the receiver; 1 for a delta light
};

}  // namespace bdpt
