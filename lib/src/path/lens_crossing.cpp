#include "path/connect.h"

#include "math/rgb.h"
#include "path/densities.h"

#include <glm/geometric.hpp>

#include <cmath>

namespace bdpt {

void look_for_lens(const SampleContext& sample, const WalkStep& step, float free_distance,
                   SegmentKey segment, Subpath& path)
{
    const auto hit = sample.camera.hit_lens(step.origin->p, step.direction);
    if (!hit || hit->distance >= free_distance || hit->distance * hit->distance < coincident) {
        return;
    }
    const float distance_squared = hit->distance * hit->distance;
    const float cosine = std::abs(dot(hit->lens.ng, step.direction));
    const PathVertex& last = path.back();
    const Media& media = sample.world.media();
    const SegmentTransmission transmission =
        media.transmission(*step.origin, hit->lens, step.direction, hit->distance);
    const ChannelChoice channels(step.beta);
    const float walk_density = media.walk_density(*step.origin, hit->lens, step.direction,
                                                  transmission.transmittance, channels, false);
    LensCrossing crossing;
    crossing.light_vertices = path.size();
    crossing.raster = hit->raster;
    crossing.importance = hit->importance;
    crossing.camera_at_light_end =
        last.kind == VertexKind::infinite
            ? AreaPdf{hit->pdf_direction.value * transmission.p_unscattered}
            : AreaPdf{hit->pdf_direction.value * abs_cosine(last.end, step.direction) /
                      distance_squared * pdf_of_end(last, transmission)};
    PathVertex& lens = crossing.lens;
    lens.kind = VertexKind::camera;
    lens.end = hit->lens;
    lens.beta = step.beta * (transmission.transmittance / walk_density) *
                sample.world.volumes().weight_of_passing(step.origin->p, step.direction,
                                                         hit->distance, channels, segment);
    if (sample.world.has_tinted_surfaces()) {
        lens.beta *= sample.world.tint(*step.origin, step.direction, hit->distance, segment);
    }
    // Both densities of the lens point: that of the light walk, and that of a camera path's start.
    lens.pdf_rev = step.pdf_of_point(cosine, distance_squared) * transmission.p_unscattered;
    lens.pdf_fwd = hit->pdf_lens;
    path.add_crossing(crossing);
}

std::optional<Contribution> hit_lens(const SampleContext& sample, const Subpath& light_path,
                                     const LensCrossing& crossing, PathWeigher& weigher)
{
    const Rgb value = crossing.lens.beta * crossing.importance;
    if (is_black(value)) {
        return std::nullopt;
    }
    const auto light = light_path.first(crossing.light_vertices);
    const AreaPdf next_event =
        light.size() > 1
            ? light[0].pdf_next_event
            : next_event_density(sample, light[0], crossing.lens, weigher.next_event_sampling());
    const AreaPdf neighbor = light.size() > 1 ? light[light.size() - 2].pdf_rev : AreaPdf{};
    const float weight = weigher.weight_of_hit(light, crossing.lens,
                                               {.light_at_camera_end = crossing.lens.pdf_rev,
                                                .light_at_camera_neighbor = {},
                                                .camera_at_light_end = crossing.camera_at_light_end,
                                                .camera_at_light_neighbor = neighbor,
                                                .next_event = next_event});
    return Contribution{.unweighted = value,
                        .weight = weight,
                        .dispersed = light.back().dispersed,
                        .raster = crossing.raster};
}

}  // namespace bdpt
