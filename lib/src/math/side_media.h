#pragma once

#include <cstdint>

namespace bdpt {

/// Identifies a medium of a scene.
enum class MediumId : std::uint32_t {
    clear  ///< neither absorbs nor scatters
};

/// The media on both sides of a surface.
struct SideMedia {
    MediumId behind = MediumId::clear;
    MediumId ahead = MediumId::clear;

    /// Returns the media of a point that is not on a surface.
    [[nodiscard]] static constexpr SideMedia around(MediumId medium) { return {medium, medium}; }
    [[nodiscard]] constexpr bool are_clear() const
    {
        return behind == MediumId::clear && ahead == MediumId::clear;
    }
    friend bool operator==(const SideMedia&, const SideMedia&) = default;
};

}  // namespace bdpt
