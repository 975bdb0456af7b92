#include <bdpt/eval/statistics.h>

#include <algorithm>
#include <cstddef>

namespace bdpt::eval {

Spread spread(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t upper = values.size() / 2;
    const std::size_t lower = (values.size() - 1) / 2;
    return {.median = 0.5 * (values[lower] + values[upper]),
            .least = values.front(),
            .greatest = values.back()};
}

}  // namespace bdpt::eval
