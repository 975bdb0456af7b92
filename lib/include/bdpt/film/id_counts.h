#pragma once

/// @file
/// Counts the ids that the camera rays of a pixel meet.
///
/// @code{.cpp}
/// bdpt::IdCounts counts;
/// counts.add(bdpt::name_id("chair"), 48);
/// counts.add(bdpt::name_id("floor"), 16);
/// for (std::size_t i = 0; i < counts.size(); ++i) {
///     std::cout << bdpt::hex_text(counts[i].id) << ": " << counts[i].count << " rays\n";
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/film/name_id.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// Number of camera rays of a pixel that hit an id.
struct IdCount {
    NameId id = NameId::none;
    std::uint32_t count = 0;
    [[nodiscard]] bool operator==(const IdCount&) const = default;
};

/// The id counts of one pixel, unlimited in number, sorted by id whatever the order in which they
/// were added. Most pixels have one id, which needs no heap memory.
class BDPT_EXPORT IdCounts {
public:
    [[nodiscard]] std::size_t size() const { return first_.count > 0 ? 1 + more_.size() : 0; }
    [[nodiscard]] const IdCount& operator[](std::size_t i) const
    {
        return i == 0 ? first_ : more_[i - 1];
    }

    /// Adds `count` rays, 1 or more, that hit `id`.
    void add(NameId id, std::uint32_t count);

    [[nodiscard]] bool operator==(const IdCounts&) const = default;

private:
    IdCount first_;
    std::vector<IdCount> more_;
};

}  // namespace bdpt
