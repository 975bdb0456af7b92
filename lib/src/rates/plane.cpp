#include "rates/plane.h"

#include <algorithm>
#include <cstddef>

namespace bdpt {
namespace {

/// Combines values at most `radius` pixels away, along rows (`step` 1) or columns (`step` width).
template <typename Combine>
Plane along(const Plane& plane, PlaneSize size, bool rows, int radius, const Combine& combine)
{
    Plane result(plane.size());
    const int length = rows ? size.width : size.height;
    const auto step = static_cast<std::size_t>(rows ? 1 : size.width);
    for (std::size_t i = 0; i < plane.size(); ++i) {
        const auto width = static_cast<std::size_t>(size.width);
        const int at = static_cast<int>(rows ? i % width : i / width);
        const int first = std::max(0, at - radius);
        const int last = std::min(length - 1, at + radius);
        result[i] = combine(&plane[i - static_cast<std::size_t>(at - first) * step], step,
                            last - first + 1);
    }
    return result;
}

}  // namespace

Plane local_mean(const Plane& plane, PlaneSize size, int radius)
{
    const auto mean = [](const double* first, std::size_t step, int count) {
        double sum = 0.0;
        for (int i = 0; i < count; ++i) {
            sum += first[static_cast<std::size_t>(i) * step];
        }
        return sum / count;
    };
    return along(along(plane, size, true, radius, mean), size, false, radius, mean);
}

Plane local_greatest(const Plane& plane, PlaneSize size, int radius)
{
    const auto greatest = [](const double* first, std::size_t step, int count) {
        double result = *first;
        for (int i = 1; i < count; ++i) {
            result = std::max(result, first[static_cast<std::size_t>(i) * step]);
        }
        return result;
    };
    return along(along(plane, size, true, radius, greatest), size, false, radius, greatest);
}

double mean_of(const Plane& plane)
{
    double sum = 0.0;
    for (const double value : plane) {
        sum += value;
    }
    return sum / static_cast<double>(plane.size());
}

}  // namespace bdpt
