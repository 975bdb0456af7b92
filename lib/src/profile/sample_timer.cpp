#include "profile/sample_timer.h"

#include "math/split_mix.h"

#include <algorithm>

namespace bdpt {
namespace {

/// One in this many samples is timed by phase.
constexpr std::uint64_t clocked_share = 16;

/// Chooses by a hash of pixel and index, so that neither rows nor powers of two are preferred.
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
    double reads = 1.0;  // clock reads between begin_ and the end
    if (clock_) {
        clock_->enter(Phase::walk);
        ++reads;
        for (const PhaseTicks& phase : clock_->spent()) {
            reads += static_cast<double>(phase.pieces);
        }
    }
    const auto elapsed = static_cast<double>(read_ticks() - begin_);
    const double lost = elapsed > sheet_->suspicious_ticks ? sheet_->wait.lost_ticks() : 0.0;
    const double ticks = std::max(elapsed - lost, 0.0);
    // Time lost to the clocks themselves and to interrupts is far less.
    constexpr double min_interruption = 0.1;
    SampleTicks& samples = sheet_->samples;
    if (!clock_) {
        samples.others.ticks += static_cast<std::uint64_t>(ticks);
        ++samples.others.pieces;
    } else if (lost > min_interruption * elapsed) {
        ++samples.interrupted;
    } else {
        note_phases();
        samples.clocked.ticks += static_cast<std::uint64_t>(ticks);
        ++samples.clocked.pieces;
    }
    sheet_->pixels.add(x_, y_, std::max(ticks - reads * sheet_->clock_ticks, 0.0));
}

void SampleTimer::note_phases() noexcept
{
    for (std::size_t i = 0; i < all_phases.size(); ++i) {
        sheet_->samples.phases[i].ticks += clock_->spent()[i].ticks;
        sheet_->samples.phases[i].pieces += clock_->spent()[i].pieces;
    }
}

}  // namespace bdpt
