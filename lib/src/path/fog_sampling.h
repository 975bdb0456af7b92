#pragma once

#include "path/segment_sample.h"

#include <optional>
#include <vector>

namespace bdpt {

/// The part of a ray that fog fills.
struct FogSegment {
    Vec3 origin{0.0f};
    Vec3 direction{0.0f};  ///< unit
    FogSpan span;
};

/// A light, and a point of the fog for it.
struct FogSample {
    LightId light{};
    float distance = 0.0f;  ///< from the ray's origin [m]
    float pdf = 0.0f;       ///< of both [1/m]
    Vec2 u{0.0f};           ///< what is left of the random numbers, for a point of the light
};

/// Chooses a light first and then a point of the fog on a ray, in proportion to the inverse square
/// of the distance between them: equiangular sampling [Kulla and Fajardo 2012, "Importance Sampling
/// Techniques for Path Tracing in Participating Media", sec. 4.1]. What a walk chooses by the
/// fog's density alone is seldom near a lamp, where the fog is brightest. A light that has an
/// extent counts as that much farther away; for a light at infinity all points of the ray are
/// alike.
class FogSampling {
public:
    /// `world` must outlive this.
    FogSampling(const World& world, LightSampling lights);

    /// How many samples are worth their time on each segment, in (0, 1]: among many lights the one
    /// that is chosen is seldom the one that matters.
    [[nodiscard]] float samples() const { return lights_.uses_tree(sampling_) ? 0.25f : 1.0f; }

    /// `u_light`, `u_distance` in [0, 1), `draw_fine()` as for `LightSet::choose_for_context`.
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
    /// Probability density of `sample` choosing this light and this distance [1/m].
    [[nodiscard]] float pdf(const FogSegment& fog, LightId light, float distance) const
    {
        return lights_.context_probability(light, receiver(fog), sampling_) *
               pdf_distance(fog, light, distance);
    }

    /// The distance by itself, if the light is given.
    [[nodiscard]] float sample_distance(const FogSegment& fog, LightId light,
                                        float u) const noexcept;
    [[nodiscard]] float pdf_distance(const FogSegment& fog, LightId light,
                                     float distance) const noexcept;

private:
    /// Around a light; an infinite radius for lights at infinity.
    struct Ball {
        Vec3 center{0.0f};
        float radius = 0.0f;
    };
    struct Angles;
    [[nodiscard]] std::optional<Angles> angles(const FogSegment& fog, LightId light) const noexcept;
    /// Stands for all points of the segment.
    [[nodiscard]] static LightSampleContext receiver(const FogSegment& fog)
    {
        return {.p = fog.origin + 0.5f * (fog.span.begin + fog.span.end) * fog.direction};
    }

    const LightSet& lights_;
    LightSampling sampling_;
    std::vector<Ball> balls_;  // by light
};

}  // namespace bdpt
