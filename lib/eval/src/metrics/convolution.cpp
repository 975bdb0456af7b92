#include "metrics/convolution.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace bdpt::eval {
namespace {

/// Returns the row with its first and last value repeated `radius` times.
std::vector<float> padded(std::span<const float> row, std::size_t radius)
{
    std::vector<float> result;
    result.reserve(row.size() + 2 * radius);
    result.insert(result.end(), radius, row.front());
    result.insert(result.end(), row.begin(), row.end());
    result.insert(result.end(), radius, row.back());
    return result;
}

void add_scaled(std::span<float> sums, std::span<const float> values, float factor)
{
    for (std::size_t x = 0; x < sums.size(); ++x) {
        sums[x] += factor * values[x];
    }
}

Plane convolve_rows(const Plane& plane, const Kernel& kernel)
{
    Plane result(plane.width, plane.height);
    oneapi::tbb::parallel_for(0, plane.height, [&](int y) {
        const std::vector<float> source = padded(plane.row(y), kernel.size() / 2);
        const std::span<float> target = result.row(y);
        for (std::size_t k = 0; k < kernel.size(); ++k) {
            add_scaled(target, std::span(source).subspan(k, target.size()), kernel[k]);
        }
    });
    return result;
}

Plane convolve_columns(const Plane& plane, const Kernel& kernel)
{
    Plane result(plane.width, plane.height);
    const int radius = static_cast<int>(kernel.size() / 2);
    oneapi::tbb::parallel_for(0, plane.height, [&](int y) {
        for (int k = -radius; k <= radius; ++k) {
            const int source = std::clamp(y + k, 0, plane.height - 1);
            add_scaled(result.row(y), plane.row(source),
                       kernel[static_cast<std::size_t>(k + radius)]);
        }
    });
    return result;
}

}  // namespace

Plane convolve(const Plane& plane, const Kernel& horizontal, const Kernel& vertical)
{
    return convolve_columns(convolve_rows(plane, horizontal), vertical);
}

}  // namespace bdpt::eval
