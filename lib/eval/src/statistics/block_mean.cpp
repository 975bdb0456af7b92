#include <bdpt/eval/statistics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace bdpt::eval {

std::optional<double> block_standard_error(std::span<const double> values, int width, int height,
                                           int block)
{
    const double count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double blocks = 0.0;
    double squares = 0.0;
    for (int top = 0; top < height; top += block) {
        for (int left = 0; left < width; left += block) {
            double sum = 0.0;
            for (int y = top; y < std::min(top + block, height); ++y) {
                for (int x = left; x < std::min(left + block, width); ++x) {
                    sum += values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                  static_cast<std::size_t>(x)] -
                           mean;
                }
            }
            squares += sum * sum;
            blocks += 1.0;
        }
    }
    if (blocks < 2.0) {
        return std::nullopt;
    }
    return std::sqrt(blocks / (blocks - 1.0) * squares) / count;
}

}  // namespace bdpt::eval
