#include "math/alias_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bdpt {
namespace {

[[nodiscard]] double usable(float weight)
{
    return std::isfinite(weight) && weight > 0.0f ? static_cast<double>(weight) : 0.0;
}

}  // namespace

AliasTable::AliasTable(std::span<const float> weights)
{
    double sum = 0.0;
    for (const float weight : weights) {
        sum += usable(weight);
    }
    if (sum <= 0.0) {
        return;
    }
    total_ = sum;
    const std::size_t count = weights.size();
    buckets_.resize(count);

    // Weights are scaled to a mean of one, then every bucket is filled to exactly one: an index
    // with too little weight takes the rest from one with too much.
    std::vector<double> level(count);
    std::vector<std::uint32_t> too_little;
    std::vector<std::uint32_t> too_much;
    std::uint32_t heaviest = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto share = static_cast<float>(usable(weights[i]) / sum);
        const bool drawable = share >= std::numeric_limits<float>::min();
        level[i] = drawable ? usable(weights[i]) / sum * static_cast<double>(count) : 0.0;
        buckets_[i] = {1.0f, i, drawable ? share : 0.0f};
        heaviest = share > buckets_[heaviest].probability ? i : heaviest;
        (level[i] < 1.0 ? too_little : too_much).push_back(i);
    }
    while (!too_little.empty() && !too_much.empty()) {
        const std::uint32_t poor = too_little.back();
        const std::uint32_t rich = too_much.back();
        too_little.pop_back();
        buckets_[poor].threshold = static_cast<float>(level[poor]);
        buckets_[poor].alias = rich;
        level[rich] -= 1.0 - level[poor];
        if (level[rich] < 1.0) {
            too_much.pop_back();
            too_little.push_back(rich);
        }
    }
    // Rounding may leave a few whose level is almost one; they stay full. A weight of zero among
    // them must not.
    for (const std::uint32_t i : too_little) {
        if (buckets_[i].probability == 0.0f) {
            buckets_[i].threshold = 0.0f;
            buckets_[i].alias = heaviest;
        }
    }
}

AliasTable::Choice AliasTable::sample(double u) const noexcept
{
    if (buckets_.empty()) {
        return {0, 0.0f, static_cast<float>(u)};
    }
    constexpr float below_one = 1.0f - 0x1p-24f;
    const double scaled = u * static_cast<double>(buckets_.size());
    const std::size_t slot = std::min(static_cast<std::size_t>(scaled), buckets_.size() - 1);
    const Bucket& bucket = buckets_[slot];
    const double within = scaled - static_cast<double>(slot);
    const double threshold = static_cast<double>(bucket.threshold);
    if (within < threshold) {
        return {static_cast<std::uint32_t>(slot), bucket.probability,
                std::min(static_cast<float>(within / threshold), below_one)};
    }
    const double rest = (within - threshold) / (1.0 - threshold);
    return {bucket.alias, buckets_[bucket.alias].probability,
            std::min(static_cast<float>(rest), below_one)};
}

}  // namespace bdpt
