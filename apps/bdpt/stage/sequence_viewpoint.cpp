#include "stage/sequence_viewpoint.h"

#include <bdpt/framing.h>

#include <optional>
#include <utility>
#include <variant>

#include "options/values/orbit.h"
#include "options/values/view.h"

namespace bdpt::app {

Viewpoint sequence_viewpoint(const PreparedScene& stage, const Viewpoint& first,
                             const RenderArguments& image)
{
    if (!image.sequence_view) {
        return first;
    }
    const SequenceView& view = *image.sequence_view;
    Viewpoint result = view.camera ? viewpoint(stage, *view.camera, image) : first;
    if (view.turn) {
        const Bounds& bounds = stage.scene.bounds();
        const Vec3 middle = 0.5f * (bounds.min + bounds.max);
        // A framed view has room for the whole turn around the middle.
        const bool is_framed =
            !view.camera && !image.view.from && !image.view.look_at && first.is_framed;
        std::optional<Vec3> target;
        if (image.view.look_at) {
            target = to_world(*image.view.look_at, stage.scene.description().origin);
        }
        const Vec3 center = is_framed ? middle : orbit_center(result.camera, target, middle);
        result.camera = orbited(std::move(result.camera), center, static_cast<float>(*view.turn));
    }
    return result;
}

Scene with_turned_environment(const Scene& still, double angle)
{
    for (const LightDesc& light : still.description().lights) {
        if (const auto* environment = std::get_if<EnvironmentLightDesc>(&light)) {
            return still.with_environment(turned(*environment, static_cast<float>(angle)));
        }
    }
    return still.edited(still.description());
}

}  // namespace bdpt::app
