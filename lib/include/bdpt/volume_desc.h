#pragma once

/// @file
/// Describes smoke and clouds.
///
/// @code{.cpp}
/// bdpt::VolumeDesc smoke;
/// smoke.size = {64, 64, 64};  // voxels of 1 m
/// smoke.density.assign(std::size_t{64} * 64 * 64, 1.0f);
/// smoke.extinction = bdpt::Rgb(0.05f);
/// bdpt::SceneDesc desc;
/// desc.volumes.push_back(smoke);
/// @endcode

#include <bdpt/fields.h>
#include <bdpt/medium_desc.h>
#include <bdpt/types.h>

#include <string>
#include <vector>

namespace bdpt {

/// A heterogeneous medium, such as smoke or a cloud: a grid of voxels. It has no surface, and adds
/// to the media that are already there. The maximum density times the extinction times the length
/// of the grid's diagonal is at most 1e5 in each channel.
struct VolumeDesc {
    std::string name{};
    UVec3 size{0};               ///< voxels along x, y and z, > 0
    std::vector<float> density;  ///< >= 0, at the centres of voxels; x varies fastest
    /// Transforms grid coordinates, where voxel (0, 0, 0) fills the unit cube. Affine and
    /// invertible.
    Mat4 world_from_grid{1.0f};
    /// Extinction where the density is 1 [1/m], >= 0: absorption and scattering.
    Rgb extinction{1.0f};
    Rgb albedo{1.0f};         ///< single-scattering albedo, [0, 1]
    float anisotropy = 0.0f;  ///< g of Henyey and Greenstein, in (-1, 1); > 0 scatters forwards
};
/// Fields of `VolumeDesc`, with names and limits.
template <>
inline constexpr auto fields<VolumeDesc> = all_fields(
    Field{"name", &VolumeDesc::name}, Field{"size", &VolumeDesc::size},
    Field{"density", &VolumeDesc::density}, Field{"transform", &VolumeDesc::world_from_grid},
    Number{"extinction", &VolumeDesc::extinction, Limits::at_least(0.0f)},
    Number{"albedo", &VolumeDesc::albedo, Limits::unit()},
    Number{"anisotropy", &VolumeDesc::anisotropy, Limits{-max_anisotropy, max_anisotropy}});

}  // namespace bdpt
