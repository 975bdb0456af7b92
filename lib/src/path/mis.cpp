#include "path/mis.h"

#include <cassert>
#include <cstddef>

namespace bdpt {

float mis_weight(const PathDensities& path, int s, Heuristic heuristic)
{
    const auto& light = path.from_light;
    const auto& camera = path.from_camera;
    const auto& counts = path.sample_counts;
    const auto used = static_cast<std::size_t>(s);
    assert(camera.size() == light.size() && counts.size() == light.size() + 1);
    assert(counts[used] > 0.0f);

    // In double, for the products over a long path leave the range of float.
    double sum = 1.0;
    const auto add = [&](std::size_t other, double density_ratio) {
        const double ratio = density_ratio * static_cast<double>(counts[other] / counts[used]);
        sum += heuristic == Heuristic::power ? ratio * ratio : ratio;
    };
    const auto quotient = [](AreaPdf a, AreaPdf b) {
        return static_cast<double>(a.value) / static_cast<double>(b.value);
    };
    // Every divisor below is a density that strategy s really sampled, so it is never zero.

    // Hand vertices s, s+1, ... over to the light, one at a time.
    double ratio = used == 1 ? quotient(light[0], path.next_event) : 1.0;
    for (std::size_t i = used; i < light.size(); ++i) {
        if (i == 0 && counts[1] > 0.0f) {
            add(1, quotient(path.next_event, camera[0]));
        }
        ratio *= quotient(light[i], camera[i]);
        if (i > 0 && counts[i + 1] > 0.0f) {
            add(i + 1, ratio);
        }
    }

    // Hand vertices s-1, s-2, ... over to the camera.
    ratio = 1.0;
    for (std::size_t i = used; i-- > 1;) {
        ratio *= quotient(camera[i], light[i]);
        if (counts[i] > 0.0f) {
            add(i, i == 1 ? ratio * quotient(path.next_event, light[0]) : ratio);
        }
    }
    if (used > 0 && counts[0] > 0.0f) {
        add(0, ratio * quotient(camera[0], used == 1 ? path.next_event : light[0]));
    }
    return static_cast<float>(1.0 / sum);
}

}  // namespace bdpt
