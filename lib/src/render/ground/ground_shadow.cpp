#include "render/ground/ground_shadow.h"

#include "geometry/ray.h"
#include "math/random_numbers.h"
#include "math/rgb.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <variant>

namespace bdpt {
namespace {

constexpr Vec3 up(0.0f, 1.0f, 0.0f);

/// Tests whether an estimate is black, or not finite because the light is too close.
bool is_useless(Rgb estimate)
{
    return is_black(estimate) || !is_finite(estimate);
}

enum class RayUse : std::uint32_t { sky, sun, lamp, choice_of_lamp };

/// Returns the index of a random number: each light, and each shadow ray, has its own.
std::uint32_t number_of_ray(RayUse kind, int sample)
{
    constexpr std::uint32_t kinds = 4;
    return kinds * static_cast<std::uint32_t>(sample) + static_cast<std::uint32_t>(kind);
}

}  // namespace

/// A point on the ground, with the data needed to sample its light.
struct GroundShadow::Point {
    SegmentEnd end;
    std::size_t place;  // index in `occluders_`
    TimeAndWavelength moment;
    Sampler& sampler;
    RayCounts& rays;

    [[nodiscard]] LightSampleContext receiver() const { return {.p = end.p, .normal = up}; }
    /// Returns the key of a shadow ray. The camera subpath has no second vertex, so segments to it
    /// are unused.
    [[nodiscard]] SegmentKey segment(std::uint32_t number) const
    {
        SegmentKey key = sampler.segment_key(static_cast<int>(number), 2);
        key.wavelength = moment.wavelength;
        key.time = moment.time;
        return key;
    }
};

GroundShadow::GroundShadow(const World& world, const RenderOptions& options)
    : world_(world),
      height_(options.film.ground_height
                  ? static_cast<float>(static_cast<double>(*options.film.ground_height) -
                                       world.description().origin.y)
                  : world.bounds().min.y)
{
    if (!options.film.aovs.contains(Aov::shadow)) {
        return;
    }
    occluders_.emplace(world.geometry(), height_);
    const LightSet& lights = world.lights();
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        const LightId id{i};
        if (id == lights.environment()) {
            sky_.emplace(std::get<EnvironmentLight>(lights[id].model()), *occluders_);
        } else if (lights[id].is_infinite()) {
            suns_.push_back(id);
        }
    }
    if (!lights.has_placed()) {
        return;
    }
    find_shining_meshes();
    float elsewhere = sky_ ? sky_->irradiance() : 0.0f;
    for (const LightId id : suns_) {
        const auto light = lights[id].sample_incident({.p = Vec3(0.0f), .normal = up}, Vec2(0.5f),
                                                      EnvironmentSampling::plain, 0.5f);
        elsewhere += light ? luminance(std::max(light->wi.y, 0.0f) * light->weight) : 0.0f;
    }
    // If there are only local lights, they cause all of the noise.
    lamp_samples_ = elsewhere > 0.0f ? 1 : 2;
    lamps_.emplace(lights, *occluders_, height_, elsewhere);
}

void GroundShadow::find_shining_meshes()
{
    const LightSet& lights = world_.lights();
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        if (const auto* triangle = std::get_if<TriangleLight>(&lights[LightId{i}].model())) {
            Box& box = shining_[&triangle->surface()];
            const LightBounds bounds = triangle->bounds();
            box = {.min = glm::min(box.min, bounds.min), .max = glm::max(box.max, bounds.max)};
        }
    }
}

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

std::optional<GroundLight> GroundShadow::light_at(const CameraRay& ray,
                                                  const TimeAndWavelength& moment, Sampler& sampler,
                                                  RayCounts& rays) const
{
    const auto end = meet(ray);
    if (!end) {
        return std::nullopt;
    }
    const Point point{.end = *end,
                      .place = occluders_->place(end->p),
                      .moment = moment,
                      .sampler = sampler,
                      .rays = rays};
    Light sum;
    add_sky(point, sum);
    add_suns(point, sum);
    add_lamps(point, sum);
    return GroundLight{.unshadowed = sum.all, .shadowed = sum.all - sum.blocked};
}

