#include "stage/environment_change.h"

#include <bdpt/types.h>

#include <cmath>
#include <numbers>

namespace bdpt::app {

EnvironmentLightDesc changed(EnvironmentLightDesc light, const EnvironmentChange& change)
{
    if (change.rotation != 0.0) {
        const double angle = change.rotation * std::numbers::pi / 180.0;
        const auto sine = static_cast<float>(std::sin(angle));
        const auto cosine = static_cast<float>(std::cos(angle));
        const Mat3 turn(Vec3(cosine, 0.0f, -sine), Vec3(0.0f, 1.0f, 0.0f),
                        Vec3(sine, 0.0f, cosine));
        light.world_from_environment = turn * light.world_from_environment;
    }
    if (change.intensity != 1.0f) {
        for (Rgb& pixel : light.radiance.pixels) {
            pixel *= change.intensity;
        }
    }
    return light;
}

}  // namespace bdpt::app
