#pragma once

#include "material/specular_albedo.h"
#include "math/rgb.h"
#include "math/side_media.h"

#include <bdpt/scene_desc.h>

#include <array>
#include <cstddef>

namespace bdpt {

/// The tables of a material by wavelength: one for all, or one for each index of refraction. Refers
/// to them; they must outlive this.
class ChannelAlbedos {
public:
    /// No dispersion. Not explicit: one table serves all wavelengths.
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

/// Returns the index of refraction for each wavelength, by KHR_materials_dispersion; equal ones
/// unless `desc` is a solid transmitter.
[[nodiscard]] std::array<float, wavelengths> channel_indices(const MaterialDesc& desc);

/// Surroundings of a body: another body, fog, or nothing.
struct Exterior {
    std::array<float, wavelengths> indices{1.0f, 1.0f, 1.0f};
    MediumId medium = MediumId::clear;

    friend bool operator==(const Exterior&, const Exterior&) = default;
};

/// Returns the exterior of bodies within a body of material `desc`; `medium` is that of its inside.
[[nodiscard]] Exterior exterior_within(const MaterialDesc& desc, MediumId medium);

/// Relative indices of a boundary. A solid transmitter within a denser one is seen from the other
/// side: as if its inside were around it.
struct BoundaryIndices {
    std::array<float, wavelengths> greater_by_less{1.0f, 1.0f, 1.0f};  ///< >= 1
    std::array<bool, wavelengths> turned{};  ///< true if the outside is denser
};
[[nodiscard]] BoundaryIndices boundary_indices(const MaterialDesc& desc, const Exterior& exterior);

}  // namespace bdpt