std::optional<GroundShadow::Part> GroundShadow::part_between(
    const std::array<CameraRay, 4>& corners) const
{
    if (!suns_.empty()) {
        return std::nullopt;
    }
    Vec3 low(std::numeric_limits<float>::infinity());
    Vec3 high(-std::numeric_limits<float>::infinity());
    for (const CameraRay& corner : corners) {
        const auto end = meet(corner);
        if (!end) {
            return std::nullopt;
        }
        low = min(low, end->p);
        high = max(high, end->p);
    }
    Part part{.irradiance = sky_ ? sky_->irradiance() : 0.0f};
    constexpr std::size_t side = GroundOccluders::side;
    const std::size_t first = occluders_->place(low);
    const std::size_t last = occluders_->place(high);
    for (std::size_t row = first / side; row <= last / side; ++row) {
        for (std::size_t column = first % side; column <= last % side; ++column) {
            const std::size_t place = row * side + column;
            if (sky_ && !occluders_->empty()) {
                part.sky_chance = std::max(part.sky_chance, sky_->effort(place).chance);
            }
            if (lamps_) {
                part.lamp_chance = std::max(part.lamp_chance, lamps_->chance(place));
            }
            if (std::max(part.sky_chance, part.lamp_chance) >= 1.0f) {
                return std::nullopt;
            }
        }
    }
    return part;
}

bool GroundShadow::may_sample(const Part& part, const Sampler& sampler) const
{
    const auto is_below = [&](float chance, RayUse kind, int sample) {
        return chance > 0.0f &&
               sampler.ordered_1d(SampleUse::ground, number_of_ray(kind, sample)) < chance;
    };
    bool result = is_below(part.sky_chance, RayUse::sky, 0);
    for (int i = 0; i < lamp_samples_ && !result; ++i) {
        result = is_below(part.lamp_chance, RayUse::lamp, i);
    }
    return result;
}

void GroundShadow::add(Light& sum, const Light& light, float weight)
{
    sum.all += weight * light.all;
    sum.blocked += weight * light.blocked;
}

/// Adds light of the sky. The number of samples increases with the fraction of the sky that the
/// scene may block: only that part is noisy.
void GroundShadow::add_sky(const Point& point, Light& sum) const
{
    if (!sky_) {
        return;
    }
    sum.all = sky_->irradiance();
    if (occluders_->empty()) {
        return;
    }
    const GroundSky::Effort effort = sky_->effort(point.place);
    if (effort.samples > 1) {
        sum = sample_sky(point, effort);
    } else if (effort.samples == 1) {
        sum.blocked = blocked_light(point, effort);
    }
}

/// Estimates light that the scene blocks, where it is a small part of all. Most estimates are zero.
float GroundShadow::blocked_light(const Point& point, const GroundSky::Effort& effort) const
{
    const std::uint32_t number = number_of_ray(RayUse::sky, 0);
    if (!(point.sampler.ordered_1d(SampleUse::ground, number) < effort.chance)) {
        return 0.0f;
    }
    Vec2 u = point.sampler.ordered_2d(SampleUse::ground, number);
    u.x /= effort.chance;
    const GroundSky::Sample sample = sky_->sample(point.place, u);
    if (!(sample.over_density > 0.0f)) {
        return 0.0f;
    }
    ++point.rays.aov;
    const Rgb opacity =
        1.0f - world_.transmittance_to_infinity(point.end, sample.to_light, point.segment(number));
    if (is_black(opacity)) {
        return 0.0f;
    }
    const Rgb blocked = sky_->irradiance(sample) * opacity;
    return is_useless(blocked) ? 0.0f : effort.weight * luminance(blocked);
}

/// Estimates light and what is blocked of it from the same samples, so that both are equally wrong:
/// the shadow is exact where all is blocked.
GroundShadow::Light GroundShadow::sample_sky(const Point& point,
                                             const GroundSky::Effort& effort) const
{
    Light sum{.all = sky_->shares(point.place).open};
    const Vec2 first = point.sampler.ordered_2d(SampleUse::ground, number_of_ray(RayUse::sky, 0));
    for (std::uint32_t i = 0; i < effort.samples; ++i) {
        const GroundSky::Sample sample =
            sky_->sample(point.place, shifted_point(first, i, effort.samples));
        const Rgb irradiance = sky_->irradiance(sample);
        if (is_useless(irradiance)) {
            continue;
        }
        ++point.rays.aov;
        const std::uint32_t number = number_of_ray(RayUse::sky, static_cast<int>(i));
        const Rgb opacity = 1.0f - world_.transmittance_to_infinity(point.end, sample.to_light,
                                                                    point.segment(number));
        add(sum, {luminance(irradiance), luminance(irradiance * opacity)}, effort.weight);
    }
    return sum;
}

