#include <bdpt/film/id_film.h>

#include <bdpt/error.h>

#include <algorithm>
#include <utility>

namespace bdpt {
namespace {

constexpr std::array<NameId SurfaceIds::*, id_kinds.size()> members{&SurfaceIds::object,
                                                                    &SurfaceIds::material};

/// Adds runs of equal ids.
void add_sorted(IdCounts& counts, std::span<const SurfaceIds> met, NameId SurfaceIds::*id)
{
    for (auto run = met.begin(); run != met.end();) {
        const NameId which = (*run).*id;
        const auto end = std::find_if(
            run, met.end(), [&](const SurfaceIds& surface) { return surface.*id != which; });
        counts.add(which, static_cast<std::uint32_t>(end - run));
        run = end;
    }
}

std::vector<NameId> sorted_ids(const std::vector<NamedId>& names)
{
    std::vector<NameId> ids;
    ids.reserve(names.size());
    for (const NamedId& name : names) {
        ids.push_back(name.id);
    }
    std::sort(ids.begin(), ids.end());
    return ids;
}

}  // namespace

IdFilm::IdFilm(const PixelRect& region, AovSet aovs, IdNames names)
    : region_(region), names_(std::move(names))
{
    const std::size_t pixels =
        static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height());
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        pixels_[kind].resize(aovs.contains(id_aovs[kind]) ? pixels : 0);
        known_[kind] = sorted_ids(names_[kind]);
    }
}

bool IdFilm::needs_hits() const
{
    return std::any_of(pixels_.begin(), pixels_.end(),
                       [](const auto& pixels) { return !pixels.empty(); });
}

std::size_t IdFilm::row_begin(int row) const
{
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(region_.width());
}

void IdFilm::add(int x, int y, std::span<SurfaceIds> met)
{
    if (met.empty()) {
        return;
    }
    const std::size_t i = row_begin(y - region_.y0) + static_cast<std::size_t>(x - region_.x0);
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        if (!pixels_[kind].empty()) {
            const auto id = members[kind];
            std::sort(met.begin(), met.end(),
                      [id](const SurfaceIds& a, const SurfaceIds& b) { return a.*id < b.*id; });
            add_sorted(pixels_[kind][i], met, id);
        }
    }
}

void IdFilm::merge(const IdFilm& other)
{
    if (region_ != other.region_ || names_ != other.names_) {
        throw Error(ErrorCode::usage, "ids to merge differ in their region or in their names");
    }
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        if (pixels_[kind].size() != other.pixels_[kind].size()) {
            throw Error(ErrorCode::usage, "ids to merge are of different kinds");
        }
        for (std::size_t i = 0; i < pixels_[kind].size(); ++i) {
            const IdCounts& counts = other.pixels_[kind][i];
            for (std::size_t rank = 0; rank < counts.size(); ++rank) {
                pixels_[kind][i].add(counts[rank].id, counts[rank].count);
            }
        }
    }
}

}  // namespace bdpt
