#pragma once

#include "geometry/embree_scene.h"
#include "geometry/segment_end.h"
#include "geometry/sphere.h"
#include "light/intensity_profile.h"
#include "material/bsdf.h"
#include "material/material.h"
#include "math/footprint.h"
#include "scene/enclosing_volumes.h"
#include "scene/light_set.h"
#include "scene/media.h"
#include "scene/scene_geometry.h"
#include "scene/volume.h"
#include "texture/mip_maps.h"

#include <bdpt/scene.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bdpt {

/// A point on a surface, or in a medium, with everything a path needs to go on from it.
struct SurfacePoint {
    SurfacePoint() = default;
    /// With the BSDF that `make_bsdf()` makes in its place, at no place yet.
    template <typename MakeBsdf>
    explicit SurfacePoint(const MakeBsdf& make_bsdf) : bsdf(make_bsdf())
    {}

    SegmentEnd end;
    Bsdf bsdf;
    Rgb emission{0.0f};            ///< radiance towards where the ray came from [nit]
    std::optional<LightId> light;  ///< set when the surface emits, from whichever side
    Vec2 barycentrics{0.0f};       ///< of triangles
    float opacity = 1.0f;          ///< the share of rays that meet it
    bool disperses = false;        ///< scatters light of different colours differently
};

/// The scene as rays see it: geometry, materials and lights. `WorldBuilder` fills it in; after that
/// nothing changes.
class World {
public:
    /// Throws `Error`: invalid_input, or what `EmbreeScene` throws.
    explicit World(SharedSceneDesc desc, Isa isa = Isa::native);
    /// The same that a new one would be, but for the time that it takes: what does not change is
    /// shared with `like`, which may go.
    World(SharedSceneDesc desc, const World& like);
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    // Surfaces that are not opaque are met or passed, by chance: the key of the segment decides.
    // Each segment of a path needs a key of its own (docs/mis.md).

    /// Where a ray from `from` in the unit direction `direction` meets the first surface, at the
    /// segment's time.
    [[nodiscard]] std::optional<RayHit> first_hit(const SegmentEnd& from, Vec3 direction,
                                                  SegmentKey segment) const noexcept;
    /// That surface as light of the segment's wavelength sees it; mip-mapped textures have the
    /// detail that pixels show.
    [[nodiscard]] SurfacePoint surface_at(const RayHit& hit, Vec3 direction, SegmentKey segment,
                                          const PixelCone& pixel) const noexcept;
    /// Both, for rays of no pixel.
    [[nodiscard]] std::optional<SurfacePoint> intersect(const SegmentEnd& from, Vec3 direction,
                                                        SegmentKey segment) const noexcept
    {
        const auto hit = first_hit(from, direction, segment);
        return hit ? std::optional(surface_at(*hit, direction, segment, PixelCone{}))
                   : std::nullopt;
    }
    /// The end of the ray that hit it: what `surface_at` has, without the surface.
    [[nodiscard]] SegmentEnd end_at(const RayHit& hit, Vec3 direction, float time) const noexcept;
    /// A point of a medium that a ray in the unit direction `direction` came to.
    [[nodiscard]] SurfacePoint medium_point(const SegmentEnd& from, Vec3 direction,
                                            const MediumEvent& event) const noexcept;
    /// The same of a volume; `around` is what else is there.
    [[nodiscard]] SurfacePoint volume_point(const SegmentEnd& from, Vec3 direction,
                                            const VolumeEvent& event,
                                            MediumId around) const noexcept;
    /// What becomes of light between two points; nothing when it meets a surface in between.
    [[nodiscard]] std::optional<SegmentTransmission> transmission(
        const SegmentEnd& a, const SegmentEnd& b, SegmentKey segment) const noexcept;
    /// The same from a point to infinity in the unit direction `direction`.
    [[nodiscard]] std::optional<SegmentTransmission> transmission_to_infinity(
        const SegmentEnd& a, Vec3 direction, SegmentKey segment) const noexcept;
    /// What is left of light between two points: zero when it meets a surface in between, else what
    /// the medium lets through.
    [[nodiscard]] Rgb transmittance(const SegmentEnd& a, const SegmentEnd& b,
                                    SegmentKey segment) const noexcept;
    /// The same from a point to infinity in the unit direction `direction`.
    [[nodiscard]] Rgb transmittance_to_infinity(const SegmentEnd& a, Vec3 direction,
                                                SegmentKey segment) const noexcept;

