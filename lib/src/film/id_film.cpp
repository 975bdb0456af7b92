#include <bdpt/film/id_film.h>

#include <bdpt/error.h>
#include <bdpt/film/id_counts.h>
#include <bdpt/film/name_id.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <limits>
#include <unordered_map>
#include <utility>

namespace bdpt {
namespace {

/// Returns the change of the hash by four bytes of the text.
constexpr std::uint32_t scrambled(std::uint32_t block)
{
    return std::rotl(block * 0xcc9e2d51U, 15) * 0x1b873593U;
}

/// Returns at most four bytes from `begin` on, little-endian.
std::uint32_t block_at(std::string_view text, std::size_t begin)
{
    std::uint32_t block = 0;
    for (std::size_t i = 0; i < 4 && begin + i < text.size(); ++i) {
        block |= std::uint32_t{static_cast<unsigned char>(text[begin + i])} << (8 * i);
    }
    return block;
}

/// Returns MurmurHash3_x86_32 with seed 0.
std::uint32_t murmur_hash(std::string_view text)
{
    std::uint32_t hash = 0;
    const std::size_t whole = text.size() / 4 * 4;
    for (std::size_t i = 0; i < whole; i += 4) {
        hash = std::rotl(hash ^ scrambled(block_at(text, i)), 13) * 5 + 0xe6546b64U;
    }
    hash ^= scrambled(block_at(text, whole));  // 0 if no bytes are left
    hash ^= static_cast<std::uint32_t>(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bU;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35U;
    return hash ^ hash >> 16;
}

}  // namespace

NameId name_id(std::string_view name)
{
    const std::uint32_t hash = murmur_hash(name);
    const NameId id{hash};
    return is_name_id(id) ? id : NameId{hash ^ std::uint32_t{1} << 23};
}

std::string hex_text(NameId id)
{
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (int shift = 28; shift >= 0; shift -= 4) {
        text += digits[static_cast<std::uint32_t>(id) >> shift & 0xfU];
    }
    return text;
}

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

namespace {

[[noreturn]] void fail(const char* what)
{
    throw Error(ErrorCode::invalid_input, what);
}

/// Reads the ids of a pixel from planes, one after the other.
class PixelReader {
public:
    /// `known` is sorted.
    PixelReader(std::span<const NameId> known, std::int64_t samples)
        : known_(known), left_(static_cast<std::uint64_t>(samples))
    {}

    void add(const ExactSum::Words& words, IdCounts& counts)
    {
        if (words.low == 0 && words.high == 0) {
            ended_ = true;
            return;
        }
        if (ended_ || words.high <= last_) {
            fail("has ids of a pixel that are not in ascending order");
        }
        const NameId id{static_cast<std::uint32_t>(words.high)};
        if (words.high > std::numeric_limits<std::uint32_t>::max() ||
            !std::binary_search(known_.begin(), known_.end(), id)) {
            fail("has an id without a name");
        }
        if (words.low == 0 || words.low > left_) {
            fail("has an id without hits, or with more than samples");
        }
        last_ = words.high;
        left_ -= words.low;
        counts.add(id, static_cast<std::uint32_t>(words.low));
    }

private:
    std::span<const NameId> known_;
    std::uint64_t left_;
    std::uint64_t last_ = 0;
    bool ended_ = false;
};

}  // namespace

IdRanks IdFilm::ranks() const
{
    IdRanks result{};
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        for (const IdCounts& counts : pixels_[kind]) {
            result[kind] = std::max(result[kind], counts.size());
        }
    }
    return result;
}

void IdFilm::read_row(IdKind kind, std::size_t rank, int row,
                      std::span<ExactSum::Words> words) const
{
    const std::vector<IdCounts>& pixels = pixels_[static_cast<std::size_t>(kind)];
    for (std::size_t x = 0; x < words.size(); ++x) {
        const IdCounts& counts = pixels[row_begin(row) + x];
        words[x] = rank < counts.size()
                       ? ExactSum::Words{.low = counts[rank].count,
                                         .high = static_cast<std::uint32_t>(counts[rank].id)}
                       : ExactSum::Words{};
    }
}

void IdFilm::add_row(IdKind kind, int row, std::span<const ExactSum::Words> planes,
                     std::int64_t samples)
{
    const auto which = static_cast<std::size_t>(kind);
    const auto width = static_cast<std::size_t>(region_.width());
    for (std::size_t x = 0; x < width; ++x) {
        PixelReader reader(known_[which], samples);
        for (std::size_t i = x; i < planes.size(); i += width) {
            reader.add(planes[i], pixels_[which][row_begin(row) + x]);
        }
    }
}

namespace {

constexpr std::size_t channels = 4;  // channels of a layer: two levels
constexpr std::size_t layers_of_kind = IdFilm::levels / 2;

constexpr std::array<const char*, id_kinds.size()> layer_names{"CryptoObject", "CryptoMaterial",
                                                               "CryptoInstance"};

/// Alternating ids and fractions.
using Levels = std::array<float, 2 * IdFilm::levels>;

/// Returns the levels by descending fraction. `ranked` is reusable storage.
Levels find_levels(const IdCounts& counts, std::int64_t samples, std::vector<IdCount>& ranked)
{
    ranked.clear();
    for (std::size_t i = 0; i < counts.size(); ++i) {
        ranked.push_back(counts[i]);
    }
    std::sort(ranked.begin(), ranked.end(), [](const IdCount& a, const IdCount& b) {
        return a.count != b.count ? a.count > b.count : a.id < b.id;
    });
    Levels levels{};
    for (std::size_t i = 0; i < std::min(ranked.size(), IdFilm::levels); ++i) {
        levels[2 * i] = std::bit_cast<float>(ranked[i].id);
        levels[2 * i + 1] =
            static_cast<float>(static_cast<double>(ranked[i].count) / static_cast<double>(samples));
    }
    return levels;
}

void add_layers(std::vector<Layer>& layers, const PixelRect& region, const char* name,
                const std::vector<IdCounts>& pixels, std::int64_t samples)
{
    const std::size_t first = layers.size();
    for (std::size_t i = 0; i < layers_of_kind; ++i) {
        layers.push_back({.name = name + ("0" + std::to_string(i)),
                          .channels = "rgba",
                          .width = region.width(),
                          .height = region.height(),
                          .values = std::vector<float>(channels * pixels.size())});
    }
    std::vector<IdCount> ranked;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const Levels levels = find_levels(pixels[i], samples, ranked);
        for (std::size_t c = 0; c < levels.size(); ++c) {
            layers[first + c / channels].values[channels * i + c % channels] = levels[c];
        }
    }
}

}  // namespace

