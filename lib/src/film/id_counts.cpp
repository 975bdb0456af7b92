#include <bdpt/film/id_counts.h>

#include <algorithm>
#include <utility>

namespace bdpt {

void IdCounts::add(NameId id, std::uint32_t count)
{
    if (first_.count == 0) {
        first_ = {.id = id, .count = count};
        return;
    }
    if (id == first_.id) {
        first_.count += count;
        return;
    }
    IdCount added{.id = id, .count = count};
    if (id < first_.id) {
        std::swap(added, first_);
    }
    const auto place =
        std::lower_bound(more_.begin(), more_.end(), added.id,
                         [](const IdCount& entry, NameId wanted) { return entry.id < wanted; });
    if (place != more_.end() && place->id == added.id) {
        place->count += added.count;
    } else {
        more_.insert(place, added);
    }
}

}  // namespace bdpt
