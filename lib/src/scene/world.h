#pragma once

#include "geometry/embree_scene.h"
#include "geometry/ray.h"
#include "geometry/sphere.h"
#include "light/intensity_profile.h"
#include "light/learned/learned_light.h"
#include "material/bsdf.h"
#include "material/material.h"
#include "math/frame.h"
#include "scene/enclosing_volumes.h"
#include "scene/light_set.h"
#include "scene/media.h"
#include "scene/scene_geometry.h"
#include "scene/volume.h"
#include "texture/texture.h"

#include <bdpt/scene.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace bdpt {

/// A point on a surface or in a medium, with everything a path needs to continue from it.
struct SurfacePoint {
    SurfacePoint() = default;
    /// Constructs the BSDF in place by `make_bsdf()`; the position is not set yet.
    template <typename MakeBsdf>
    explicit SurfacePoint(const MakeBsdf& make_bsdf) : bsdf(make_bsdf())
    {}

    SegmentEnd end;
    Bsdf bsdf;
    Rgb emission{0.0f};            ///< radiance emitted towards the ray's origin [nit]
    std::optional<LightId> light;  ///< set if the surface emits, on whichever side
    Vec2 barycentrics{0.0f};       ///< barycentric coordinates on triangles
    float opacity = 1.0f;          ///< fraction of rays that hit it
    bool disperses = false;        ///< scatters wavelengths differently
};

/// The scene as rays see it: geometry, materials and lights. `WorldBuilder` fills it in; afterwards
/// it is immutable.
class World {
public:
    /// Throws `Error`: invalid_input, or errors of `EmbreeScene`.
    explicit World(SharedSceneDesc desc, Isa isa = Isa::native)
        : World(std::move(desc), isa, nullptr)
    {}
    /// Constructs a world equal to a new one in less time: unchanged parts are shared with `like`,
    /// which may be destroyed.
    World(SharedSceneDesc desc, const World& like) : World(std::move(desc), like.isa(), &like) {}
    World(const World&) = delete;
    World& operator=(const World&) = delete;

    // Walks hit or pass surfaces that are not opaque at random: the key of the segment decides.
    // Each segment of a path needs a key of its own (docs/mis.md). Shadow rays (`transmission`)
    // multiply by what these surfaces let pass on average; with a key `without_chance`, they block.

