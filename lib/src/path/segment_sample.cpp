#include "path/segment_sample.h"

#include <glm/geometric.hpp>

#include <limits>

namespace bdpt {
namespace {

/// Samples scattering in media before the surface, which is all that `event` contains so far.
void pass_media(SampleContext& sample, const SegmentEnd& origin, Vec3 direction, SegmentKey segment,
                const WalkPlace& place, SegmentSample& event)
{
    const Media& media = sample.world.media();
    SegmentEnd end;
    float distance = std::numeric_limits<float>::max();
    if (event.surface) {
        end = sample.world.end_at(*event.surface, direction, segment.time);
        distance = glm::distance(end.p, origin.p);
    }
    event.fog = media.fog_between(origin, end, direction, distance);
    const ChannelChoice channels(place.beta);
    if (media.scatter(origin, end, direction)) {
        const auto vertex = static_cast<std::uint32_t>(2 * place.vertices);
        sample.sampler.start(SampleUse::scatter_distance, vertex + (place.from_camera ? 0U : 1U));
        const Vec2 u = sample.sampler.next_2d();
        event.in_medium = media.draw_event(origin, end, direction, distance, channels, u);
    }
    if (event.in_medium) {
        distance = event.in_medium->distance;
        end = {.p = origin.p + distance * direction,
               .media = SideMedia::around(event.in_medium->medium)};
    }
    const Volumes& volumes = sample.world.volumes();
    if (volumes.any()) {
        const VolumePassage passage =
            volumes.walk(origin.p, direction, distance, channels, segment);
        event.in_volume = passage.event;
        event.passing_weight = passage.weight;
    }
    if (event.in_volume) {
        event.in_medium.reset();
        event.around = media.along(origin, end, direction);
        distance = event.in_volume->distance;
        end = {.p = origin.p + distance * direction, .media = SideMedia::around(event.around)};
    }
    event.transmission = media.transmission(origin, end, direction, distance);
    event.walk_density =
        media.walk_density(origin, end, direction, event.transmission.transmittance, channels,
                           event.in_medium.has_value());
}

/// Returns the distance to the end of a segment that ends after `event.surface` or before.
float distance_to_end(const SampleContext& sample, const SegmentEnd& origin, Vec3 direction,
                      SegmentKey segment, const SegmentSample& event)
{
    if (event.in_volume) {
        return event.in_volume->distance;
    }
    if (event.in_medium) {
        return event.in_medium->distance;
    }
    if (!event.surface) {
        return std::numeric_limits<float>::infinity();
    }
    return glm::distance(sample.world.end_at(*event.surface, direction, segment.time).p, origin.p);
}

}  // namespace

std::optional<RayHit> first_camera_hit(const World& world, Sampler& sampler, const SegmentEnd& lens,
                                       Vec3 direction, SegmentKey segment, bool& is_tinted)
{
    RayPassage record(PassageRule::record);
    const auto end = world.first_hit(lens, direction, segment, record);
    if (!record.has_all()) [[unlikely]] {
        return world.first_hit(lens, direction, segment, &is_tinted);
    }
    sampler.start(SampleUse::light_start, Sampler::first_crossing);
    for (const Crossing& crossing : record.crossings()) {
        if (sampler.next_1d() < crossing.opacity) {
            return world.hit_at(lens, direction, segment, crossing);
        }
        is_tinted = world.has_tinted_surfaces();
    }
    return end;
}

SegmentSample sample_segment(SampleContext& sample, const SegmentEnd& origin, Vec3 direction,
                             SegmentKey segment, const WalkPlace& place)
{
    bool is_tinted = false;
    const bool is_stratified =
        sample.world.has_passable_surfaces() && place.from_camera && place.vertices == 1;
    SegmentSample event([&] {
        return is_stratified ? first_camera_hit(sample.world, sample.sampler, origin, direction,
                                                segment, is_tinted)
                             : sample.world.first_hit(origin, direction, segment, &is_tinted);
    });
    if (sample.world.media().any() || sample.world.volumes().any()) {
        pass_media(sample, origin, direction, segment, place, event);
    }
    if (is_tinted) [[unlikely]] {
        const float distance = distance_to_end(sample, origin, direction, segment, event);
        event.passing_weight *=
            sample.world.tint(origin, direction, distance, segment, event.surface);
    }
    return event;
}

}  // namespace bdpt
