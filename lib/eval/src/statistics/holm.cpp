#include <bdpt/eval/statistics.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace bdpt::eval {

std::vector<double> holm_adjusted(std::span<const double> p)
{
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [p](std::size_t a, std::size_t b) { return p[a] < p[b]; });
    std::vector<double> result(p.size());
    double greatest = 0.0;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        const double adjusted = static_cast<double>(order.size() - rank) * p[order[rank]];
        greatest = std::max(greatest, std::min(adjusted, 1.0));
        result[order[rank]] = greatest;
    }
    return result;
}

}  // namespace bdpt::eval
