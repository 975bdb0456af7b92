#pragma once

/// @file
/// Keeps track of which samples of a render have been taken.
///
/// @code{.cpp}
/// bdpt::SampleSet samples(bdpt::SampleRange{0, 64});
/// samples.add(bdpt::SampleRange{128, 192});
/// const bdpt::SampleSet wanted(bdpt::SampleRange{0, 192});
/// std::cout << samples.text() << '\n';                  // 0:64,128:192
/// std::cout << samples.missing(wanted).text() << '\n';  // 64:128
/// @endcode

#include <bdpt/export.h>
#include <bdpt/render_options.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt {

/// Set of samples that every pixel has: ranges of sample indices, in order, that neither overlap
/// nor touch.
class BDPT_EXPORT SampleSet {
public:
    SampleSet() = default;
    /// Constructs the set of one range; an empty range gives an empty set.
    explicit SampleSet(SampleRange range);
    /// Parses the format of `text()`; returns nullopt if the text is malformed or exceeds [0, 2^32
    /// - 1].
    [[nodiscard]] static std::optional<SampleSet> parse(std::string_view text);

    /// Returns the ranges as text: "0:64,128:192"; an empty string for the empty set.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] const std::vector<SampleRange>& ranges() const { return ranges_; }
    [[nodiscard]] bool empty() const { return ranges_.empty(); }
    [[nodiscard]] std::int64_t count() const;
    /// Returns one past the last sample; 0 for the empty set.
    [[nodiscard]] std::int64_t end() const { return empty() ? 0 : ranges_.back().end; }

    /// Adds samples, some of which may already be in the set.
    void add(SampleRange range);
    void add(const SampleSet& other);
    /// Returns the samples that both sets contain.
    [[nodiscard]] SampleSet overlap(const SampleSet& other) const;
    /// Returns the samples of `wanted` that this set lacks.
    [[nodiscard]] SampleSet missing(const SampleSet& wanted) const;
    [[nodiscard]] bool contains(const SampleSet& other) const { return missing(other).empty(); }
    [[nodiscard]] bool operator==(const SampleSet&) const = default;

private:
    std::vector<SampleRange> ranges_;
};

}  // namespace bdpt
