#include "scene/volume.h"

#include "math/elementary.h"
#include "math/rgb.h"

#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bdpt {

Volume::Volume(const VolumeDesc& desc)
    : desc_(desc),
      grid_from_world_(glm::inverse(desc.world_from_grid)),
      blocks_((desc.size + (block - 1)) / block),
      max_extinction_(max_component(desc.extinction)),
      channel_shares_(max_extinction_ > 0.0f ? desc.extinction / max_extinction_ : Rgb(1.0f))
{
    majorants_.resize(std::size_t{blocks_.x} * blocks_.y * blocks_.z);
    // A density between centres affects the voxels on both sides.
    const auto find_blocks = [](std::uint32_t i, std::uint32_t count) {
        const std::uint32_t first = i == 0 ? 0 : (i - 1) / block;
        return UVec3(first, std::min((i + 1) / block, count - 1), 0);
    };
    std::size_t i = 0;
    for (std::uint32_t z = 0; z < desc.size.z; ++z) {
        const UVec3 bz = find_blocks(z, blocks_.z);
        for (std::uint32_t y = 0; y < desc.size.y; ++y) {
            const UVec3 by = find_blocks(y, blocks_.y);
            for (std::uint32_t x = 0; x < desc.size.x; ++x, ++i) {
                const UVec3 bx = find_blocks(x, blocks_.x);
                const float density = desc.density[i];
                for (std::uint32_t c = bz.x; c <= bz.y; ++c) {
                    for (std::uint32_t b = by.x; b <= by.y; ++b) {
                        for (std::uint32_t a = bx.x; a <= bx.y; ++a) {
                            float& most =
                                majorants_[(std::size_t{c} * blocks_.y + b) * blocks_.x + a];
                            most = std::max(most, density);
                        }
                    }
                }
            }
        }
    }
}

float Volume::voxel(int x, int y, int z) const noexcept
{
    const auto inside = [](int i, std::uint32_t count) {
        return i >= 0 && static_cast<std::uint32_t>(i) < count;
    };
    if (!inside(x, desc_.size.x) || !inside(y, desc_.size.y) || !inside(z, desc_.size.z)) {
        return 0.0f;
    }
    return desc_
        .density[(static_cast<std::size_t>(z) * desc_.size.y + static_cast<std::size_t>(y)) *
                     desc_.size.x +
                 static_cast<std::size_t>(x)];
}

float Volume::density_at(Vec3 in_grid) const noexcept
{
    if (!(in_grid.x >= 0.0f && in_grid.y >= 0.0f && in_grid.z >= 0.0f) ||
        !(in_grid.x <= static_cast<float>(desc_.size.x) &&
          in_grid.y <= static_cast<float>(desc_.size.y) &&
          in_grid.z <= static_cast<float>(desc_.size.z))) {
        return 0.0f;
    }
    const Vec3 p = in_grid - 0.5f;
    const Vec3 low = floor(p);
    const Vec3 t = p - low;
    const int x = static_cast<int>(low.x);
    const int y = static_cast<int>(low.y);
    const int z = static_cast<int>(low.z);
    const auto row = [&](int b, int c) {
        return voxel(x, b, c) + t.x * (voxel(x + 1, b, c) - voxel(x, b, c));
    };
    const auto plane = [&](int c) { return row(y, c) + t.y * (row(y + 1, c) - row(y, c)); };
    return plane(z) + t.z * (plane(z + 1) - plane(z));
}

