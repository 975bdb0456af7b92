#pragma once

#include "material/layer_loss.h"
#include "material/lobes/fuzz.h"
#include "material/models/metallic_roughness.h"
#include "material/small_numbers.h"
#include "material/specular_albedo.h"

#include <bdpt/scene_desc.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace bdpt {

/// Returns the coat of a material; a clearcoat, unless a coat replaces it, is one that does not
/// darken its base.
[[nodiscard]] CoatDesc coat_of(const MaterialDesc& desc);
/// Returns the fibres of a material: fuzz or, unless it replaces it, a sheen, whose colour is also
/// its factor.
[[nodiscard]] FuzzDesc fuzz_of(const MaterialDesc& desc);

/// Tables of a coat of one index of refraction.
struct CoatTables {
    /// `fibres` may be below the coat; null if there are none.
    CoatTables(float ior, const FuzzTable* fibres);

    SpecularAlbedo albedo;
    LayerLoss loss;
};

/// Tables shared by all materials with layers.
struct LayerTables {
    /// Computes the tables that these materials need.
    explicit LayerTables(std::span<const MaterialDesc> materials);
    ~LayerTables();
    LayerTables(LayerTables&&) noexcept;
    LayerTables& operator=(LayerTables&&) noexcept;
    /// Returns the tables of coats of this index; null if there are none.
    [[nodiscard]] const CoatTables* coat(float ior) const;
    /// Tests whether the tables that these materials need exist.
    [[nodiscard]] bool are_enough_for(std::span<const MaterialDesc> materials) const;

    std::vector<std::unique_ptr<const CoatTables>> coats;
    std::unique_ptr<const FuzzTable> fuzz;
    std::unique_ptr<const LayerLoss> fuzz_loss;
};

/// Parameters that are constant over a layered material.
struct LayeredConstants {
    const SpecularAlbedo* base = nullptr;  ///< has the refractive index of the base
    float film_ior = 1.3f;
    float film_thickness = 0.0f;  ///< greatest one [nm]
    float coat_darkening = 0.0f;
    const CoatTables* coat = nullptr;  ///< set if there is a coat
    bool fuzz_covers_coat = false;
    const LayerTables* tables = nullptr;
    std::uint64_t id = new_id();  ///< of no others, but for copies

private:
    [[nodiscard]] static std::uint64_t new_id() noexcept;
};

/// A surface of several layers at one point: `GltfParameters`, coat, fibres above or below it, film
/// and diffuse transmission. Compact, as it lives in path vertices; `LayeredBsdf` makes a model of
/// it.
struct LayeredParameters {
    Rgb base_color{1.0f};
    Rgb specular_color{1.0f};
    Unit16 metallic{};
    Unit16 roughness{1.0f};
    Unit16 specular{1.0f};
    Unit16 transmission{};
    Body body = Body::thin_walled;
    Unit8 diffuse_roughness{};  ///< 0: Lambertian
    Unit16 coat{};              ///< coated fraction of the surface
    Unit16 coat_roughness{};    ///< perceptual
    Color16 coat_color{Rgb(1.0f)};
    Unit8 coat_anisotropy{};
    Unit8 coat_axis{};          ///< its rougher direction: the angle from x to y, over pi
    Direction16 coat_normal{};  ///< local, like all directions of a `LayeredBsdf`
    Unit16 fuzz_roughness{};
    Color16 fuzz_color{};
    Unit16 fuzz{};        ///< fraction of the surface with fibres
    Unit16 anisotropy{};  ///< rougher along x
    Unit16 film{};
    Unit16 film_thickness{};  ///< over the greatest one
    Unit16 diffuse_transmission{};
    Color16 transmission_color{};
    PackedPointer<const LayeredConstants> constants{};  ///< must outlive this

    LayeredParameters() = default;
    LayeredParameters(const GltfParameters& base, const LayeredConstants& equal) : constants(&equal)
    {
        set_base(base);
    }
    void set_base(const GltfParameters& base)
    {
        base_color = base.base_color;
        specular_color = base.specular_color;
        metallic = Unit16(base.metallic);
        roughness = Unit16(base.roughness);
        specular = Unit16(base.specular);
        transmission = Unit16(base.transmission);
        body = base.body;
    }
    [[nodiscard]] bool operator==(const LayeredParameters&) const = default;
    [[nodiscard]] GltfParameters base() const
    {
        return {base_color,
                metallic.value(),
                roughness.value(),
                specular.value(),
                specular_color,
                transmission.value(),
                body};
    }
};

}  // namespace bdpt
