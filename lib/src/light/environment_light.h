#pragma once

#include "light/environment/environment_texels.h"
#include "light/environment/environment_tiles.h"
#include "light/learned/entries.h"
#include "light/light_model.h"
#include "light/light_samples.h"

#include <bdpt/render_options.h>
#include <bdpt/scene_desc.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

namespace bdpt {

class EnvironmentEntries;

/// Light from all directions at infinity, from an equirectangular image with bilinear
/// interpolation. Light paths start in proportion to luminance, or also by learned entries;
/// next-event estimation samples according to `EnvironmentSampling`, preferring directions high
/// above the receiver.
class EnvironmentLight : public InfiniteLight {
public:
    static constexpr bool is_delta = false;

    /// Negative values have been rejected before.
    EnvironmentLight(const EnvironmentLightDesc& desc, const BoundingSphere& bounds);

    /// Returns the radiance from direction `to_light`: unit, from the scene towards infinity.
    [[nodiscard]] Rgb radiance(Vec3 to_light) const;
    /// Returns the density of the direction from which a light path starts.
    [[nodiscard]] AreaPdf pdf_position(const LightPoint& x0) const;
    /// Returns the density of a direction of `sample_incident`; with compensation it can be zero
    /// where light is, and it is zero below the receiver's surface.
    [[nodiscard]] AreaPdf pdf_incident(const LightSampleContext& receiver, const LightPoint& x0,
                                       EnvironmentSampling sampling) const;

    [[nodiscard]] std::optional<EmissionSample> sample_emission(Vec2 u_position, Vec2 u_direction,
                                                                float time) const;
    /// Samples emission by learned entries.
    [[nodiscard]] std::optional<EmissionSample> sample_emission(
        Vec2 u_position, Vec2 u_direction, const EnvironmentEntries& entries) const;
    /// Densities of a sample of emission.
    struct EntryPdfs {
        AreaPdf direction;
        PlanarPdf entry;
    };
    /// Returns the densities of such a sample, of light from direction `to_light` through `p`.
    [[nodiscard]] EntryPdfs pdf_emission(Vec3 to_light, Vec3 p,
                                         const EnvironmentEntries& entries) const;
    [[nodiscard]] std::optional<IncidentSample> sample_incident(const LightSampleContext& receiver,
                                                                Vec2 u,
                                                                EnvironmentSampling sampling,
                                                                float time) const;
    /// Returns radiance over density of a sample of `sample_incident`.
    [[nodiscard]] Rgb incident_weight(const IncidentSample& incident) const
    {
        return lookup(incident.barycentrics) / incident.pdf.value;
    }
    /// Returns the tile that contains the direction.
    [[nodiscard]] std::size_t tile_to(Vec3 to_light) const;
    /// Returns the tiles that learned densities refer to.
    [[nodiscard]] const EnvironmentTiles& tiles() const { return *tiles_; }
    /// Luminous flux into the scene's bounding sphere [lm].
    [[nodiscard]] Rgb power() const;

    // Size of the image [texels].
    [[nodiscard]] int width() const { return texels_->width(); }
    [[nodiscard]] int height() const { return texels_->height(); }

private:
    struct Direction {
        Vec3 to_light;
        Vec2 uv;
        SolidAnglePdf pdf;
    };
    /// A cell of `EnvironmentTiles`.
    struct Cell {
        int column;
        int row;
    };
    /// Samples a direction; `receiver` has no normal for light paths.
    [[nodiscard]] std::optional<Direction> sample_direction(Vec2 u,
                                                            const LightSampleContext& receiver,
                                                            EnvironmentSampling sampling) const;
    /// Returns the direction of a sampled cell.
    [[nodiscard]] Direction direction_of(const EnvironmentTiles::Sample& cell) const;
    [[nodiscard]] EmissionSample emission(const Direction& from, const EntryWindow& window,
                                          Vec2 u_position) const;
    [[nodiscard]] SolidAnglePdf pdf_direction_to(Vec3 to_light, const LightSampleContext& receiver,
                                                 EnvironmentSampling sampling) const;
    [[nodiscard]] Cell cell_to(Vec3 to_light) const;
    [[nodiscard]] std::optional<Vec3> in_image(const std::optional<Vec3>& normal) const;
    [[nodiscard]] Vec2 to_uv(Vec3 to_light) const;
    /// The four texels around a point of the image, and its place between them.
    struct Neighbours {
        int left;
        int right;
        int upper;
        int lower;
        float across;  ///< in [0, 1]
        float down;
    };
    [[nodiscard]] Neighbours neighbours(Vec2 uv) const;
    [[nodiscard]] Rgb lookup(Vec2 uv) const;
    /// Starts to load the texels of a `lookup` into the cache.
    void prefetch(Vec2 uv) const;
    [[nodiscard]] SolidAnglePdf to_solid_angle(float pdf_square, int row) const;

    Mat3 world_from_environment_;
    BoundingSphere bounds_;
    std::vector<float> row_cosines_;
    std::shared_ptr<const EnvironmentTexels> texels_;
    std::unique_ptr<const EnvironmentTiles> tiles_;
};

}  // namespace bdpt