    /// What it was made of.
    [[nodiscard]] const SharedSceneDesc& description() const { return desc_; }
    [[nodiscard]] const LightSet& lights() const { return *lights_; }
    [[nodiscard]] const SceneGeometry& geometry() const { return *geometry_; }
    /// Does any material?
    [[nodiscard]] bool disperses() const { return disperses_; }
    /// Does anything, while the shutter is open?
    [[nodiscard]] bool moves() const { return moves_; }
    [[nodiscard]] const BoundingSphere& bounding_sphere() const { return geometry_->sphere; }
    [[nodiscard]] const Bounds& bounds() const { return geometry_->bounds; }
    [[nodiscard]] const SceneCounts& counts() const { return counts_; }
    [[nodiscard]] Isa isa() const noexcept { return embree_->isa(); }
    [[nodiscard]] std::string embree_version() const { return embree_->embree_version(); }
    /// As that of `EmbreeScene`.
    [[nodiscard]] float farthest_origin() const noexcept { return embree_->farthest_origin(); }
    [[nodiscard]] const Media& media() const { return media_; }
    [[nodiscard]] const Volumes& volumes() const { return volumes_; }
    /// Around a point that lies on no surface.
    [[nodiscard]] MediumId medium_at(Vec3 p) const;
    /// What is likely not meant, one line each.
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

private:
    friend class WorldBuilder;

    [[nodiscard]] const Material& material_of(std::uint32_t instance) const noexcept;
    [[nodiscard]] bool may_be_passed(std::uint32_t instance) const noexcept;
    [[nodiscard]] bool is_passed(const AnyHit& crossing) const noexcept;
    [[nodiscard]] AnyHitFilter any_hit_filter() const noexcept;
    /// Unit, on the front: of the triangle, and interpolated.
    struct ShadingNormals {
        Vec3 ng;
        Vec3 ns;
    };
    [[nodiscard]] Bsdf varying_bsdf(const RayHit& hit, const ShadingNormals& normals, Vec3 wo,
                                    SegmentKey segment, const PixelCone& pixel) const noexcept;
    [[nodiscard]] SurfacePoint mesh_point(const RayHit& hit, Vec3 direction, SegmentKey segment,
                                          const PixelCone& pixel) const noexcept;
    [[nodiscard]] SurfacePoint sphere_point(const RayHit& hit, Vec3 direction,
                                            float time) const noexcept;

    void set_geometry(std::shared_ptr<const SceneGeometry> geometry);
    /// What a material was made of.
    struct MaterialSource {
        std::size_t desc = 0;  ///< number of its description
        Exterior exterior;
        MediumId within = MediumId::clear;
        friend bool operator==(const MaterialSource&, const MaterialSource&) = default;
    };
    /// Bodies that light passes through.
    struct Bodies {
        std::vector<std::uint32_t> instances;
        std::optional<EnclosingVolumes> volumes;
        std::vector<std::optional<std::uint32_t>> around;  ///< by instance
    };
    /// The lights, and what they refer to that scenes may share.
    struct Lit {
        std::shared_ptr<const std::vector<Material>> materials;
        std::vector<MediumId> media;  ///< around each light that is no surface
        std::vector<IntensityProfile> profiles;
        std::optional<LightSet> lights;
    };

    SharedSceneDesc desc_;
    using AlbedoKey = std::pair<float, SpecularAlbedo::Below>;  ///< the first: index of refraction
    std::map<AlbedoKey, std::shared_ptr<const SpecularAlbedo>> albedos_;
    std::shared_ptr<const LayerTables> layer_tables_;  // if any material needs them
    MipMaps mip_maps_;                                 // if textures have any
    Media media_;
    MediumId fog_ = MediumId::clear;
    Volumes volumes_;
    std::shared_ptr<std::vector<Material>> all_materials_;
    std::span<const Material> materials_;  // the same
    std::vector<MaterialSource> material_sources_;
    std::vector<MaterialId> material_ids_;  // by instance: what is around it counts, too
    bool disperses_ = false;
    bool moves_ = false;
    std::shared_ptr<const SceneGeometry> geometry_;
    std::span<const PlacedMesh> placed_;  // of it
    SceneCounts counts_;
    std::unique_ptr<const EmbreeScene> embree_;
    std::shared_ptr<const Bodies> bodies_;           // if there are any
    std::map<std::size_t, std::size_t> open_edges_;  // by mesh, of those that bound bodies
    std::vector<std::string> warnings_;
    std::shared_ptr<const Lit> lit_;
    const LightSet* lights_ = nullptr;  // of it
};

}  // namespace bdpt
