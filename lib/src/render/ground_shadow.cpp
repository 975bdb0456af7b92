#include "render/ground_shadow.h"

#include "geometry/rounding.h"
#include "math/rgb.h"
#include "math/warp.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <variant>

namespace bdpt {
namespace {

/// Points on lights, and as many directions if there is a sky, for each camera ray.
constexpr int samples_of_light = 2;

constexpr Vec3 up(0.0f, 1.0f, 0.0f);

/// Light that brings nothing, or comes from so near that it is no number.
bool is_useless(Rgb estimate)
{
    return is_black(estimate) || !is_finite(estimate);
}

/// Of an estimate of irradiance and the share that gets past the scene.
GroundLight light_of(Rgb estimate, Rgb open)
{
    return {.unshadowed = luminance(estimate), .shadowed = luminance(estimate * open)};
}

}  // namespace

/// Of the ground, with all that sampling it needs.
struct GroundShadow::Point {
    SegmentEnd end;
    SampleMoment moment;
    Sampler& sampler;
    RayCounts& rays;

    [[nodiscard]] LightSampleContext receiver() const { return {.p = end.p, .normal = up}; }
    /// Of a shadow ray. The camera subpath has no second vertex, so segments to it are free.
    [[nodiscard]] SegmentKey segment(int number) const
    {
        SegmentKey key = sampler.segment_key(number, 2);
        key.wavelength = moment.wavelength;
        key.time = moment.time;
        return key;
    }
};

GroundShadow::GroundShadow(const World& world, const RenderOptions& options)
    : world_(world),
      height_(options.film.ground_height.value_or(world.bounds().min.y)),
      sampling_{.environments = options.sampling.environment, .lights = options.sampling.lights}
{}

std::optional<SegmentEnd> GroundShadow::meet(const CameraRay& ray) const
{
    const float above = ray.lens.p.y - height_;
    if (!(above > 0.0f && ray.direction.y < 0.0f)) {
        return std::nullopt;
    }
    Vec3 p = ray.lens.p - above / ray.direction.y * ray.direction;
    p.y = height_;
    const float farthest = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    if (!(farthest <= world_.farthest_origin())) {
        return std::nullopt;  // at the horizon
    }
    return SegmentEnd{.p = p, .error = rounding_bound(8) * farthest, .ng = up};
}

std::optional<GroundLight> GroundShadow::light_at(const CameraRay& ray, const SampleMoment& moment,
                                                  Sampler& sampler, RayCounts& rays) const
{
    const auto end = meet(ray);
    if (!end) {
        return std::nullopt;
    }
    const Point point{.end = *end, .moment = moment, .sampler = sampler, .rays = rays};
    GroundLight sum;
    const auto add = [&sum](const GroundLight& light) {
        constexpr float share = 1.0f / samples_of_light;
        sum.unshadowed += share * light.unshadowed;
        sum.shadowed += share * light.shadowed;
    };
    for (int i = 0; i < samples_of_light; ++i) {
        add(sampled_light(point, i));
        if (world_.lights().environment()) {
            add(sampled_sky(point, i));
        }
    }
    return sum;
}

GroundLight GroundShadow::sampled_light(const Point& point, int number) const
{
    const LightSet& lights = world_.lights();
    Sampler& sampler = point.sampler;
    sampler.start(SampleUse::ground, static_cast<std::uint32_t>(2 * number));
    const Vec2 u = sampler.next_2d();
    const auto found = lights.sample_next_event(
        point.receiver(), u, [&] { return sampler.next_fine(); }, sampling_, point.moment.time);
    if (!found.incident || !(found.incident->wi.y > 0.0f)) {
        return {};
    }
    const IncidentSample& incident = *found.incident;
    const float cosine = incident.wi.y;
    Rgb estimate = cosine / found.probability * incident.weight;
    if (found.light == lights.environment()) {
        const float pdf = found.pdf().value;
        estimate *= pdf / (pdf + cosine_hemisphere_pdf(cosine).value);
    }
    if (is_useless(estimate)) {
        return {};
    }
    ++point.rays.aov;
    const SegmentKey segment = point.segment(2 * number);
    const Rgb open = lights[found.light].is_infinite()
                         ? world_.transmittance_to_infinity(point.end, incident.wi, segment)
                         : world_.transmittance(point.end, incident.end, segment);
    if (is_black(open) && hides_itself(point, found.light, incident, segment)) {
        return {};
    }
    return light_of(estimate, open);
}

GroundLight GroundShadow::sampled_sky(const Point& point, int number) const
{
    const LightSet& lights = world_.lights();
    const LightId id = *lights.environment();
    const auto& sky = std::get<EnvironmentLight>(lights[id].model());
    point.sampler.start(SampleUse::ground, static_cast<std::uint32_t>(2 * number + 1));
    const Vec3 local = square_to_cosine_hemisphere(point.sampler.next_2d());
    const float cosine = local.z;
    const Vec3 direction(local.x, cosine, local.y);
    const float competing =
        lights.next_event_pdf(id, {.p = direction}, point.receiver(), sampling_).value;
    const float pdf = cosine_hemisphere_pdf(cosine).value;
    const Rgb estimate = cosine / (pdf + competing) * sky.radiance(direction);
    if (!(cosine > 0.0f) || is_useless(estimate)) {
        return {};
    }
    ++point.rays.aov;
    const SegmentKey segment = point.segment(2 * number + 1);
    return light_of(estimate, world_.transmittance_to_infinity(point.end, direction, segment));
}

bool GroundShadow::hides_itself(const Point& point, LightId id, const IncidentSample& light,
                                SegmentKey segment) const
{
    const LightSet& lights = world_.lights();
    const auto* triangle = std::get_if<TriangleLight>(&lights[id].model());
    if (triangle == nullptr) {
        return false;
    }
    // Whatever else there is on the way, it does not matter.
    constexpr int most_surfaces = 64;
    SegmentEnd from = point.end;
    for (int i = 0; i < most_surfaces; ++i) {
        ++point.rays.aov;
        const auto hit = world_.first_hit(from, light.wi, segment);
        if (!hit || hit->sphere != no_sphere) {
            return false;
        }
        const float so_far = dot(hit->at.point.p - point.end.p, light.wi);
        if (so_far + hit->at.point.error + light.end.error >= light.distance) {
            return false;
        }
        const auto met = lights.of_triangle(hit->instance, hit->triangle);
        if (met && triangle->is_of_same_surface(std::get<TriangleLight>(lights[*met].model()))) {
            return true;
        }
        from = {.p = hit->at.point.p, .error = hit->at.point.error, .ng = hit->at.ng};
    }
    return false;
}

}  // namespace bdpt
