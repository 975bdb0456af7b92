#pragma once

#include "path/segment_sample.h"

#include <optional>
#include <vector>

namespace bdpt {

/// The segment of a ray that lies in fog.
struct FogSegment {
    Vec3 origin{0.0f};
    Vec3 direction{0.0f};  ///< unit
    FogSpan span;
};

/// A light, and a point in the fog sampled for it.
struct FogSample {
    LightId light{};
    float distance = 0.0f;  ///< distance from the ray's origin [m]
    float pdf = 0.0f;       ///< joint density of light and distance [1/m]
    Vec2 u{0.0f};           ///< remaining random numbers, for a point on the light
};

/// Chooses a light first and then a point in the fog on a ray, in proportion to the inverse square
/// of the distance between them: equiangular sampling [Kulla and Fajardo 2012, "Importance Sampling
/// Techniques for Path Tracing in Participating Media", sec. 4.1]. Walks that sample by the fog's
/// density alone seldom scatter near a light, where the fog is brightest. The extent of a light is
/// added to its distance; for a light at infinity sampling is uniform along the ray.
class FogSampling {
public:
    /// Keeps a reference to `world`, which must outlive this.
    FogSampling(const World& world, LightSampling lights);

    /// Returns the number of samples per segment that is worth its time, in (0, 1]: among many
    /// lights the chosen one seldom matters.
    [[nodiscard]] float samples() const { return lights_.uses_tree(sampling_) ? 0.25f : 1.0f; }

    /// Samples a light and a distance. `u_light`, `u_distance` in [0, 1), `draw_fine()` as for
    /// `LightSet::choose_for_context`.
    template <typename DrawFine>
    [[nodiscard]] std::optional<FogSample> sample(const FogSegment& fog, Vec2 u_light,
                                                  float u_distance, const DrawFine& draw_fine) const
    {
        const auto choice =
            lights_.choose_for_context(receiver(fog), u_light, draw_fine, sampling_);
        if (!choice) {
            return std::nullopt;
        }
        const float distance = sample_distance(fog, choice->id, u_distance);
        return FogSample{.light = choice->id,
                         .distance = distance,
                         .pdf = choice->probability * pdf_distance(fog, choice->id, distance),
                         .u = choice->u};
    }
    /// Returns the density with which `sample` chooses this light and this distance [1/m].
    [[nodiscard]] float pdf(const FogSegment& fog, LightId light, float distance) const
    {
        return lights_.context_probability(light, receiver(fog), sampling_) *
               pdf_distance(fog, light, distance);
    }

    /// Samples the distance for a given light.
    [[nodiscard]] float sample_distance(const FogSegment& fog, LightId light,
                                        float u) const noexcept;
    [[nodiscard]] float pdf_distance(const FogSegment& fog, LightId light,
                                     float distance) const noexcept;

private:
    /// Bounding sphere of a light; the radius is infinite for lights at infinity.
    struct Ball {
        Vec3 center{0.0f};
        float radius = 0.0f;
    };
    struct Angles;
    [[nodiscard]] std::optional<Angles> angles(const FogSegment& fog, LightId light) const noexcept;
    /// Returns the receiver that represents all points of the segment.
    [[nodiscard]] static LightSampleContext receiver(const FogSegment& fog)
    {
        return {.p = fog.origin + 0.5f * (fog.span.begin + fog.span.end) * fog.direction};
    }

    const LightSet& lights_;
    LightSampling sampling_;
    std::vector<Ball> balls_;  // one per light
};

}  // namespace bdpt
