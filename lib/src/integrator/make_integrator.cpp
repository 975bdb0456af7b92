#include "integrator/bdpt_integrator.h"
#include "integrator/integrator.h"
#include "integrator/path_integrator.h"

namespace bdpt {

std::unique_ptr<const Integrator> make_integrator(const World& world, const MovingCamera& camera,
                                                  const RenderOptions& options)
{
    if (options.integrator == IntegratorKind::bdpt || options.integrator == IntegratorKind::lt) {
        return std::make_unique<BdptIntegrator>(world, camera, options);
    }
    return std::make_unique<PathIntegrator>(world, camera, options);
}

}  // namespace bdpt