    /// Returns the first hit of a ray from `from` in the unit direction `direction`, at the
    /// segment's time. Sets `*is_tinted`, unless null, if `tint` may differ from 1 on the way to
    /// the hit.
    [[nodiscard]] std::optional<RayHit> first_hit(const SegmentEnd& from, Vec3 direction,
                                                  SegmentKey segment,
                                                  bool* is_tinted = nullptr) const noexcept;
    /// Does the same by the rule of `passage`, which receives the surfaces that the ray passes.
    [[nodiscard]] std::optional<RayHit> first_hit(const SegmentEnd& from, Vec3 direction,
                                                  SegmentKey segment,
                                                  RayPassage& passage) const noexcept;
    /// Returns the hit of the ray at a surface that it crosses.
    [[nodiscard]] RayHit hit_at(const SegmentEnd& from, Vec3 direction, SegmentKey segment,
                                const Crossing& crossing) const noexcept;
    /// Tests whether rays may pass any surface.
    [[nodiscard]] bool has_passable_surfaces() const noexcept { return has_passable_surfaces_; }
    /// Returns the factor of light on a ray that passes tinted surfaces within `distance`, which is
    /// at most that of the hit `end`, if there is one.
    [[nodiscard]] Rgb tint(const SegmentEnd& from, Vec3 direction, float distance,
                           SegmentKey segment,
                           const std::optional<RayHit>& end = std::nullopt) const noexcept;
    /// Tests whether `tint` is ever other than 1.
    [[nodiscard]] bool has_tinted_surfaces() const noexcept { return has_tinted_surfaces_; }
    /// Returns the surface at a hit for light of the segment's wavelength; mip-mapped textures have
    /// the detail that pixels show.
    [[nodiscard]] SurfacePoint surface_at(const RayHit& hit, Vec3 direction, SegmentKey segment,
                                          const PixelCone& pixel) const noexcept;
    /// Returns the texture coordinates of set 0 at a hit; 0 if the surface has none.
    [[nodiscard]] Vec2 uv_at(const RayHit& hit) const noexcept;
    /// Combines `first_hit` and `surface_at`, for rays that belong to no pixel.
    [[nodiscard]] std::optional<SurfacePoint> intersect(const SegmentEnd& from, Vec3 direction,
                                                        SegmentKey segment) const noexcept
    {
        const auto hit = first_hit(from, direction, segment);
        return hit ? std::optional(surface_at(*hit, direction, segment, PixelCone{}))
                   : std::nullopt;
    }
    /// Returns the end of the ray at the hit: that of `surface_at`, without the surface.
    [[nodiscard]] SegmentEnd end_at(const RayHit& hit, Vec3 direction, float time) const noexcept;
    /// Returns the scattering event in a medium on a ray in the unit direction `direction`.
    [[nodiscard]] SurfacePoint medium_point(const SegmentEnd& from, Vec3 direction,
                                            const MediumEvent& event) const noexcept;
    /// Returns the scattering event in a volume; `around` is the surrounding medium.
    [[nodiscard]] SurfacePoint volume_point(const SegmentEnd& from, Vec3 direction,
                                            const VolumeEvent& event,
                                            MediumId around) const noexcept;
    /// Returns transmittance and densities of the segment between two points; nullopt if a surface
    /// blocks it.
    [[nodiscard]] std::optional<SegmentTransmission> transmission(
        const SegmentEnd& a, const SegmentEnd& b, SegmentKey segment) const noexcept;
    /// Returns the same for the ray from a point to infinity in the unit direction `direction`.
    [[nodiscard]] std::optional<SegmentTransmission> transmission_to_infinity(
        const SegmentEnd& a, Vec3 direction, SegmentKey segment) const noexcept;
    /// Returns the transmittance between two points: zero if a surface blocks the segment, else the
    /// transmittance of media, volumes and surfaces that light passes.
    [[nodiscard]] Rgb transmittance(const SegmentEnd& a, const SegmentEnd& b,
                                    SegmentKey segment) const noexcept;
    /// Returns the transmittance from a point to infinity in the unit direction `direction`.
    [[nodiscard]] Rgb transmittance_to_infinity(const SegmentEnd& a, Vec3 direction,
                                                SegmentKey segment) const noexcept;

    /// Returns the description that the world was built from.
    [[nodiscard]] const SharedSceneDesc& description() const { return desc_; }
    [[nodiscard]] const LightSet& lights() const { return *lights_; }
    [[nodiscard]] const SceneGeometry& geometry() const { return *geometry_; }
    /// Tests whether any material disperses.
    [[nodiscard]] bool disperses() const { return disperses_; }
    /// Tests whether anything moves while the shutter is open.
    [[nodiscard]] bool moves() const { return moves_; }
    [[nodiscard]] const BoundingSphere& bounding_sphere() const { return geometry_->sphere; }
    [[nodiscard]] const Bounds& bounds() const { return geometry_->bounds; }
    [[nodiscard]] const SceneCounts& counts() const { return counts_; }
    [[nodiscard]] Isa isa() const noexcept { return embree_->isa(); }
    [[nodiscard]] std::string embree_version() const { return embree_->embree_version(); }
    /// Returns `EmbreeScene::farthest_origin()`.
    [[nodiscard]] float farthest_origin() const noexcept { return embree_->farthest_origin(); }
    [[nodiscard]] const Media& media() const { return media_; }
    [[nodiscard]] const Volumes& volumes() const { return volumes_; }
    /// Returns the medium at a point that lies on no surface.
    [[nodiscard]] MediumId medium_at(Vec3 p) const;
    /// Returns the memo of the light pilot: with the tables of materials, which gain rows as rays
    /// need them, the only mutable state of a world.
    [[nodiscard]] LearnedMemo& learned() const noexcept { return learned_; }
    /// Returns likely mistakes in the scene, one line each.
    [[nodiscard]] const std::vector<std::string>& warnings() const noexcept { return warnings_; }

private:
    friend class WorldBuilder;

