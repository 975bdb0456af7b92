#include <bdpt/part/sample_set.h>

#include <bdpt/error.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/render_options.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>

namespace bdpt {
namespace {

/// Returns the mean rate; in quarters nothing is rounded.
double compute_mean(const std::vector<std::int8_t>& exponents)
{
    std::int64_t quarters = 0;
    for (const std::int8_t exponent : exponents) {
        quarters += std::int64_t{1} << (exponent - SampleRates::min_exponent);
    }
    return static_cast<double>(quarters) /
           static_cast<double>(exponents.size() << -SampleRates::min_exponent);
}

}  // namespace

SampleRates::SampleRates(int width, int height, std::vector<std::int8_t> exponents)
    : width_(width), height_(height), exponents_(std::move(exponents))
{
    const auto pixels = static_cast<std::size_t>(std::max(width, 0)) *
                        static_cast<std::size_t>(std::max(height, 0));
    if (pixels == 0 || exponents_.size() != pixels) {
        throw Error(ErrorCode::usage,
                    std::to_string(exponents_.size()) + " rates of samples for an image of " +
                        std::to_string(width) + "x" + std::to_string(height) + " pixels");
    }
    for (const std::int8_t exponent : exponents_) {
        if (exponent < min_exponent || exponent > max_exponent) {
            throw Error(ErrorCode::usage, "a rate of samples is 2^" + std::to_string(exponent) +
                                              ", not from 1/4 to 4");
        }
    }
    mean_ = compute_mean(exponents_);
}

bool SampleRates::fit(const SampleRange& samples)
{
    return samples.begin % group == 0 && samples.end % group == 0 && samples.end <= max_rounds;
}

float SampleRates::least() const
{
    return to_rate(*std::min_element(exponents_.begin(), exponents_.end()));
}

float SampleRates::greatest() const
{
    return to_rate(*std::max_element(exponents_.begin(), exponents_.end()));
}

namespace {

/// Parses a number at the front of `text` and removes it.
std::optional<std::int64_t> take_number(std::string_view& text)
{
    std::uint32_t number = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc{}) {
        return std::nullopt;
    }
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    return number;
}

/// Returns the first of the sorted `ranges` that does not end before `sample`.
template <typename Ranges>
auto first_ending_from(Ranges& ranges, std::int64_t sample)
{
    return std::lower_bound(
        ranges.begin(), ranges.end(), sample,
        [](const SampleRange& range, std::int64_t value) { return range.end < value; });
}

}  // namespace

SampleSet::SampleSet(SampleRange range)
{
    add(range);
}

std::optional<SampleSet> SampleSet::parse(std::string_view text)
{
    SampleSet result;
    std::int64_t least = 0;
    while (!text.empty()) {
        const auto begin = take_number(text);
        if (!begin || *begin < least || !text.starts_with(':')) {
            return std::nullopt;
        }
        text.remove_prefix(1);
        const auto end = take_number(text);
        const bool more = text.size() > 1 && text.front() == ',';
        if (!end || *end <= *begin || !(text.empty() || more)) {
            return std::nullopt;
        }
        text.remove_prefix(more ? 1 : 0);
        result.ranges_.push_back({.begin = *begin, .end = *end});
        least = *end + 1;  // ranges that touch are merged
    }
    return result;
}

std::string SampleSet::text() const
{
    std::string text;
    for (const SampleRange& range : ranges_) {
        text += (text.empty() ? "" : ",") + std::to_string(range.begin) + ":" +
                std::to_string(range.end);
    }
    return text;
}

std::int64_t SampleSet::count() const
{
    std::int64_t count = 0;
    for (const SampleRange& range : ranges_) {
        count += range.end - range.begin;
    }
    return count;
}

void SampleSet::add(SampleRange range)
{
    if (range.begin >= range.end) {
        return;
    }
    // Ranges that it overlaps or touches are merged with it.
    const auto first = first_ending_from(ranges_, range.begin);
    auto last = first;
    for (; last != ranges_.end() && last->begin <= range.end; ++last) {
        range.begin = std::min(range.begin, last->begin);
        range.end = std::max(range.end, last->end);
    }
    if (first == last) {
        ranges_.insert(first, range);
    } else {
        *first = range;
        ranges_.erase(first + 1, last);
    }
}

void SampleSet::add(const SampleSet& other)
{
    if (other.ranges_.size() == 1) {
        return add(other.ranges_.front());
    }
    std::vector<SampleRange> both;
    both.reserve(ranges_.size() + other.ranges_.size());
    std::merge(ranges_.begin(), ranges_.end(), other.ranges_.begin(), other.ranges_.end(),
               std::back_inserter(both),
               [](const SampleRange& a, const SampleRange& b) { return a.begin < b.begin; });
    ranges_.clear();
    for (const SampleRange& range : both) {
        add(range);  // at the end
    }
}

SampleSet SampleSet::overlap(const SampleSet& other) const
{
    if (ranges_.size() < other.ranges_.size()) {
        return other.overlap(*this);
    }
    SampleSet result;
    for (const SampleRange& range : other.ranges_) {
        auto own = first_ending_from(ranges_, range.begin);
        for (; own != ranges_.end() && own->begin < range.end; ++own) {
            result.add(
                {.begin = std::max(own->begin, range.begin), .end = std::min(own->end, range.end)});
        }
    }
    return result;
}

SampleSet SampleSet::missing(const SampleSet& wanted) const
{
    SampleSet result;
    for (const SampleRange& range : wanted.ranges_) {
        std::int64_t begin = range.begin;
        auto own = first_ending_from(ranges_, range.begin);
        for (; own != ranges_.end() && own->begin < range.end; ++own) {
            result.add({.begin = begin, .end = own->begin});
            begin = std::max(begin, own->end);
        }
        result.add({.begin = begin, .end = range.end});
    }
    return result;
}

}  // namespace bdpt