void GroundShadow::add_suns(const Point& point, Light& sum) const
{
    // If there are more lights, a random subset is weighted by the inverse of its fraction.
    constexpr std::size_t most = 4;
    const std::size_t samples = std::min(suns_.size(), most);
    for (std::size_t i = 0; i < samples; ++i) {
        const std::uint32_t number = number_of_ray(RayUse::sun, static_cast<int>(i));
        std::size_t which = i;
        if (suns_.size() > most) {
            point.sampler.start(SampleUse::ground, number);
            const float u = point.sampler.next_1d();
            which = static_cast<std::size_t>(
                (static_cast<double>(i) + static_cast<double>(u)) *
                (static_cast<double>(suns_.size()) / static_cast<double>(most)));
        }
        const LightId id = suns_[which];
        const auto light = world_.lights()[id].sample_incident(
            point.receiver(), Vec2(0.5f), EnvironmentSampling::plain, point.moment.time);
        if (light && light->wi.y > 0.0f) {
            add(sum, past_scene(point, id, *light, light->wi.y * light->weight, number),
                static_cast<float>(suns_.size()) / static_cast<float>(samples));
        }
    }
}

void GroundShadow::add_lamps(const Point& point, Light& sum) const
{
    if (!lamps_) {
        return;
    }
    const float chance = lamps_->chance(point.place);
    const LightSet& lights = world_.lights();
    for (int i = 0; i < lamp_samples_; ++i) {
        const std::uint32_t number = number_of_ray(RayUse::lamp, i);
        if (!(point.sampler.ordered_1d(SampleUse::ground, number) < chance)) {
            continue;
        }
        Vec2 u = point.sampler.ordered_2d(SampleUse::ground, number);
        u.x /= chance;
        point.sampler.start(SampleUse::ground, number_of_ray(RayUse::choice_of_lamp, i));
        const auto choice =
            lights.choose_placed(point.receiver(), fine_uniform(point.sampler.next_fine()));
        if (!choice) {
            continue;
        }
        const auto light = lights[choice->id].sample_incident(
            point.receiver(), u, EnvironmentSampling::plain, point.moment.time);
        if (light && light->wi.y > 0.0f) {
            add(sum,
                past_scene(point, choice->id, *light,
                           light->wi.y / choice->probability * light->weight, number),
                1.0f / (chance * static_cast<float>(lamp_samples_)));
        }
    }
}

GroundShadow::Light GroundShadow::past_scene(const Point& point, LightId id,
                                             const IncidentSample& light, Rgb irradiance,
                                             std::uint32_t ray) const
{
    if (is_useless(irradiance)) {
        return {};
    }
    const float all = luminance(irradiance);
    if (!occluders_->may_block(point.place, light.wi)) {
        return {.all = all};
    }
    ++point.rays.aov;
    const SegmentKey segment = point.segment(ray);
    const Rgb open = world_.lights()[id].is_infinite()
                         ? world_.transmittance_to_infinity(point.end, light.wi, segment)
                         : world_.transmittance(point.end, light.end, segment);
    if (is_black(open) && hides_itself(point, id, light, segment)) {
        return {};
    }
    return {.all = all, .blocked = luminance(irradiance * (1.0f - open))};
}

bool GroundShadow::hides_itself(const Point& point, LightId id, const IncidentSample& light,
                                SegmentKey segment) const
{
    const LightSet& lights = world_.lights();
    const auto* triangle = std::get_if<TriangleLight>(&lights[id].model());
    if (triangle == nullptr) {
        return false;
    }
    // Other surfaces on the way do not matter.
    constexpr int max_surfaces = 64;
    const Box& box = shining_.find(&triangle->surface())->second;
    SegmentEnd from = light.end;
    for (int i = 0; i < max_surfaces; ++i) {
        ++point.rays.aov;
        const auto hit = world_.first_hit(from, -light.wi, segment);
        if (!hit || hit->sphere != no_sphere) {
            return false;
        }
        const Vec3 p = hit->at.point.p;
        const float error = hit->at.point.error;
        const bool is_inside = glm::all(glm::greaterThanEqual(p, box.min - error)) &&
                               glm::all(glm::lessThanEqual(p, box.max + error));
        if (!is_inside || p.y <= height_) {
            return false;  // and so is all that follows
        }
        const auto met = lights.of_triangle(hit->instance, hit->triangle);
        if (met &&
            &std::get<TriangleLight>(lights[*met].model()).surface() == &triangle->surface()) {
            return true;
        }
        from = {.p = p, .error = error, .ng = hit->at.ng};
    }
    return false;
}

}  // namespace bdpt
