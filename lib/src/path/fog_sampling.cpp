#include "path/fog_sampling.h"

#include "math/elementary.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bdpt {

/// The segment as seen from the light.
struct FogSampling::Angles {
    float along;  ///< ray distance of the point nearest to the light
    float away;   ///< distance of that point from the light
    float begin;  ///< angles of the ends as seen from the light, relative to that point [rad]
    float end;
};

FogSampling::FogSampling(const World& world, LightSampling lights)
    : lights_(world.lights()), sampling_(lights)
{
    balls_.reserve(lights_.size());
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        const auto bounds = lights_[LightId{static_cast<std::uint32_t>(i)}].bounds();
        balls_.push_back(bounds ? Ball{bounds->center(), 0.5f * distance(bounds->min, bounds->max)}
                                : Ball{.radius = std::numeric_limits<float>::infinity()});
    }
}

/// Returns nullopt if sampling is uniform along the segment.
std::optional<FogSampling::Angles> FogSampling::angles(const FogSegment& fog,
                                                       LightId light) const noexcept
{
    // Limits of float precision for angles, and for tangents near a right angle.
    constexpr float min_angle = 1e-3f;
    constexpr float min_offset = 1e-3f;
    const Ball& ball = balls_[static_cast<std::size_t>(light)];
    const Vec3 to_light = ball.center - fog.origin;
    Angles seen{};
    seen.along = dot(to_light, fog.direction);
    const Vec3 across = to_light - seen.along * fog.direction;
    seen.away = std::max(std::sqrt(dot(across, across) + ball.radius * ball.radius),
                         min_offset * (fog.span.end - fog.span.begin));
    seen.begin = atan2_exact(fog.span.begin - seen.along, seen.away);
    seen.end = atan2_exact(fog.span.end - seen.along, seen.away);
    // False for a light at infinity, whose angles are zero.
    return seen.end - seen.begin > min_angle ? std::optional(seen) : std::nullopt;
}

float FogSampling::sample_distance(const FogSegment& fog, LightId light, float u) const noexcept
{
    const auto [begin, end] = fog.span;
    float distance = begin + u * (end - begin);
    if (const auto seen = angles(fog, light)) {
        const auto [sine, cosine] = sin_cos(seen->begin + u * (seen->end - seen->begin));
        distance = seen->along + seen->away * (sine / cosine);
    }
    return std::clamp(distance, begin, end);
}

float FogSampling::pdf_distance(const FogSegment& fog, LightId light, float distance) const noexcept
{
    const auto seen = angles(fog, light);
    if (!seen) {
        return 1.0f / (fog.span.end - fog.span.begin);
    }
    const float past = distance - seen->along;
    return seen->away / ((seen->end - seen->begin) * (seen->away * seen->away + past * past));
}

}  // namespace bdpt
