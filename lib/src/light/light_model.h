#pragma once

#include "light/light_samples.h"
#include "light/light_tree.h"

#include <bdpt/render_options.h>

#include <concepts>
#include <optional>

namespace bdpt {

/// Interface of every kind of light; `Light` documents the functions. All kinds have the same
/// arguments, even unused ones, so that all are called alike.
// clang-format off
template <typename T>
concept LightModel = requires(const T& light, Vec2 u, Vec3 v, const LightPoint& x0,
                              const LightSampleContext& receiver, EnvironmentSampling sampling,
                              float time)
{
    { T::is_delta } -> std::convertible_to<bool>;
    { T::is_infinite } -> std::convertible_to<bool>;
    { light.sample_emission(u, u, time) } -> std::convertible_to<std::optional<EmissionSample>>;
    { light.sample_incident(receiver, u, sampling, time) }
        -> std::convertible_to<std::optional<IncidentSample>>;
    { light.pdf_position(x0) } -> std::same_as<AreaPdf>;
    { light.pdf_incident(receiver, x0, sampling) } -> std::same_as<AreaPdf>;
    { light.pdf_direction(v, v, time) } -> std::same_as<SolidAnglePdf>;
    { light.power() } -> std::same_as<Rgb>;
    { light.bounds() } -> std::convertible_to<std::optional<LightBounds>>;
};
// clang-format on

/// Base of lights that no ray hits: their position or direction is fixed.
struct DeltaLight {
    static constexpr bool is_delta = true;

    [[nodiscard]] static AreaPdf pdf_position(const LightPoint& /*x0*/) { return {1.0f}; }
    [[nodiscard]] static AreaPdf pdf_incident(const LightSampleContext& /*receiver*/,
                                              const LightPoint& /*x0*/,
                                              EnvironmentSampling /*sampling*/)
    {
        return {1.0f};
    }
};

/// Base of lights at infinity.
struct InfiniteLight {
    static constexpr bool is_infinite = true;

    [[nodiscard]] static SolidAnglePdf pdf_direction(Vec3 /*ng*/, Vec3 /*direction*/,
                                                     float /*time*/)
    {
        return {};
    }
    [[nodiscard]] static std::optional<LightBounds> bounds() { return std::nullopt; }
};

}  // namespace bdpt
