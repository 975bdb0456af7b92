#include "path/encounter.h"

#include <glm/geometric.hpp>

#include <limits>

namespace bdpt {
namespace {

/// Is the ray, to which nothing but its surface is known, scattered before that?
void pass_media(SampleContext& sample, const SegmentEnd& origin, Vec3 direction, SegmentKey segment,
                const WalkPlace& place, Encounter& met)
{
    const Media& media = sample.world.media();
    SegmentEnd end;
    float distance = std::numeric_limits<float>::max();
    if (met.surface) {
        end = sample.world.end_at(*met.surface, direction, segment.time);
        distance = glm::distance(end.p, origin.p);
    }
    met.fog = media.fog_between(origin, end, direction, distance);
    if (media.scatter(origin, end, direction)) {
        const auto vertex = static_cast<std::uint32_t>(2 * place.vertices);
        sample.sampler.start(SampleUse::flight, vertex + (place.from_camera ? 0U : 1U));
        const Vec2 u = sample.sampler.next_2d();
        met.in_medium = media.draw_event(origin, end, direction, distance, u);
    }
    if (met.in_medium) {
        distance = met.in_medium->distance;
        end = {.p = origin.p + distance * direction,
               .media = SideMedia::around(met.in_medium->medium)};
    }
    const Volumes& volumes = sample.world.volumes();
    if (volumes.any()) {
        const VolumePassage passage = volumes.walk(origin.p, direction, distance, segment);
        met.in_volume = passage.event;
        met.volume_weight = passage.weight;
    }
    if (met.in_volume) {
        met.in_medium.reset();
        met.around = media.along(origin, end, direction);
        distance = met.in_volume->distance;
        end = {.p = origin.p + distance * direction, .media = SideMedia::around(met.around)};
    }
    met.flight = media.flight(origin, end, direction, distance);
}

}  // namespace

Encounter follow(SampleContext& sample, const SegmentEnd& origin, Vec3 direction,
                 SegmentKey segment, const WalkPlace& place)
{
    Encounter met([&] { return sample.world.first_hit(origin, direction, segment); });
    if (sample.world.media().any() || sample.world.volumes().any()) {
        pass_media(sample, origin, direction, segment, place, met);
    }
    return met;
}

}  // namespace bdpt
