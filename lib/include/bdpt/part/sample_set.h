#pragma once

#include <bdpt/export.h>
#include <bdpt/render_options.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt {

/// Which samples of every pixel there are: ranges of sample indices, in order, that neither overlap
/// nor touch.
class BDPT_EXPORT SampleSet {
public:
    SampleSet() = default;
    /// An empty range gives an empty set.
    explicit SampleSet(SampleRange range);
    /// The set with that `text()`; none if it is not one, or beyond [0, 2^32 - 1].
    [[nodiscard]] static std::optional<SampleSet> parse(std::string_view text);

    /// "0:64,128:192"; empty for the empty set.
    [[nodiscard]] std::string text() const;
    [[nodiscard]] const std::vector<SampleRange>& ranges() const { return ranges_; }
    [[nodiscard]] bool empty() const { return ranges_.empty(); }
    [[nodiscard]] std::int64_t count() const;
    /// One behind the last; 0 for the empty set.
    [[nodiscard]] std::int64_t end() const { return empty() ? 0 : ranges_.back().end; }

    /// Adds samples; some may be there already.
    void add(SampleRange range);
    void add(const SampleSet& other);
    /// Those that `other` has, too.
    [[nodiscard]] SampleSet overlap(const SampleSet& other) const;
    /// Those of `wanted` that are not here.
    [[nodiscard]] SampleSet missing(const SampleSet& wanted) const;
    [[nodiscard]] bool contains(const SampleSet& other) const { return missing(other).empty(); }
    [[nodiscard]] bool operator==(const SampleSet&) const = default;

private:
    std::vector<SampleRange> ranges_;
};

}  // namespace bdpt
