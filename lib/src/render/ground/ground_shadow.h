#pragma once

#include "camera/camera.h"
#include "integrator/sample_schedule.h"
#include "light/light_samples.h"
#include "math/sampler.h"
#include "render/ground/ground_light.h"
#include "render/ground/ground_occluders.h"
#include "scene/world.h"

#include <bdpt/film/aov_film.h>
#include <bdpt/render_options.h>
#include <bdpt/render_stats.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <unordered_map>
#include <vector>

namespace bdpt {

/// A shadow catcher: direct light on a horizontal ground that is no part of the scene, with and
/// without occlusion by the scene. The ground reflects nothing and is visible to camera rays alone
/// (docs/decisions/0054-shadow-catcher.md).
class GroundShadow {
public:
    /// Keeps a reference to `world`, which must outlive this.
    GroundShadow(const World& world, const RenderOptions& options);

    /// Estimates the irradiance of the ground where a camera ray that hits no surface hits it, and
    /// counts its shadow rays. nullopt if the ray does not hit the ground within reach of rays.
    [[nodiscard]] std::optional<GroundLight> light_at(const CameraRay& ray,
                                                      const TimeAndWavelength& moment,
                                                      Sampler& sampler, RayCounts& rays) const;

    /// A part of the ground where few camera rays sample light.
    struct Part {
        float irradiance = 0.0f;   ///< of the sky, luminance [lx]
        float sky_chance = 0.0f;   ///< upper bound of the probability of a sample of the sky
        float lamp_chance = 0.0f;  ///< the same for each sample of a lamp
    };
    /// Returns the part of the ground between the rays through the corners of a rectangle of the
    /// film. nullopt if rays between them may miss the ground, or if each samples light.
    [[nodiscard]] std::optional<Part> part_between(const std::array<CameraRay, 4>& corners) const;
    /// Tests whether `light_at` may sample light. If not, it returns the part's irradiance, not
    /// shadowed.
    [[nodiscard]] bool may_sample(const Part& part, const Sampler& sampler) const;

private:
    struct Point;
    /// Luminance of irradiance [lx].
    struct Light {
        float all = 0.0f;
        float blocked = 0.0f;  // by the scene; an estimate may exceed `all`
    };
    [[nodiscard]] std::optional<SegmentEnd> meet(const CameraRay& ray) const;
    void add_sky(const Point& point, Light& sum) const;
    static void add(Light& sum, const Light& light, float weight);
    [[nodiscard]] float blocked_light(const Point& point, const GroundSky::Effort& effort) const;
    [[nodiscard]] Light sample_sky(const Point& point, const GroundSky::Effort& effort) const;
    void add_suns(const Point& point, Light& sum) const;
    void add_lamps(const Point& point, Light& sum) const;
    /// Returns the contribution of a light.
    [[nodiscard]] Light past_scene(const Point& point, LightId id, const IncidentSample& light,
                                   Rgb irradiance, std::uint32_t ray) const;
    /// Tests whether a surface of the light itself occludes this point on it from the ground.
    [[nodiscard]] bool hides_itself(const Point& point, LightId id, const IncidentSample& light,
                                    SegmentKey segment) const;
    void find_shining_meshes();

    /// Bounds of the emissive triangles of a mesh.
    struct Box {
        Vec3 min{std::numeric_limits<float>::infinity()};
        Vec3 max{-std::numeric_limits<float>::infinity()};
    };

    const World& world_;
    float height_;
    std::optional<GroundOccluders> occluders_;  // set if a shadow is requested
    std::optional<GroundSky> sky_;
    std::vector<LightId> suns_;  // all other lights at infinity
    std::optional<GroundLamps> lamps_;
    int lamp_samples_ = 0;                                // per camera ray
    std::unordered_map<const PlacedMesh*, Box> shining_;  // bounds of meshes that emit
};

}  // namespace bdpt
