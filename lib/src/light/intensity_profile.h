#pragma once

#include "math/distribution_2d.h"
#include "math/pdf.h"

#include <bdpt/scene_desc.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace bdpt {

/// A `LightProfile` that is ready to be looked up and sampled; lights share it. Its grid is cut
/// into cells of a few degrees, which are drawn by their flux; in a cell directions are uniform.
class IntensityProfile {
public:
    explicit IntensityProfile(const LightProfile& profile);

    struct Sample {
        Vec3 direction{0.0f};     ///< unit, the way the light travels
        float intensity = 0.0f;   ///< [cd]
        SolidAnglePdf pdf{0.0f};  ///< of the direction, > 0
    };

    /// In a unit direction of the profile's own space [cd].
    [[nodiscard]] float intensity(Vec3 direction) const;
    /// Nothing when all is dark.
    [[nodiscard]] std::optional<Sample> sample(Vec2 u) const;
    /// Of `sample`; positive wherever it is not dark.
    [[nodiscard]] SolidAnglePdf pdf(Vec3 direction) const;
    /// Integral of the intensity over all directions [lm].
    [[nodiscard]] float flux() const { return flux_; }
    /// The greatest intensity [cd].
    [[nodiscard]] float peak() const { return peak_; }

private:
    /// A direction by the numbers that the cells are cut by.
    struct Angles {
        /// 1 - cos(polar angle): it is what is uniform on a sphere, and keeps its digits around -z,
        /// where narrow beams point.
        float height = 0.0f;
        float azimuth = 0.0f;  ///< [rad], not before the first one of the grid
    };
    struct Cells {
        std::vector<float> heights;   ///< edges of the rows
        std::vector<float> azimuths;  ///< edges of the columns
        std::vector<float> weights;
        double flux = 0.0;
    };
    IntensityProfile(const LightProfile& profile, const Cells& cells);
    [[nodiscard]] static Cells cut(const LightProfile& profile);

    /// None beyond the angles of the grid.
    [[nodiscard]] std::optional<Angles> angles_of(Vec3 direction) const;
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
