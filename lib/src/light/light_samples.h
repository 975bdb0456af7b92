#pragma once

#include "geometry/ray.h"
#include "math/elementary.h"
#include "math/pdf.h"

#include <bdpt/render_options.h>
#include <bdpt/types.h>

#include <cstdint>
#include <optional>

namespace bdpt {

/// Bounding sphere of the whole scene, which lights at infinity illuminate.
struct BoundingSphere {
    Vec3 center{0.0f};
    float radius = 1.0f;

    /// Returns the density of a point on the disk perpendicular to parallel rays through the
    /// sphere.
    [[nodiscard]] PlanarPdf pdf_disk() const { return {1.0f / (pi * radius * radius)}; }
};

struct TileFactors;

/// Receiver for which next-event estimation chooses a light, and a point on it. Evaluating the
/// density of a point requires the same receiver as sampling it.
struct LightSampleContext {
    Vec3 p{0.0f};
    /// Unit normal; light from below it has no effect. nullopt: light from all directions has.
    std::optional<Vec3> normal{};
    /// Learned visibility of the environment's tiles from here; null if unknown. `LightSet` sets it
    /// for the environment.
    const TileFactors* visibility = nullptr;
};

struct LearnedLight;

enum class LightId : std::uint32_t {};

/// Parameters of light sampling, needed to evaluate its density; all but `learned` are those of
/// next-event estimation.
struct NextEventSampling {
    EnvironmentSampling environments = EnvironmentSampling::plain;
    LightSampling lights = LightSampling::automatic;
    int samples = 1;  ///< number per camera vertex
    /// What a pilot learned; null if nothing.
    const LearnedLight* learned = nullptr;
};

/// A point on a light, however it was found: everything that its densities depend on.
struct LightPoint {
    Vec3 p{0.0f};             ///< infinite lights: unit direction towards the light
    Vec3 ng{0.0f};            ///< unit; zero if not on a surface
    Vec2 barycentrics{0.0f};  ///< barycentric coordinates on triangles
    float time = 0.0f;        ///< time of the sample within the shutter interval, in [0, 1]
};

/// Light leaving a light: the first vertex of a light subpath and the direction to the second. Its
/// densities exclude the probability of choosing this light.
struct EmissionSample {
    SegmentEnd end;           ///< on the light; infinite: entry point of the ray into the scene
    Vec2 barycentrics{0.0f};  ///< barycentric coordinates on triangles
    Vec3 direction{0.0f};     ///< unit, the direction in which the light travels
    Rgb weight{0.0f};         ///< Le |cos| / (both densities)
    /// Density of x_0; infinite: of the direction; 1 for a delta light.
    AreaPdf pdf_position;
    SolidAnglePdf pdf_direction;  ///< density of the direction, for finite lights
    PlanarPdf pdf_entry{};        ///< density of the entry point, for infinite lights
};

/// Light arriving at a point from a sampled point of a light: next-event estimation, s = 1.
struct IncidentSample {
    SegmentEnd end;  ///< on the light; not set for infinite lights
    /// Barycentric coordinates on triangles; environments: position in the image.
    Vec2 barycentrics{0.0f};
    Vec3 wi{0.0f};          ///< unit, from the receiver towards the light
    float distance = 0.0f;  ///< infinite lights: infinity
    /// Incident radiance over the density of wi, to be multiplied by f_cos; environments: one over
    /// the density, for most of their light is blocked, and `Light::incident_weight` looks the
    /// radiance up later.
    Rgb weight{0.0f};
    AreaPdf pdf;  ///< density of x_0 given the receiver (EmissionSample::pdf_position's measure)
    SolidAnglePdf pdf_solid_angle;  ///< density of wi at the receiver; 1 for a delta light
};

}  // namespace bdpt
