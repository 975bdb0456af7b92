#include "light/light.h"

namespace bdpt {

Light::Light(Model model)
    : model_(std::move(model)),
      is_delta_(std::visit([](const auto& light) { return light.is_delta; }, model_)),
      is_infinite_(std::visit([](const auto& light) { return light.is_infinite; }, model_))
{}

Light::Light(const LightDesc& desc, const LightContext& context)
    : Light(std::visit([&context](const auto& kind) { return make_model(kind, context); }, desc))
{
    media_ = SideMedia::around(context.medium);
}

std::optional<EmissionSample> Light::sample_emission(Vec2 u_position, Vec2 u_direction,
                                                     float time) const
{
    if (const auto* common = std::get_if<TriangleLight>(&model_)) {
        return common->sample_emission(u_position, u_direction, time);
    }
    auto sampled = std::visit(
        [=](const auto& light) -> std::optional<EmissionSample> {
            return light.sample_emission(u_position, u_direction, time);
        },
        model_);
    if (sampled) {
        sampled->end.media = media_;
    }
    return sampled;
}

std::optional<IncidentSample> Light::sample_incident(const LightSampleContext& receiver, Vec2 u,
                                                     EnvironmentSampling sampling, float time) const
{
    if (const auto* common = std::get_if<TriangleLight>(&model_)) [[likely]] {
        return common->sample_incident(receiver, u, sampling, time);
    }
    auto sampled = std::visit(
        [=](const auto& light) -> std::optional<IncidentSample> {
            return light.sample_incident(receiver, u, sampling, time);
        },
        model_);
    if (sampled) {
        sampled->end.media = media_;
    }
    return sampled;
}

AreaPdf Light::pdf_position(const LightPoint& x0) const
{
    return std::visit([&x0](const auto& light) { return light.pdf_position(x0); }, model_);
}

AreaPdf Light::pdf_incident(const LightSampleContext& receiver, const LightPoint& x0,
                            EnvironmentSampling sampling) const
{
    return std::visit([&](const auto& light) { return light.pdf_incident(receiver, x0, sampling); },
                      model_);
}

SolidAnglePdf Light::pdf_direction(Vec3 ng, Vec3 direction, float time) const
{
    return std::visit([=](const auto& light) { return light.pdf_direction(ng, direction, time); },
                      model_);
}

Rgb Light::power() const
{
    return std::visit([](const auto& light) { return light.power(); }, model_);
}

std::optional<LightBounds> Light::bounds() const
{
    return std::visit(
        [](const auto& light) -> std::optional<LightBounds> { return light.bounds(); }, model_);
}

}  // namespace bdpt
