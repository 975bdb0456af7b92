#include "integrator/sample_timer.h"

#include "math/split_mix.h"

#include <algorithm>

namespace bdpt {
namespace {

/// One of so many samples is clocked in phases.
constexpr std::uint64_t clocked_share = 16;

/// By a hash of pixel and index, so that neither rows nor powers of two are preferred.
bool is_chosen(int x, int y, std::int64_t index) noexcept
{
    const std::uint64_t pixel = static_cast<std::uint64_t>(static_cast<std::uint32_t>(x)) << 32U |
                                static_cast<std::uint32_t>(y);
    const std::uint64_t hash =
        split_mix(split_mix(pixel) + static_cast<std::uint64_t>(index) * golden_ratio_64);
    return hash % clocked_share == 0;
}

}  // namespace

void SampleTimer::start(std::int64_t index) noexcept
{
    if (is_chosen(x_, y_, index)) {
        begin_ = read_ticks();
        clock_.emplace();
    } else {
        begin_ = read_ticks();
    }
}

void SampleTimer::finish() noexcept
{
    std::uint64_t reads = 1;  // that are between begin_ and the end
    if (clock_) {
        clock_->enter(Phase::walk);
    }
    const std::uint64_t ticks = read_ticks() - begin_;
    PhaseTicks& kind = clock_ ? sheet_->samples.clocked : sheet_->samples.others;
    kind.ticks += ticks;
    ++kind.pieces;
    if (clock_) {
        ++reads;
        for (std::size_t i = 0; i < all_phases.size(); ++i) {
            sheet_->samples.phases[i].ticks += clock_->spent()[i].ticks;
            sheet_->samples.phases[i].pieces += clock_->spent()[i].pieces;
            reads += clock_->spent()[i].pieces;
        }
    }
    sheet_->pixels.add(
        x_, y_,
        std::max(static_cast<double>(ticks) - static_cast<double>(reads) * sheet_->clock_ticks,
                 0.0));
}

}  // namespace bdpt