template <typename Visit>
void Volume::for_each_collision(Vec3 origin, Vec3 direction, float distance, VolumeNoise& noise,
                                const Visit& visit) const noexcept
{
    // In units of blocks; t stays in metres.
    constexpr float per_block = 1.0f / static_cast<float>(block);
    const Vec3 o = per_block * Vec3(grid_from_world_ * Vec4(origin, 1.0f));
    const Vec3 d = per_block * Vec3(grid_from_world_ * Vec4(direction, 0.0f));
    const Vec3 extent = per_block * Vec3(desc_.size);
    float t = 0.0f;
    float end = distance;
    for (int axis = 0; axis < 3; ++axis) {
        if (d[axis] == 0.0f) {
            end = o[axis] >= 0.0f && o[axis] <= extent[axis] ? end : -1.0f;
            continue;
        }
        const float a = -o[axis] / d[axis];
        const float b = (extent[axis] - o[axis]) / d[axis];
        t = std::max(t, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    if (!(t < end)) {
        return;
    }
    const Vec3 entry = o + t * d;
    int cell[3];
    for (int axis = 0; axis < 3; ++axis) {
        const int last = static_cast<int>(blocks_[axis]) - 1;
        cell[axis] = std::clamp(static_cast<int>(std::floor(entry[axis])), 0, last);
    }
    while (t < end) {
        // Distance and side at which the ray leaves the block.
        int side = 0;
        float leave = std::numeric_limits<float>::infinity();
        for (int axis = 0; axis < 3; ++axis) {
            const float edge = static_cast<float>(cell[axis] + (d[axis] > 0.0f ? 1 : 0));
            const float at = d[axis] == 0.0f ? leave : (edge - o[axis]) / d[axis];
            if (at < leave) {
                leave = at;
                side = axis;
            }
        }
        const float stop = std::min(std::max(leave, t), end);
        const float majorant = majorants_[(static_cast<std::size_t>(cell[2]) * blocks_.y +
                                           static_cast<std::size_t>(cell[1])) *
                                              blocks_.x +
                                          static_cast<std::size_t>(cell[0])];
        const float rate = majorant * max_extinction_;
        // The distance to the next collision is memoryless, so each block draws it again. In
        // double, as a step may be too small for a float so far from the origin.
        double at = static_cast<double>(t);
        while (rate > 0.0f) {
            at += static_cast<double>(-log_exact(1.0f - noise.next()) / rate);
            if (!(at < static_cast<double>(stop))) {
                break;
            }
            t = static_cast<float>(at);
            const float here = density(origin + t * direction);
            if (!visit(VolumeEvent{.distance = t, .density = here},
                       here / majorant * channel_shares_)) {
                return;
            }
        }
        t = stop;
        cell[side] += d[side] > 0.0f ? 1 : -1;
        if (cell[side] < 0 || cell[side] >= static_cast<int>(blocks_[side])) {
            return;
        }
    }
}

std::optional<VolumeEvent> Volume::draw_event(Vec3 origin, Vec3 direction, float distance,
                                              int channel, VolumeNoise noise) const noexcept
{
    std::optional<VolumeEvent> event;
    for_each_collision(origin, direction, distance, noise, [&](const VolumeEvent& at, Rgb share) {
        if (noise.next() < share[channel]) {
            event = at;
        }
        return !event;
    });
    return event;
}

Rgb Volume::relative_pass_probability(Vec3 origin, Vec3 direction, float distance,
                                      VolumeNoise noise) const noexcept
{
    Rgb probability(1.0f);
    for_each_collision(origin, direction, distance, noise, [&](const VolumeEvent& at, Rgb share) {
        static_cast<void>(noise.next());  // the number that decides in `draw_event`
        if (at.distance >= distance) {
            return false;
        }
        probability *= max(1.0f - share, Rgb(0.0f));
        probability /= max_component(probability);  // otherwise the product of many would leave the
                                                    // range of floats
        return true;
    });
    return probability;
}

Rgb Volume::transmittance(Vec3 origin, Vec3 direction, float distance,
                          VolumeNoise noise) const noexcept
{
    constexpr float low = 0.1f;  // below, Russian roulette with probability 1/2
    Rgb left(1.0f);
    for_each_collision(origin, direction, distance, noise, [&](const VolumeEvent&, Rgb share) {
        left *= max(1.0f - share, Rgb(0.0f));
        if (max_component(left) < low) {
            left = noise.next() < 0.5f ? Rgb(0.0f) : 2.0f * left;
        }
        return !is_black(left);
    });
    return left;
}

Volumes::Volumes(std::span<const VolumeDesc> descs)
{
    volumes_.reserve(descs.size());
    for (const VolumeDesc& desc : descs) {
        volumes_.emplace_back(desc);
        are_grey_ = are_grey_ && volumes_.back().is_grey();
    }
}

VolumePassage Volumes::walk(Vec3 origin, Vec3 direction, float distance,
                            const ChannelChoice& channels, SegmentKey segment) const noexcept
{
    // A random number independent of those of the volumes.
    const float u = VolumeNoise(segment, static_cast<std::uint32_t>(volumes_.size())).next();
    const int channel = channels.sample(u);
    VolumePassage passage;
    auto& first = passage.event;
    for (std::uint32_t i = 0; i < volumes_.size(); ++i) {
        auto event = volumes_[i].draw_event(origin, direction, first ? first->distance : distance,
                                            channel, VolumeNoise(segment, i));
        if (event) {
            event->volume = i;
            first = event;
        }
    }
    if (!are_grey_) {
        passage.weight = colour_weight(origin, direction, distance, first, channels, segment);
    } else if (first) {
        passage.weight = 1.0f / volumes_[first->volume].extinction(first->density);
    }
    return passage;
}

/// Returns the transmittance over the mean of the channels' walk probabilities.
Rgb Volumes::colour_weight(Vec3 origin, Vec3 direction, float distance,
                           const std::optional<VolumeEvent>& event, const ChannelChoice& channels,
                           SegmentKey segment) const noexcept
{
    Rgb probability(1.0f);
    for (std::uint32_t i = 0; i < volumes_.size(); ++i) {
        probability *= volumes_[i].relative_pass_probability(
            origin, direction, event ? event->distance : distance, VolumeNoise(segment, i));
    }
    const Rgb found =
        event ? probability * volumes_[event->volume].extinction(event->density) : probability;
    return probability / channels.mean(found);
}

Rgb Volumes::transmittance(Vec3 origin, Vec3 direction, float distance,
                           SegmentKey segment) const noexcept
{
    Rgb left(1.0f);
    for (std::uint32_t i = 0; i < volumes_.size() && !is_black(left); ++i) {
        left *= volumes_[i].transmittance(origin, direction, distance, VolumeNoise(segment, i));
    }
    return left;
}

}  // namespace bdpt
