#include "view/coarse_to_fine.h"

#include <algorithm>

namespace bdpt::app {
namespace {

double pixels(const Size& size)
{
    return static_cast<double>(size.width) * size.height;
}

}  // namespace

Size coarse_size(const Size& size, int divisor)
{
    return {.width = std::max(1, (size.width + divisor - 1) / divisor),
            .height = std::max(1, (size.height + divisor - 1) / divisor)};
}

double CoarseToFine::seconds(int divisor) const
{
    return seconds_a_pixel_ * pixels(coarse_size(size_, divisor));
}

void CoarseToFine::restart(const Size& size)
{
    constexpr int coarsest = 16;
    size_ = size;
    int divisor = 1;
    while (divisor < coarsest && seconds(divisor) > first_seconds) {
        divisor *= 2;
    }
    divisor_ = divisor;
    is_first_ = true;
}

std::optional<int> CoarseToFine::divisor() const
{
    return divisor_;
}

void CoarseToFine::done(double seconds_taken)
{
    const double measured = seconds_taken / pixels(coarse_size(size_, *divisor_));
    // Moving average with weight 1/2, as one picture may have been delayed.
    seconds_a_pixel_ += 0.5 * (measured - seconds_a_pixel_);
    is_first_ = false;
    const int next = *divisor_ / 2;
    if (next > 1 && seconds(next) <= max_seconds) {
        divisor_ = next;
    } else {
        divisor_.reset();
    }
}

}  // namespace bdpt::app
