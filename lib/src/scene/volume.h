#pragma once

#include "math/segment_key.h"

#include <bdpt/volume_desc.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// Where a ray is scattered in a volume.
struct VolumeEvent {
    float distance = 0.0f;  ///< [m]
    float density = 0.0f;   ///< there, > 0
    std::uint32_t volume = 0;
};

/// What a walk met in volumes.
struct VolumePassage {
    std::optional<VolumeEvent> event;
    /// What its throughput is multiplied by. Light gets through as often as walks do, so for grey
    /// extinction that is 1, or 1 over the extinction where it is scattered.
    Rgb weight{1.0f};
};

/// The random numbers of one segment in one volume: a sequence of its own.
class VolumeNoise {
public:
    VolumeNoise(SegmentKey segment, std::uint32_t volume)
        : segment_(segment), owner_(0xffffffffU - volume)
    {}
    /// Uniform in [0, 1).
    [[nodiscard]] float next() noexcept { return segment_.at_surface(owner_, next_++); }

private:
    SegmentKey segment_;
    std::uint32_t owner_;  ///< where no instance has its number
    std::uint32_t next_ = 0;
};

/// A `VolumeDesc` made ready for null-collision tracking [Novak et al. 2018, "Monte Carlo Methods
/// for Volumetric Light Transport Simulation", sec. 4 and 5]. Refers to its densities. Its bounds
/// of the density are those of blocks of voxels, through which rays go one after another.
class Volume {
public:
    explicit Volume(const VolumeDesc& desc);

    /// Of a world point: trilinear between the centres of voxels, zero outside of the grid.
    [[nodiscard]] float density(Vec3 p) const noexcept
    {
        return density_at(Vec3(grid_from_world_ * Vec4(p, 1.0f)));
    }
    /// [1/m]
    [[nodiscard]] Rgb extinction(float density) const { return density * desc_.extinction; }
    /// Delta tracking by one channel's extinction: how far a walk gets before it is scattered, if
    /// it is; `direction` is unit.
    [[nodiscard]] std::optional<VolumeEvent> draw_event(Vec3 origin, Vec3 direction, float distance,
                                                        int channel,
                                                        VolumeNoise noise) const noexcept;
    /// For each channel the probability that a walk with the same noise is not scattered before
    /// `distance`; their ratios are what counts.
    [[nodiscard]] Rgb relative_pass_probability(Vec3 origin, Vec3 direction, float distance,
                                                VolumeNoise noise) const noexcept;
    /// Ratio tracking: an unbiased estimate of what gets through, >= 0.
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
    /// Calls `visit(point, share)` at points along the ray that are as frequent as if the density
    /// were the majorant of its block and each channel had the greatest extinction of the three,
    /// until that returns false. `share` is for each channel its part of that extinction.
    template <typename Visit>
    void for_each_collision(Vec3 origin, Vec3 direction, float distance, VolumeNoise& noise,
                            const Visit& visit) const noexcept;

    const VolumeDesc& desc_;
    Mat4 grid_from_world_;
    UVec3 blocks_;
    float max_extinction_;          // of the channels [1/m], where the density is 1
    Rgb channel_shares_;            // of it
    std::vector<float> majorants_;  // of the density, by block, x fastest
};

/// The volumes of a scene, each by itself: what a ray passes it passes through all.
class Volumes {
public:
    Volumes() = default;
    /// `descs` must outlive this.
    explicit Volumes(std::span<const VolumeDesc> descs);

    [[nodiscard]] bool any() const { return !volumes_.empty(); }
    [[nodiscard]] const Volume& operator[](std::uint32_t i) const { return volumes_[i]; }
    /// A walk to the first event of all. One channel, drawn by chance, decides how far it gets, and
    /// the walks of all three are weighed by the balance heuristic [Miller et al. 2019, "A
    /// Null-Scattering Path Integral Formulation of Light Transport", sec. 5.2].
    [[nodiscard]] VolumePassage walk(Vec3 origin, Vec3 direction, float distance,
                                     SegmentKey segment) const noexcept;
    /// What the throughput of a walk is multiplied by that passes `distance` without an event,
    /// where its `walk` with the same segment ends there or farther on.
    [[nodiscard]] Rgb weight_of_passing(Vec3 origin, Vec3 direction, float distance,
                                        SegmentKey segment) const noexcept
    {
        return are_grey_ ? Rgb(1.0f)
                         : colour_weight(origin, direction, distance, std::nullopt, segment);
    }
    [[nodiscard]] Rgb transmittance(Vec3 origin, Vec3 direction, float distance,
                                    SegmentKey segment) const noexcept;

private:
    [[nodiscard]] Rgb colour_weight(Vec3 origin, Vec3 direction, float distance,
                                    const std::optional<VolumeEvent>& event,
                                    SegmentKey segment) const noexcept;

    std::vector<Volume> volumes_;
    bool are_grey_ = true;
};

}  // namespace bdpt
