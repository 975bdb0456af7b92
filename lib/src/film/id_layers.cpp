#include <bdpt/film/id_film.h>

#include <bdpt/error.h>

#include <algorithm>
#include <bit>

namespace bdpt {
namespace {

constexpr std::size_t channels = 4;  // channels of a layer: two levels
constexpr std::size_t layers_of_kind = IdFilm::levels / 2;

constexpr std::array<const char*, id_kinds.size()> layer_names{"CryptoObject", "CryptoMaterial"};

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

}  // namespace bdpt
