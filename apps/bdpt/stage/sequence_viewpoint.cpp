#include "stage/sequence_viewpoint.h"

#include <bdpt/framing.h>

#include <utility>

#include "options/values/orbit.h"

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
        const Vec3 center =
            orbit_center(result.camera, image.view.look_at, 0.5f * (bounds.min + bounds.max));
        result.camera = orbited(std::move(result.camera), center, static_cast<float>(*view.turn));
    }
    return result;
}

}  // namespace bdpt::app
