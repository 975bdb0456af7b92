#include "render/learned_visibility.h"

#include "pilot/visibility_pilot.h"
#include "render/open_camera.h"
#include "threads/threads.h"

namespace bdpt {

std::unique_ptr<const EnvironmentVisibility> learned_visibility(const World& world,
                                                                const CameraDesc& camera,
                                                                const RenderOptions& options)
{
    RenderOptions whole = options;
    whole.film.crop.reset();
    const MovingCamera opened = open_camera(world, camera, whole);
    Threads threads(options.system.threads);
    std::unique_ptr<const EnvironmentVisibility> learned;
    threads.execute([&] { learned = learn_visibility(world, opened, whole); });
    return learned;
}

}  // namespace bdpt
