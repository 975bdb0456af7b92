#pragma once

#include "math/distributions.h"
#include "math/pdf.h"

#include <bdpt/scene_desc.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace bdpt {

/// A `LightProfile` prepared for lookup and sampling; lights share it. Its grid is divided into
/// cells of a few degrees, which are sampled by their flux; within a cell directions are uniform.
class IntensityProfile {
public:
    explicit IntensityProfile(const LightProfile& profile);

    struct Sample {
        Vec3 direction{0.0f};     ///< unit, the direction in which the light travels
        float intensity = 0.0f;   ///< [cd]
        SolidAnglePdf pdf{0.0f};  ///< density of the direction, > 0
    };

    /// Returns the intensity in a unit direction of the profile's own space [cd].
    [[nodiscard]] float intensity(Vec3 direction) const;
    /// Samples a direction; nullopt if the profile is black.
    [[nodiscard]] std::optional<Sample> sample(Vec2 u) const;
    /// Returns the density of `sample`; positive where the intensity is.
    [[nodiscard]] SolidAnglePdf pdf(Vec3 direction) const;
    /// Returns the integral of the intensity over all directions [lm].
    [[nodiscard]] float flux() const { return flux_; }
    /// Returns the maximum intensity [cd].
    [[nodiscard]] float peak() const { return peak_; }

private:
    /// A direction in the coordinates of the cell boundaries.
    struct Angles {
        /// 1 - cos(polar angle): uniform on a sphere, and precise around -z, where narrow beams
        /// point.
        float height = 0.0f;
        float azimuth = 0.0f;  ///< [rad], at least the first azimuth of the grid
    };
    struct Cells {
        std::vector<float> heights;   ///< boundaries of the rows
        std::vector<float> azimuths;  ///< boundaries of the columns
        std::vector<float> weights;
        double flux = 0.0;
    };
    IntensityProfile(const LightProfile& profile, const Cells& cells);
    [[nodiscard]] static Cells cut(const LightProfile& profile);

    /// Returns the angles of a direction; nullopt outside of the grid.
    [[nodiscard]] std::optional<Angles> find_angles(Vec3 direction) const;
    [[nodiscard]] float lookup(const Angles& angles) const;
    [[nodiscard]] SolidAnglePdf to_solid_angle(float pdf_square, std::size_t column,
                                               std::size_t row) const;

    LightProfile grid_;
    std::vector<float> heights_;
    std::vector<float> columns_;
    Distribution2D cells_;
    float flux_;
    float peak_;
};

}  // namespace bdpt
