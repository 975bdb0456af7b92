#include "stage/environment_change.h"

#include <bdpt/framing.h>

#include <numbers>
#include <utility>

namespace bdpt::app {

EnvironmentLightDesc changed(EnvironmentLightDesc light, const EnvironmentChange& change)
{
    if (change.rotation != 0.0) {
        light = turned(std::move(light),
                       static_cast<float>(change.rotation * std::numbers::pi / 180.0));
    }
    if (change.intensity != 1.0f) {
        light.radiance = light.radiance.scaled(change.intensity);
    }
    return light;
}

}  // namespace bdpt::app
