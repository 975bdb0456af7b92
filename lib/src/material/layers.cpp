#include "material/layers.h"

#include "math/rgb.h"

#include <algorithm>
#include <atomic>

namespace bdpt {
namespace {

bool need_fuzz(std::span<const MaterialDesc> materials)
{
    return std::any_of(materials.begin(), materials.end(),
                       [](const MaterialDesc& desc) { return fuzz_of(desc).factor > 0.0f; });
}

}  // namespace

CoatDesc coat_of(const MaterialDesc& desc)
{
    if (desc.coat.factor > 0.0f) {
        return desc.coat;
    }
    const ClearcoatDesc& clear = desc.clearcoat;
    CoatDesc coat;
    coat.factor = clear.factor;
    coat.roughness = clear.roughness;
    coat.darkening = 0.0f;
    coat.normal_scale = clear.normal_scale;
    coat.texture = clear.texture;
    coat.roughness_texture = clear.roughness_texture;
    coat.normal_texture = clear.normal_texture;
    return coat;
}

FuzzDesc fuzz_of(const MaterialDesc& desc)
{
    if (desc.fuzz.factor > 0.0f) {
        return desc.fuzz;
    }
    const SheenDesc& sheen = desc.sheen;
    FuzzDesc fuzz;
    fuzz.factor = is_black(sheen.color) ? 0.0f : 1.0f;
    fuzz.color = sheen.color;
    fuzz.roughness = sheen.roughness;
    fuzz.color_texture = sheen.color_texture;
    fuzz.roughness_texture = sheen.roughness_texture;
    return fuzz;
}

/// Returns the loss below a coat, by the table of surfaces of index 1.5.
[[nodiscard]] static LayerLoss loss_below(const SpecularAlbedo& coat, const FuzzTable* fibres)
{
    constexpr float of_surfaces = 1.5f;
    const auto reflected = [&coat](float cosine, SpecularAlbedo::Roughness roughness) {
        const SpecularAlbedo::Split split = coat.directional(cosine, roughness);
        return std::min(1.0f, coat.normal_reflectance() * split.f0 + split.f90);
    };
    return coat.ior() == of_surfaces ? LayerLoss(coat, reflected, fibres)
                                     : LayerLoss(SpecularAlbedo(of_surfaces), reflected, fibres);
}

CoatTables::CoatTables(float ior, const FuzzTable* fibres)
    : albedo(ior), loss(loss_below(albedo, fibres))
{}

LayerTables::LayerTables(std::span<const MaterialDesc> materials)
{
    if (need_fuzz(materials)) {
        fuzz = std::make_unique<const FuzzTable>();
        fuzz_loss = std::make_unique<const LayerLoss>(
            SpecularAlbedo(1.5f), [](float cosine, SpecularAlbedo::Roughness roughness) {
                return FuzzTable::directional(cosine, FuzzTable::roughness_of(roughness));
            });
    }
    for (const MaterialDesc& desc : materials) {
        const CoatDesc coated = coat_of(desc);
        if (coated.factor > 0.0f && coat(coated.ior) == nullptr) {
            coats.push_back(std::make_unique<const CoatTables>(coated.ior, fuzz.get()));
        }
    }
}

LayerTables::~LayerTables() = default;
LayerTables::LayerTables(LayerTables&&) noexcept = default;
LayerTables& LayerTables::operator=(LayerTables&&) noexcept = default;

const CoatTables* LayerTables::coat(float ior) const
{
    const auto found = std::find_if(coats.begin(), coats.end(), [ior](const auto& tables) {
        return tables->albedo.ior() == SpecularAlbedo::clamped(ior);
    });
    return found != coats.end() ? found->get() : nullptr;
}

bool LayerTables::are_enough_for(std::span<const MaterialDesc> materials) const
{
    const bool coated = std::all_of(materials.begin(), materials.end(), [this](const auto& desc) {
        const CoatDesc coat_desc = coat_of(desc);
        return coat_desc.factor == 0.0f || coat(coat_desc.ior) != nullptr;
    });
    return coated && (fuzz || !need_fuzz(materials));
}

std::uint64_t LayeredConstants::new_id() noexcept
{
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

}  // namespace bdpt
