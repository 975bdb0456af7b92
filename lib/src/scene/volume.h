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
    float distance = 0.0f;    ///< [m]
    float extinction = 0.0f;  ///< there [1/m], > 0
    std::uint32_t volume = 0;
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

    /// Of a world point [1/m]: trilinear between the centres of voxels, zero outside of the grid.
    [[nodiscard]] float extinction(Vec3 p) const noexcept;
    /// Delta tracking: how far a walk gets before it is scattered, if it is; `direction` is unit.
    [[nodiscard]] std::optional<VolumeEvent> draw_event(Vec3 origin, Vec3 direction, float distance,
                                                        VolumeNoise noise) const noexcept;
    /// Ratio tracking: an unbiased estimate of what gets through, >= 0.
    [[nodiscard]] float transmittance(Vec3 origin, Vec3 direction, float distance,
                                      VolumeNoise noise) const noexcept;
    [[nodiscard]] Rgb albedo() const { return desc_.albedo; }
    [[nodiscard]] float anisotropy() const { return desc_.anisotropy; }

private:
    static constexpr std::uint32_t block = 8;  ///< voxels along each side

    [[nodiscard]] float density_at(Vec3 in_grid) const noexcept;
    [[nodiscard]] float voxel(int x, int y, int z) const noexcept;
    /// Calls `visit(point, majorant)` at points along the ray that are as frequent as if the
    /// extinction were the majorant of its block, until that returns false. `point` has a distance
    /// and the extinction there.
    template <typename Visit>
    void for_each_collision(Vec3 origin, Vec3 direction, float distance, VolumeNoise& noise,
                            const Visit& visit) const noexcept;

    const VolumeDesc& desc_;
    Mat4 grid_from_world_;
    UVec3 blocks_;
    std::vector<float> majorants_;  // of extinction [1/m], by block, x fastest
};

/// The volumes of a scene, each by itself: what a ray passes it passes through all.
class Volumes {
public:
    Volumes() = default;
    /// `descs` must outlive this.
    explicit Volumes(std::span<const VolumeDesc> descs);

    [[nodiscard]] bool any() const { return !volumes_.empty(); }
    [[nodiscard]] const Volume& operator[](std::uint32_t i) const { return volumes_[i]; }
    /// The first event of all.
    [[nodiscard]] std::optional<VolumeEvent> draw_event(Vec3 origin, Vec3 direction, float distance,
                                                        SegmentKey segment) const noexcept;
    [[nodiscard]] float transmittance(Vec3 origin, Vec3 direction, float distance,
                                      SegmentKey segment) const noexcept;

private:
    std::vector<Volume> volumes_;
};

}  // namespace bdpt
