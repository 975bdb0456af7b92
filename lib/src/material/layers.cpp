#include "material/layers.h"

#include "material/coat_loss.h"
#include "math/rgb.h"

#include <algorithm>

namespace bdpt {
namespace {

bool need_coat(std::span<const MaterialDesc> materials)
{
    return std::any_of(materials.begin(), materials.end(),
                       [](const MaterialDesc& desc) { return desc.clearcoat.factor > 0.0f; });
}

bool need_sheen(std::span<const MaterialDesc> materials)
{
    return std::any_of(materials.begin(), materials.end(),
                       [](const MaterialDesc& desc) { return !is_black(desc.sheen.color); });
}

}  // namespace

LayerTables::LayerTables(std::span<const MaterialDesc> materials)
{
    if (need_coat(materials)) {
        coat = std::make_unique<const SpecularAlbedo>(1.5f);
        coat_loss = std::make_unique<const CoatLoss>(*coat);
    }
    if (need_sheen(materials)) {
        sheen = std::make_unique<const SheenAlbedo>();
    }
}

LayerTables::~LayerTables() = default;
LayerTables::LayerTables(LayerTables&&) noexcept = default;
LayerTables& LayerTables::operator=(LayerTables&&) noexcept = default;

bool LayerTables::are_enough_for(std::span<const MaterialDesc> materials) const
{
    return (coat || !need_coat(materials)) && (sheen || !need_sheen(materials));
}

}  // namespace bdpt
