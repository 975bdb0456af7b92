#include "material/layers.h"

#include "math/rgb.h"

#include <algorithm>

namespace bdpt {

LayerTables::LayerTables(std::span<const MaterialDesc> materials)
{
    const auto coated = [](const MaterialDesc& desc) { return desc.clearcoat.factor > 0.0f; };
    const auto cloth = [](const MaterialDesc& desc) { return !is_black(desc.sheen.color); };
    if (std::any_of(materials.begin(), materials.end(), coated)) {
        coat = std::make_unique<const SpecularAlbedo>(1.5f);
    }
    if (std::any_of(materials.begin(), materials.end(), cloth)) {
        sheen = std::make_unique<const SheenAlbedo>();
    }
}

}  // namespace bdpt
