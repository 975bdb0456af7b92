#include "verify/evidence.h"

#include <algorithm>

namespace bdpt::eval {

ImageCheck& ImageCheck::operator+=(const ImageCheck& later)
{
    if (!defects.first_invalid) {
        defects.first_invalid = later.defects.first_invalid;
    }
    defects.invalid += later.defects.invalid;
    defects.saturated += later.defects.saturated;
    lost = std::max(lost, later.lost);
    return *this;
}

Evidence::Evidence(const TileGrid& grid, int max_depth, std::size_t others)
    : grid_(grid),
      row_(max_depth),
      others_(others),
      strategies_((grid.size() + 1) * row_.size()),
      lengths_((grid.size() + 1) * static_cast<std::size_t>(max_depth)),
      finders_(row_.pairs())
{}

void Evidence::add(const Batch& batch)
{
    ++batches_;
    add_strategies(batch);
    add_lengths(batch);
    add_images(batch);
    if (batch.merges) {
        add_merges(*batch.merges);
    }
    if (channels_.empty() && !batch.channels.empty()) {
        channels_.assign(batch.channels.size(),
                         Evidence(batch.channels[0].bdpt.grid(), row_.max_depth(), others_));
    }
    for (std::size_t i = 0; i < batch.channels.size(); ++i) {
        channels_[i].add(batch.channels[i]);
    }
    const WeightFinding& weights = batch.bdpt.weights();
    weights_.paths += weights.paths;
    weights_.wrong += weights.wrong;
    weights_.worst = std::max(weights_.worst, weights.worst);
}

void Evidence::add_strategies(const Batch& batch)
{
    const auto add = [&](std::size_t cell, std::size_t index, const StrategySums& sums) {
        StrategyEvidence& evidence = strategies_[cell * row_.size() + index];
        evidence.sums += sums;
        evidence.difference.add((sums.tested - sums.expected) / (bdpt_samples * pixels(cell)));
    };
    for (std::size_t index = 0; index < row_.size(); ++index) {
        StrategySums all;
        for (std::size_t tile = 0; tile < grid_.size(); ++tile) {
            add(tile, index, batch.bdpt.strategy(tile, index));
            all += batch.bdpt.strategy(tile, index);
        }
        add(whole(), index, all);
    }
    for (int edges = 1; edges <= row_.max_depth(); ++edges) {
        const auto count = static_cast<std::size_t>(edges + 2);
        for (std::size_t u = 0; u < count; ++u) {
            for (std::size_t finder = 0; finder < count; ++finder) {
                finders_[row_.pair(edges, u, finder)] += batch.bdpt.expected_from(edges, u, finder);
            }
        }
    }
}

void Evidence::add_lengths(const Batch& batch)
{
    struct OtherSums {
        std::array<double, other_integrators.size()> radiance{};
        std::array<SecondMoment, other_integrators.size()> seen{};
    };
    const auto add = [&](std::size_t cell, int edges, const LengthSums& sums,
                         const OtherSums& others) {
        LengthEvidence& evidence = lengths_[cell * static_cast<std::size_t>(row_.max_depth()) +
                                            static_cast<std::size_t>(edges - 1)];
        const double samples = bdpt_samples * pixels(cell);
        evidence.sums += sums;
        evidence.radiance.add(sums.all.radiance / samples);
        evidence.from_camera.add(sums.from_camera.radiance / samples);
        evidence.from_light.add(sums.from_light.radiance / samples);
        for (std::size_t i = 0; i < others_; ++i) {
            evidence.others[i].add(others.radiance[i] /
                                   (count_samples(other_integrators[i], edges) * pixels(cell)));
            evidence.seen[i] += others.seen[i];
        }
    };
    for (int edges = 1; edges <= row_.max_depth(); ++edges) {
        LengthSums all;
        OtherSums all_others;
        for (std::size_t tile = 0; tile < grid_.size(); ++tile) {
            OtherSums others;
            for (std::size_t i = 0; i < others_; ++i) {
                others.radiance[i] = batch.others[i].at(tile, edges);
                others.seen[i] = batch.others[i].seen(tile, edges);
                all_others.radiance[i] += others.radiance[i];
                all_others.seen[i] += others.seen[i];
            }
            add(tile, edges, batch.bdpt.length(tile, edges), others);
            all += batch.bdpt.length(tile, edges);
        }
        add(whole(), edges, all, all_others);
    }
}

void Evidence::add_merges(const MergeSums& sums)
{
    merges_.resize(static_cast<std::size_t>(row_.max_depth()));
    for (int edges = 1; edges <= row_.max_depth(); ++edges) {
        MergeEvidence& evidence = merges_[static_cast<std::size_t>(edges - 1)];
        const MergeSumsOfLength& of_batch = sums.length(edges);
        evidence.sums += of_batch;
        evidence.difference.add((of_batch.tested - of_batch.expected) /
                                (count_samples(IntegratorKind::vcm, edges) * pixels(whole())));
    }
}

void Evidence::add_images(const Batch& batch)
{
    PerImage<double> sums{};
    for (std::size_t tile = 0; tile < grid_.size(); ++tile) {
        for (int edges = 1; edges <= row_.max_depth(); ++edges) {
            sums[0] += batch.bdpt.length(tile, edges).all.radiance / bdpt_samples;
            for (std::size_t i = 0; i < others_; ++i) {
                sums[i + 1] +=
                    batch.others[i].at(tile, edges) / count_samples(other_integrators[i], edges);
            }
        }
    }
    for (std::size_t i = 0; i <= others_; ++i) {
        images_[i].add(sums[i] / grid_.pixels());
        checks_[i] += batch.images[i];
    }
}

}  // namespace bdpt::eval
