#include <bdpt/part/sample_set.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <system_error>

namespace bdpt {
namespace {

/// Takes a number from the front of `text`.
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
        least = *end + 1;  // ranges that touch are one
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
    // Those that it overlaps or touches become one with it.
    const auto first = std::find_if(ranges_.begin(), ranges_.end(), [&](const SampleRange& other) {
        return other.end >= range.begin;
    });
    auto last = first;
    for (; last != ranges_.end() && last->begin <= range.end; ++last) {
        range.begin = std::min(range.begin, last->begin);
        range.end = std::max(range.end, last->end);
    }
    ranges_.insert(ranges_.erase(first, last), range);
}

void SampleSet::add(const SampleSet& other)
{
    for (const SampleRange& range : other.ranges_) {
        add(range);
    }
}

SampleSet SampleSet::overlap(const SampleSet& other) const
{
    SampleSet result;
    for (const SampleRange& a : ranges_) {
        for (const SampleRange& b : other.ranges_) {
            result.add({.begin = std::max(a.begin, b.begin), .end = std::min(a.end, b.end)});
        }
    }
    return result;
}

SampleSet SampleSet::missing(const SampleSet& wanted) const
{
    SampleSet result;
    for (const SampleRange& range : wanted.ranges_) {
        std::int64_t begin = range.begin;
        for (const SampleRange& own : ranges_) {
            result.add({.begin = begin, .end = std::min(own.begin, range.end)});
            begin = std::max(begin, own.end);
        }
        result.add({.begin = begin, .end = range.end});
    }
    return result;
}

}  // namespace bdpt
