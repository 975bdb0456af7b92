#include "material/layers.h"

#include "material/layer_loss.h"
#include "math/rgb.h"

#include <algorithm>

namespace bdpt {
namespace {

bool need_coat(std::span<const MaterialDesc> materials)
{
    return std::any_of(materials.begin(), materials.end(),
                       [](const MaterialDesc& desc) { return desc.clearcoat.factor > 0.0f; });
}

bool need_fuzz(std::span<const MaterialDesc> materials)
{
    return std::any_of(materials.begin(), materials.end(), [](const MaterialDesc& desc) {
        return desc.fuzz.factor > 0.0f || !is_black(desc.sheen.color);
    });
}

}  // namespace

LayerTables::LayerTables(std::span<const MaterialDesc> materials)
{
    if (need_fuzz(materials)) {
        fuzz = std::make_unique<const FuzzTable>();
        fuzz_loss = std::make_unique<const LayerLoss>(
            SpecularAlbedo(1.5f), [](float cosine, SpecularAlbedo::Roughness roughness) {
                return FuzzTable::directional(cosine, roughness.value());
            });
    }
    if (need_coat(materials)) {
        coat = std::make_unique<const SpecularAlbedo>(1.5f);
        coat_loss = std::make_unique<const LayerLoss>(
            *coat,
            [this](float cosine, SpecularAlbedo::Roughness roughness) {
                const SpecularAlbedo::Split split = coat->directional(cosine, roughness);
                return std::min(1.0f, coat->normal_reflectance() * split.f0 + split.f90);
            },
            fuzz.get());
    }
}

LayerTables::~LayerTables() = default;
LayerTables::LayerTables(LayerTables&&) noexcept = default;
LayerTables& LayerTables::operator=(LayerTables&&) noexcept = default;

bool LayerTables::are_enough_for(std::span<const MaterialDesc> materials) const
{
    return (coat || !need_coat(materials)) && (fuzz || !need_fuzz(materials));
}

}  // namespace bdpt
