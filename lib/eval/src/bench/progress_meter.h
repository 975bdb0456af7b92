#pragma once

#include <bdpt/eval/bench.h>

#include <algorithm>
#include <string>

namespace bdpt::eval {

/// Tracks the progress of the work on a scene, and reports it to the caller.
class BenchProgressMeter {
public:
    /// `planned`: total work, in CPU time [s].
    BenchProgressMeter(double planned, const BenchControl& control)
        : left_(planned), control_(&control)
    {}

    /// Begins a piece of work of about `seconds`.
    void begin(const std::string& activity, double seconds)
    {
        activity_ = activity;
        piece_ = seconds;
        tell(0.0);
    }
    /// Reports that `fraction` of the current piece, in [0, 1], is done.
    void tell(double fraction) const
    {
        if (control_->on_progress) {
            const double done = piece_ * std::clamp(fraction, 0.0, 1.0);
            control_->on_progress({.worked = worked_ + done,
                                   .left = std::max(left_ - done, 0.0),
                                   .activity = activity_});
        }
    }
    /// Ends the current piece.
    void end()
    {
        worked_ += piece_;
        skip(piece_);
        piece_ = 0.0;
    }
    /// Removes work of about `seconds` from the plan.
    void skip(double seconds) { left_ = std::max(left_ - seconds, 0.0); }

private:
    double left_;
    double worked_ = 0.0;
    double piece_ = 0.0;
    std::string activity_;
    const BenchControl* control_;
};

}  // namespace bdpt::eval
