#pragma once

#include "material/specular_albedo.h"
#include "math/side_media.h"
#include "math/wavelength.h"

#include <bdpt/scene_desc.h>

#include <array>
#include <cstddef>

namespace bdpt {

/// The tables of a material by the colour of light: one for all, or one for each index of
/// refraction. Refers to them; they must outlive it.
class ChannelAlbedos {
public:
    /// No dispersion. Not explicit: a table is a table for all colours.
    ChannelAlbedos(const SpecularAlbedo& all) : of_{&all, &all, &all} {}
    ChannelAlbedos(const SpecularAlbedo& red, const SpecularAlbedo& green,
                   const SpecularAlbedo& blue)
        : of_{&red, &green, &blue}
    {}

    [[nodiscard]] const SpecularAlbedo& at(Wavelength wavelength) const
    {
        return *of_[static_cast<std::size_t>(wavelength)];
    }
    [[nodiscard]] bool disperse() const { return of_[0] != of_[1] || of_[1] != of_[2]; }

private:
    std::array<const SpecularAlbedo*, wavelengths> of_;
};

/// The index of refraction for each colour, by KHR_materials_dispersion; equal ones for what is not
/// a solid transmitter.
[[nodiscard]] std::array<float, wavelengths> channel_indices(const MaterialDesc& desc);

/// What is around a body: another one, fog, or nothing.
struct Exterior {
    std::array<float, wavelengths> indices{1.0f, 1.0f, 1.0f};
    MediumId medium = MediumId::clear;

    friend bool operator==(const Exterior&, const Exterior&) = default;
};

/// What `desc` is for the bodies within it; `medium` is that of its inside.
[[nodiscard]] Exterior exterior_within(const MaterialDesc& desc, MediumId medium);

/// Where a solid transmitter lies in something denser it is seen from the other side: as if its
/// inside were around it.
struct BoundaryIndices {
    std::array<float, wavelengths> greater_by_less{1.0f, 1.0f, 1.0f};  ///< >= 1
    std::array<bool, wavelengths> turned{};  ///< is the outside the denser one?
};
[[nodiscard]] BoundaryIndices boundary_indices(const MaterialDesc& desc, const Exterior& exterior);

}  // namespace bdpt
