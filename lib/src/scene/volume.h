#pragma once

#include "math/random_numbers.h"
#include "math/rgb.h"

#include <bdpt/volume_desc.h>

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// Scattering event in a volume.
struct VolumeEvent {
    float distance = 0.0f;  ///< [m]
    float density = 0.0f;   ///< density at the event, > 0
    std::uint32_t volume = 0;
};

/// Result of a walk through volumes.
struct VolumePassage {
    std::optional<VolumeEvent> event;
    /// Factor of the throughput. Walks are transmitted with the probability of the light, so for
    /// grey extinction it is 1, or 1 over the extinction at the event.
    Rgb weight{1.0f};
};

/// Random numbers of one segment in one volume: an independent sequence.
class VolumeNoise {
public:
    VolumeNoise(SegmentKey segment, std::uint32_t volume)
        : segment_(segment), owner_(0xffffffffU - volume)
    {}
    /// Returns a number uniform in [0, 1).
    [[nodiscard]] float next() noexcept { return segment_.at_surface(owner_, next_++); }

private:
    SegmentKey segment_;
    std::uint32_t owner_;  ///< number that no instance has
    std::uint32_t next_ = 0;
};

/// A `VolumeDesc` prepared for null-collision tracking [Novak et al. 2018, "Monte Carlo Methods for
/// Volumetric Light Transport Simulation", sec. 4 and 5]. Refers to its densities. Majorants are
/// those of blocks of voxels, which rays traverse one after another.
class Volume {
public:
    explicit Volume(const VolumeDesc& desc);

    /// Returns the density at a world point: trilinear between the centres of voxels, zero outside
    /// of the grid.
    [[nodiscard]] float density(Vec3 p) const noexcept
    {
        return density_at(Vec3(grid_from_world_ * Vec4(p, 1.0f)));
    }
    /// Returns the extinction for a density [1/m].
    [[nodiscard]] Rgb extinction(float density) const { return density * desc_.extinction; }
    /// Samples a scattering event by delta tracking with one channel's extinction; nullopt if there
    /// is none within `distance`; `direction` is unit length.
    [[nodiscard]] std::optional<VolumeEvent> draw_event(Vec3 origin, Vec3 direction, float distance,
                                                        int channel,
                                                        VolumeNoise noise) const noexcept;
    /// Returns for each channel the probability that a walk with the same noise is not scattered
    /// before `distance`, up to a common factor.
    [[nodiscard]] Rgb relative_pass_probability(Vec3 origin, Vec3 direction, float distance,
                                                VolumeNoise noise) const noexcept;
    /// Estimates the transmittance without bias by ratio tracking, >= 0.
    [[nodiscard]] Rgb transmittance(Vec3 origin, Vec3 direction, float distance,
                                    VolumeNoise noise) const noexcept;
    [[nodiscard]] bool is_grey() const
    {
        return desc_.extinction.r == desc_.extinction.g && desc_.extinction.r == desc_.extinction.b;
    }
    [[nodiscard]] Rgb albedo() const { return desc_.albedo; }
    [[nodiscard]] float anisotropy() const { return desc_.anisotropy; }

private:
    static constexpr std::uint32_t block = 8;  ///< voxels along each side

    [[nodiscard]] float density_at(Vec3 in_grid) const noexcept;
    [[nodiscard]] float voxel(int x, int y, int z) const noexcept;
    /// Calls `visit(point, share)` at collisions along the ray, as frequent as if the density were
    /// the majorant of its block and each channel had the maximum extinction of the three, until it
    /// returns false. `share` is each channel's fraction of that extinction.
    template <typename Visit>
    void for_each_collision(Vec3 origin, Vec3 direction, float distance, VolumeNoise& noise,
                            const Visit& visit) const noexcept;

    const VolumeDesc& desc_;
    Mat4 grid_from_world_;
    UVec3 blocks_;
    float max_extinction_;          // maximum extinction of the channels where the density is 1
                                    // [1/m]
    Rgb channel_shares_;            // extinction of each channel over `max_extinction_`
    std::vector<float> majorants_;  // majorants of the density, one per block, x varies fastest
};

/// The volumes of a scene, each independent of the others: a ray is transmitted if all volumes
/// transmit it.
class Volumes {
public:
    Volumes() = default;
    /// `descs` must outlive this.
    explicit Volumes(std::span<const VolumeDesc> descs);

    [[nodiscard]] bool any() const { return !volumes_.empty(); }
    [[nodiscard]] const Volume& operator[](std::uint32_t i) const { return volumes_[i]; }
    /// Walks to the first scattering event of all volumes. One of the channels determines the
    /// distance, and the walks of all three are weighted by the balance heuristic [Miller et al.
    /// 2019, "A Null-Scattering Path Integral Formulation of Light Transport", sec. 5.2].
    [[nodiscard]] VolumePassage walk(Vec3 origin, Vec3 direction, float distance,
                                     const ChannelChoice& channels,
                                     SegmentKey segment) const noexcept;
    /// Returns the throughput factor of a walk that passes `distance` without an event, if its
    /// `walk` with the same segment ends there or farther on.
    [[nodiscard]] Rgb weight_of_passing(Vec3 origin, Vec3 direction, float distance,
                                        const ChannelChoice& channels,
                                        SegmentKey segment) const noexcept
    {
        return are_grey_
                   ? Rgb(1.0f)
                   : colour_weight(origin, direction, distance, std::nullopt, channels, segment);
    }
    [[nodiscard]] Rgb transmittance(Vec3 origin, Vec3 direction, float distance,
                                    SegmentKey segment) const noexcept;

private:
    [[nodiscard]] Rgb colour_weight(Vec3 origin, Vec3 direction, float distance,
                                    const std::optional<VolumeEvent>& event,
                                    const ChannelChoice& channels,
                                    SegmentKey segment) const noexcept;

    std::vector<Volume> volumes_;
    bool are_grey_ = true;
};

}  // namespace bdpt