std::vector<Layer> IdFilm::develop(const Film& film) const
{
    if (needs_hits() && film.region() != region_) {
        throw Error(ErrorCode::usage, "the ids and the film are not of the same region");
    }
    std::vector<Layer> layers;
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        if (!pixels_[kind].empty()) {
            add_layers(layers, region_, layer_names[kind], pixels_[kind], film.sample_count());
        }
    }
    return layers;
}

std::vector<std::uint32_t> IdFilm::mask(IdKind kind, const Film& film) const
{
    if (needs_hits() && film.region() != region_) {
        throw Error(ErrorCode::usage, "the ids and the film are not of the same region");
    }
    const auto which = static_cast<std::size_t>(kind);
    std::unordered_map<NameId, std::uint32_t> integers;  // the first of names with the same id
    for (std::size_t i = 0; i < names_[which].size(); ++i) {
        integers.emplace(names_[which][i].id, static_cast<std::uint32_t>(i + 1));
    }
    std::vector<std::uint32_t> result;
    result.reserve(pixels_[which].size());
    for (const IdCounts& counts : pixels_[which]) {
        std::int64_t missed = film.sample_count();
        std::pair<std::int64_t, std::uint32_t> most{0, 0};  // rays, integer
        for (std::size_t i = 0; i < counts.size(); ++i) {
            const std::int64_t count = counts[i].count;
            const std::uint32_t integer = integers.at(counts[i].id);
            missed -= count;
            if (count > most.first || (count == most.first && integer < most.second)) {
                most = {count, integer};
            }
        }
        result.push_back(most.first > missed ? most.second : 0);
    }
    return result;
}

std::vector<IdManifest> IdFilm::manifests() const
{
    std::vector<IdManifest> result;
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        if (!pixels_[kind].empty()) {
            result.push_back({.layer = layer_names[kind], .names = names_[kind]});
        }
    }
    return result;
}

namespace {

constexpr std::array<NameId SurfaceIds::*, id_kinds.size()> members{
    &SurfaceIds::object, &SurfaceIds::material, &SurfaceIds::instance};

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
    for (std::size_t kind = 0; kind < id_kinds.size(); ++kind) {
        pixels_[kind].resize(aovs.contains(id_aovs[kind]) ? region.area() : 0);
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
    return region_.index(region_.x0, region_.y0 + row);
}

void IdFilm::add(int x, int y, std::span<SurfaceIds> met)
{
    if (met.empty()) {
        return;
    }
    const std::size_t i = region_.index(x, y);
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