    World(SharedSceneDesc desc, Isa isa, const World* like);
    [[nodiscard]] const Material& find_material(std::uint32_t instance) const noexcept;
    [[nodiscard]] const Material& find_material(const RayHit& hit) const noexcept;
    /// Returns the unit normal for shading, on the side of `ng`; arguments as in `PlacedMesh`.
    [[nodiscard]] Vec3 shading_normal(const PlacedMesh& mesh, std::uint32_t triangle,
                                      Vec2 barycentrics, Vec3 ng, float time) const noexcept;
    [[nodiscard]] bool may_be_passed(std::uint32_t instance) const noexcept;
    [[nodiscard]] bool may_tint(std::uint32_t instance) const noexcept;
    [[nodiscard]] Rgb tint_at(const AnyHit& surface) const noexcept;
    /// Tests whether a shadow ray is blocked; else multiplies `passing` by the factor with which it
    /// passes surfaces.
    [[nodiscard]] bool is_blocked(const Ray& ray, Rgb& passing) const noexcept;
    [[nodiscard]] float opacity_at(const AnyHit& surface) const noexcept;
    [[nodiscard]] AnyHitFilter any_hit_filter() const noexcept;
    /// Unit normals on the front side: of the triangle, and interpolated.
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
    /// Inputs of a material.
    struct MaterialSource {
        std::size_t desc = 0;  ///< index of its description
        Exterior exterior;
        MediumId within = MediumId::clear;
        friend bool operator==(const MaterialSource&, const MaterialSource&) = default;
    };
    /// Transparent bodies.
    struct Bodies {
        std::vector<std::uint32_t> instances;
        std::optional<EnclosingVolumes> volumes;
        std::vector<std::optional<std::uint32_t>> around;  ///< one per instance
    };
    /// The lights, and the data they refer to that scenes may share.
    struct Lit {
        std::shared_ptr<const std::vector<Material>> materials;
        std::vector<MediumId> media;  ///< medium around each light that is no surface
        std::vector<IntensityProfile> profiles;
        std::optional<LightSet> lights;
    };

    SharedSceneDesc desc_;
    std::map<float, std::shared_ptr<const SpecularAlbedo>> albedos_;  // by index of refraction
    std::shared_ptr<const LayerTables> layer_tables_;  // set if any material needs them
    MipMaps mip_maps_;                                 // filled if textures are mip-mapped
    Media media_;
    MediumId fog_ = MediumId::clear;
    Volumes volumes_;
    std::shared_ptr<std::vector<Material>> all_materials_;
    std::span<const Material> materials_;  // view of `all_materials_`
    std::vector<MaterialSource> material_sources_;
    std::vector<MaterialId> material_ids_;    // one per instance: surroundings matter, too
    std::vector<MaterialId> bond_materials_;  // one per bond of the geometry
    bool disperses_ = false;
    bool moves_ = false;
    bool has_passable_surfaces_ = false;
    bool has_tinted_surfaces_ = false;
    std::shared_ptr<const SceneGeometry> geometry_;
    std::span<const PlacedMesh> placed_;  // view of `geometry_`
    SceneCounts counts_;
    std::unique_ptr<const EmbreeScene> embree_;
    std::shared_ptr<const Bodies> bodies_;  // null if there are none
    std::vector<std::string> warnings_;
    std::shared_ptr<const Lit> lit_;
    const LightSet* lights_ = nullptr;  // points into `lit_`
    mutable LearnedMemo learned_;
};

}  // namespace bdpt
