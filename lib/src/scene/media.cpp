#include "scene/media.h"

#include "math/elementary.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

/// Returns the medium on the side of `end` towards which a ray in direction `w` leaves.
MediumId medium_towards(const SegmentEnd& end, Vec3 w)
{
    return dot(end.ng, w) < 0.0f ? end.media.behind : end.media.ahead;
}

/// Returns the transmittance by the Beer-Lambert law.
Rgb attenuate(Rgb optical_depth)
{
    return {exp_exact(-optical_depth.r), exp_exact(-optical_depth.g), exp_exact(-optical_depth.b)};
}

float mean(Rgb value)
{
    return (value.r + value.g + value.b) * (1.0f / 3.0f);
}

}  // namespace

MediumId Media::add(const Medium& medium)
{
    if (medium.is_clear()) {
        return MediumId::clear;
    }
    for (std::size_t i = 1; i < media_.size(); ++i) {
        const auto id = static_cast<MediumId>(i);
        // Fog is bounded; a body filled with the same medium is not.
        if (id != fog_ && media_[i] == medium) {
            return id;
        }
    }
    media_.push_back(medium);
    mean_scatterings_.push_back(1.0f);
    any_scatters_ = any_scatters_ || medium.scatters();
    return static_cast<MediumId>(media_.size() - 1);
}

MediumId Media::add_fog(const Medium& medium, const BoundingSphere& extent)
{
    fog_ = add(medium);
    extent_ = extent;
    return fog_;
}

MediumId Media::scatterer(const SegmentEnd& a, const SegmentEnd& b, Vec3 w) const noexcept
{
    const MediumId one = medium_towards(a, w);
    const MediumId other = medium_towards(b, -w);
    const bool one_scatters = (*this)[one].scatters();
    if (one == other || !(*this)[other].scatters()) {
        return one_scatters ? one : MediumId::clear;
    }
    if (!one_scatters) {
        return other;
    }
    const float density = mean((*this)[one].extinction);
    const float other_density = mean((*this)[other].extinction);
    return density > other_density || (density == other_density && one < other) ? one : other;
}

void Media::fill_body(MediumId id, float mean_chord)
{
    float& most = mean_scatterings_[static_cast<std::size_t>(id)];
    most = std::max(most, (*this)[id].mean_scatterings(mean_chord));
}

MediumId Media::along(const SegmentEnd& a, const SegmentEnd& b, Vec3 w) const noexcept
{
    if (const MediumId id = scatterer(a, b, w); id != MediumId::clear) {
        return id;
    }
    const MediumId one = medium_towards(a, w);
    return one != MediumId::clear ? one : medium_towards(b, -w);
}

FogSpan Media::filled(MediumId medium, Vec3 from, Vec3 w, float distance) const noexcept
{
    if (medium != fog_) {
        return {0.0f, distance};
    }
    using DVec3 = glm::dvec3;
    const DVec3 direction = glm::normalize(DVec3(w));
    const DVec3 offset = DVec3(from) - DVec3(extent_.center);
    const double radius = static_cast<double>(extent_.radius);
    const double middle = -dot(offset, direction);
    const double half_squared = middle * middle - (dot(offset, offset) - radius * radius);
    if (half_squared <= 0.0) {
        return {};
    }
    const double half = std::sqrt(half_squared);
    const double most = static_cast<double>(distance);
    return {static_cast<float>(std::clamp(middle - half, 0.0, most)),
            static_cast<float>(std::clamp(middle + half, 0.0, most))};
}

SegmentTransmission Media::transmission_through(const SegmentEnd& a, const SegmentEnd& b, Vec3 w,
                                                float distance) const noexcept
{
    const auto depth = [&](MediumId medium) {
        const FogSpan span = filled(medium, a.p, w, distance);
        return (*this)[medium].extinction * (span.end - span.begin);
    };
    const MediumId id = scatter(a, b, w) ? scatterer(a, b, w) : MediumId::clear;
    if (id == MediumId::clear) {
        return {.transmittance =
                    attenuate(max(depth(medium_towards(a, w)), depth(medium_towards(b, -w))))};
    }
    const Rgb left = attenuate(depth(id));
    return {.transmittance = left,
            .p_unscattered = mean(left),
            .pdf_scatter = mean((*this)[id].extinction * left)};
}

std::optional<FogSpan> Media::fog_between(const SegmentEnd& a, const SegmentEnd& b, Vec3 w,
                                          float distance) const noexcept
{
    if (fog_ == MediumId::clear || !scatter(a, b, w) || scatterer(a, b, w) != fog_) {
        return std::nullopt;
    }
    const FogSpan span = filled(fog_, a.p, w, distance);
    return span.begin < span.end ? std::optional(span) : std::nullopt;
}

std::optional<MediumEvent> Media::draw_event(const SegmentEnd& a, const SegmentEnd& b, Vec3 w,
                                             float distance, const ChannelChoice& channels,
                                             Vec2 u) const noexcept
{
    const MediumId id = scatterer(a, b, w);
    const FogSpan span = filled(id, a.p, w, distance);
    const int channel = channels.sample(u.y);
    const float extinction = (*this)[id].extinction[channel];
    const float way = -log_exact(1.0f - u.x);
    // Avoids a ratio that may be infinite.
    if (!(way < extinction * (span.end - span.begin))) {
        return std::nullopt;
    }
    return MediumEvent{.distance = std::min(span.begin + way / extinction, span.end), .medium = id};
}

float Media::walk_density(const SegmentEnd& a, const SegmentEnd& b, Vec3 w, Rgb transmittance,
                          const ChannelChoice& channels, bool in_medium) const noexcept
{
    if (!scatter(a, b, w)) {
        return 1.0f;
    }
    return channels.mean(in_medium ? (*this)[scatterer(a, b, w)].extinction * transmittance
                                   : transmittance);
}

}  // namespace bdpt
