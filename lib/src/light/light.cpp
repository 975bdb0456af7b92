#include "light/light.h"

#include <glm/geometric.hpp>

namespace bdpt {

std::optional<EmissionSample> Light::sample_emission(Vec2 u_position, Vec2 u_direction,
                                                     float time) const
{
    if (const auto* light = std::get_if<TriangleLight>(&model_)) {
        return light->sample_emission(u_position, u_direction, time);
    }
    if (const auto* light = std::get_if<SphereLight>(&model_)) {
        return light->sample_emission(u_position, u_direction, time);
    }
    if (const auto* light = std::get_if<PunctualLight>(&model_)) {
        return light->sample_emission(u_direction, time);
    }
    if (const auto* light = std::get_if<DirectionalLight>(&model_)) {
        return light->sample_emission(u_position, time);
    }
    if (const auto* light = std::get_if<ProfileLight>(&model_)) {
        return light->sample_emission(u_direction, time);
    }
    return std::get<EnvironmentLight>(model_).sample_emission(u_position, u_direction);
}

std::optional<IncidentSample> Light::sample_incident(Vec3 receiver, Vec2 u,
                                                     EnvironmentSampling sampling, float time) const
{
    if (const auto* light = std::get_if<TriangleLight>(&model_)) {
        return light->sample_incident(receiver, u, time);
    }
    if (const auto* light = std::get_if<SphereLight>(&model_)) {
        return light->sample_incident(receiver, u, time);
    }
    if (const auto* light = std::get_if<PunctualLight>(&model_)) {
        return light->sample_incident(receiver, time);
    }
    if (const auto* light = std::get_if<DirectionalLight>(&model_)) {
        return light->sample_incident(time);
    }
    if (const auto* light = std::get_if<ProfileLight>(&model_)) {
        return light->sample_incident(receiver, time);
    }
    return std::get<EnvironmentLight>(model_).sample_incident(u, sampling);
}

AreaPdf Light::pdf_position(const LightPoint& x0) const
{
    if (const auto* light = std::get_if<TriangleLight>(&model_)) {
        return light->pdf_position(x0.barycentrics, x0.time);
    }
    if (const auto* light = std::get_if<SphereLight>(&model_)) {
        return light->pdf_position();
    }
    if (const auto* light = std::get_if<EnvironmentLight>(&model_)) {
        return {light->pdf_emission(x0.p).value};
    }
    return {1.0f};
}

AreaPdf Light::pdf_incident(Vec3 receiver, const LightPoint& x0, EnvironmentSampling sampling) const
{
    if (const auto* light = std::get_if<SphereLight>(&model_)) {
        return light->pdf_incident(receiver, x0.p, x0.ng, x0.time);
    }
    if (const auto* light = std::get_if<EnvironmentLight>(&model_)) {
        return {light->pdf_incident(x0.p, sampling).value};
    }
    return pdf_position(x0);  // the other kinds sample the same points for every receiver
}

SolidAnglePdf Light::pdf_direction(Vec3 ng, Vec3 direction, float time) const
{
    if (const auto* light = std::get_if<TriangleLight>(&model_)) {
        return light->pdf_direction(dot(ng, direction));
    }
    if (const auto* light = std::get_if<SphereLight>(&model_)) {
        return light->pdf_direction(ng, direction, time);
    }
    if (const auto* light = std::get_if<PunctualLight>(&model_)) {
        return light->pdf_direction(direction, time);
    }
    if (const auto* light = std::get_if<ProfileLight>(&model_)) {
        return light->pdf_direction(direction);
    }
    return {};
}

bool Light::is_delta() const
{
    return std::holds_alternative<PunctualLight>(model_) ||
           std::holds_alternative<DirectionalLight>(model_) ||
           std::holds_alternative<ProfileLight>(model_);
}

bool Light::is_infinite() const
{
    return std::holds_alternative<DirectionalLight>(model_) ||
           std::holds_alternative<EnvironmentLight>(model_);
}

Rgb Light::power() const
{
    return std::visit([](const auto& light) { return light.power(); }, model_);
}

std::optional<LightBounds> Light::bounds() const
{
    return std::visit(
        [](const auto& light) -> std::optional<LightBounds> {
            if constexpr (requires { light.bounds(); }) {
                return light.bounds();
            } else {
                return std::nullopt;
            }
        },
        model_);
}

}  // namespace bdpt
