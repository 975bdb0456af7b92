#include "output/parts.h"

#include <bdpt/error.h>
#include <fmt/core.h>

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

namespace bdpt::job {
namespace {

constexpr std::chrono::duration<double> min_write_interval{60.0};
/// Interval of checkpoints relative to the time of the last write: they take at most 1 % of the
/// time.
constexpr double interval_of_writes = 100.0;
/// Factor of the interval after a failed write.
constexpr double interval_after_failure = 10.0;

}  // namespace

PartKeeper::PartKeeper(PartChoice choice, std::optional<PlannedIdentity> planned, Console& console)
    : choice_(std::move(choice)),
      console_(console),
      planned_(std::move(planned)),
      old_(choice_.existing == ExistingPart::restart ? io::OldPart::replace
                                                     : io::OldPart::keep_if_more),
      interval_(min_write_interval)
{
    std::error_code ignored;
    const bool exists = std::filesystem::exists(choice_.file, ignored);
    if (!exists || choice_.existing == ExistingPart::restart) {
        return;
    }
    try {
        there_ = io::read_part_info(choice_.file);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::invalid_input) {
            throw;
        }
        throw Error(error.code(), fmt::format("{} (--restart replaces it)", error.what()));
    }
}

bool PartKeeper::is_complete(SampleRange samples) const
{
    return planned_ && there_ && !difference(there_->identity, *planned_) &&
           there_->samples.contains(SampleSet(samples));
}

std::optional<bool> PartKeeper::has_rates() const
{
    if (!there_) {
        return std::nullopt;
    }
    const std::vector<IdentityComponent>& components = there_->identity.components;
    return std::any_of(components.begin(), components.end(),
                       [](const auto& component) { return component.name == "option: rates"; });
}

RenderResult PartKeeper::start(const Identity& identity, io::PartNotes notes)
{
    notes_ = std::move(notes);
    RenderResult part;
    if (const auto what = planned_ ? difference(identity, *planned_) : std::nullopt) {
        throw Error(ErrorCode::invalid_input, fmt::format("{}: is the plan of another render: {}",
                                                          choice_.plan->string(), *what));
    }
    if (!there_) {
        return part;
    }
    if (const auto what = difference(identity, there_->identity)) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("{}: is a part of another render: {} (--restart replaces it)",
                                choice_.file.string(), *what));
    }
    io::merge_part(part, *there_);
    written_ = part.samples;
    console_.event("part", {{"file", choice_.file.string()}, {"samples", written_.text()}});
    console_.detail(
        fmt::format("resuming {}: it has the samples {}", choice_.file.string(), written_.text()));
    return part;
}

void PartKeeper::after_pass(const RenderResult& part, Checkpoint checkpoint)
{
    if (checkpoint == Checkpoint::when_due && Clock::now() - last_ < interval_) {
        return;
    }
    try {
        write(part);
    } catch (const Error& error) {
        if (error.code() != ErrorCode::output) {
            throw;
        }
        last_ = Clock::now();
        interval_ *= interval_after_failure;
        console_.warning(fmt::format("{}; the render continues, and retries in {:.0f} minutes",
                                     error.what(), interval_.count() / 60.0),
                         Repeat::always);
    }
}

void PartKeeper::finish(const RenderResult& part)
{
    if (written_ != part.samples) {
        write(part);
    }
}

void PartKeeper::write(const RenderResult& part)
{
    const Clock::time_point start = Clock::now();
    const io::PartWrite write = io::write_part(choice_.file, part, notes_, old_);
    last_ = Clock::now();
    const std::chrono::duration<double> taken = last_ - start;
    interval_ = std::max(min_write_interval, interval_of_writes * taken);
    if (write == io::PartWrite::kept) {
        console_.note({"part_kept", fmt::format("{}: has more samples by now and is kept",
                                                choice_.file.string())});
        return;
    }
    old_ = io::OldPart::keep_if_more;  // from now on the file is ours
    written_ = part.samples;
    console_.event("part", {{"file", choice_.file.string()}, {"samples", written_.text()}});
    console_.detail(fmt::format("wrote {}: samples {}", choice_.file.string(), written_.text()));
}

}  // namespace bdpt::job
