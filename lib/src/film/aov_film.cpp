#include <bdpt/error.h>
#include <bdpt/film/aov_film.h>

#include <algorithm>
#include <span>

namespace bdpt {
namespace {

static_assert(std::all_of(aov_layers.begin(), aov_layers.end(),
                          [](const AovLayer& layer) {
                              return static_cast<std::size_t>(layer.aov) < aov_layers.size();
                          }),
              "PrimaryHit has room for every AOV");

void merge_sums(std::vector<ExactSum>& to, const std::vector<ExactSum>& from)
{
    for (std::size_t i = 0; i < to.size(); ++i) {
        to[i].add(from[i]);
    }
}

void merge_counts(std::vector<std::uint64_t>& to, const std::vector<std::uint64_t>& from)
{
    for (std::size_t i = 0; i < to.size(); ++i) {
        to[i] += from[i];
    }
}

}  // namespace

AovFilm::AovFilm(const PixelRect& region, AovSet aovs, PixelCounts counts)
    : region_(region), aovs_(aovs), pixel_counts_(counts)
{
    const std::size_t pixels = region.area();
    const auto room = [&](Aov aov) { return aovs.contains(aov) ? pixels : 0; };
    for (std::size_t k = 0; k < aov_layers.size(); ++k) {
        if (aov_layers[k].mean != AovMean::none) {
            surface_[k].resize(room(aov_layers[k].aov) * aov_layers[k].channels.size());
        }
    }
    hits_.resize(asks_for_surfaces(aovs) ? pixels : room(Aov::alpha));
    counts_.resize(counts == PixelCounts::own ? room(Aov::sample_count) : 0);
    opacity_.resize(room(Aov::opacity));
    unshadowed_.resize(room(Aov::shadow));
    shadowed_.resize(room(Aov::shadow));
    ground_hits_.resize(room(Aov::shadow));
}

void AovFilm::add(int x, int y, const PrimaryHit& hit) noexcept
{
    const std::size_t i = region_.index(x, y);
    if (!hits_.empty()) {
        ++hits_[i];
    }
    for (std::size_t k = 0; k < aov_layers.size(); ++k) {
        if (!surface_[k].empty()) {
            const std::size_t channels = aov_layers[k].channels.size();
            const Vec3& value = hit[aov_layers[k].aov];
            for (std::size_t c = 0; c < channels; ++c) {
                surface_[k][i * channels + c].add_alone(std::clamp(
                    value[static_cast<int>(c)], -ExactSum::max_value, ExactSum::max_value));
            }
        }
    }
}

void AovFilm::add_ground(int x, int y, const GroundLight& light) noexcept
{
    const std::size_t i = region_.index(x, y);
    ++ground_hits_[i];
    ExactSum light_sum;
    light_sum.add_alone(std::min(light.unshadowed, ExactSum::max_value));
    unshadowed_[i].add(light_sum);
    if (light.shadowed == light.unshadowed) {  // as on most of the ground
        shadowed_[i].add(light_sum);
    } else {
        shadowed_[i].add_alone(
            std::clamp(light.shadowed, -ExactSum::max_value, ExactSum::max_value));
    }
}

void AovFilm::add_open_ground(int x, int y, float irradiance, std::int64_t rays) noexcept
{
    const std::size_t i = region_.index(x, y);
    ground_hits_[i] += static_cast<std::uint64_t>(rays);
    ExactSum light;
    for (std::int64_t ray = 0; ray < rays; ++ray) {
        light.add_alone(std::min(irradiance, ExactSum::max_value));
    }
    unshadowed_[i].add(light);
    shadowed_[i].add(light);
}

void AovFilm::add_opacity(int x, int y, float opacity) noexcept
{
    opacity_[region_.index(x, y)].add_alone(opacity);
}

void AovFilm::count_samples(int x, int y, std::int64_t count) noexcept
{
    counts_[region_.index(x, y)] += static_cast<std::uint64_t>(count);
}

void AovFilm::merge(const AovFilm& other)
{
    if (region_ != other.region_ || aovs_ != other.aovs_ || pixel_counts_ != other.pixel_counts_) {
        throw Error(ErrorCode::usage, "AOVs to merge differ in their region or in what they hold");
    }
    for (std::size_t k = 0; k < surface_.size(); ++k) {
        merge_sums(surface_[k], other.surface_[k]);
    }
    merge_counts(hits_, other.hits_);
    merge_counts(counts_, other.counts_);
    merge_sums(opacity_, other.opacity_);
    merge_sums(unshadowed_, other.unshadowed_);
    merge_sums(shadowed_, other.shadowed_);
    merge_counts(ground_hits_, other.ground_hits_);
}

std::vector<AovFilm::Plane> AovFilm::planes() const
{
    std::vector<Plane> result;
    for (std::size_t k = 0; k < aov_layers.size(); ++k) {
        const AovLayer& layer = aov_layers[k];
        for (std::size_t c = 0; c < layer.channels.size() && !surface_[k].empty(); ++c) {
            result.push_back({.name = std::string(layer.layer) + "." + layer.channels[c],
                              .layer = k,
                              .channel = c});
        }
    }
    if (!hits_.empty()) {
        result.push_back({.name = "hits", .counts = &AovFilm::hits_});
    }
    if (!counts_.empty()) {
        result.push_back({.name = "counts", .counts = &AovFilm::counts_});
    }
    if (needs_opacity()) {
        result.push_back({.name = "opacity", .sums = &AovFilm::opacity_});
    }
    if (needs_ground()) {
        result.push_back({.name = "ground.unshadowed", .sums = &AovFilm::unshadowed_});
        result.push_back({.name = "ground.shadowed", .sums = &AovFilm::shadowed_});
        result.push_back({.name = "ground.hits", .counts = &AovFilm::ground_hits_});
    }
    return result;
}

std::size_t AovFilm::element(const Plane& plane, std::size_t pixel)
{
    return pixel * aov_layers[plane.layer].channels.size() + plane.channel;
}

std::vector<std::string> AovFilm::plane_names() const
{
    std::vector<std::string> names;
    for (const Plane& plane : planes()) {
        names.push_back(plane.name);
    }
    return names;
}

void AovFilm::read_row(std::size_t plane, int row, std::span<ExactSum::Words> words) const
{
    const Plane which = planes()[plane];
    const std::size_t first = region_.index(region_.x0, region_.y0 + row);
    for (std::size_t x = 0; x < words.size(); ++x) {
        words[x] = which.counts
                       ? ExactSum::Words{.low = (this->*which.counts)[first + x], .high = 0}
                   : which.sums ? (this->*which.sums)[first + x].words()
                                : surface_[which.layer][element(which, first + x)].words();
    }
}

void AovFilm::add_row(std::size_t plane, int row, std::span<const ExactSum::Words> words)
{
    const Plane which = planes()[plane];
    const std::size_t first = region_.index(region_.x0, region_.y0 + row);
    for (std::size_t x = 0; x < words.size(); ++x) {
        if (which.counts) {
            (this->*which.counts)[first + x] += words[x].low;
        } else if (which.sums) {
            (this->*which.sums)[first + x].add(words[x]);
        } else {
            surface_[which.layer][element(which, first + x)].add(words[x]);
        }
    }
}

double AovFilm::shadow_opacity(std::size_t pixel, double samples) const
{
    const double unshadowed = unshadowed_[pixel].value();
    if (!(unshadowed > 0.0 && samples > 0.0)) {
        return 0.0;  // without light there is no shadow
    }
    const double share = static_cast<double>(ground_hits_[pixel]) / samples;
    return share * std::min(1.0 - shadowed_[pixel].value() / unshadowed, 1.0);
}

std::vector<float> AovFilm::coverage(const Film& film) const
{
    std::vector<float> result;
    if (aovs_.contains(Aov::alpha) && film.sample_count() > 0) {
        result.reserve(hits_.size());
        for (const std::uint64_t hits : hits_) {
            result.push_back(static_cast<float>(hits) / static_cast<float>(film.sample_count()));
        }
    }
    return result;
}

std::vector<Layer> AovFilm::develop(const Film& film) const
{
    if (film.region() != region_) {
        throw Error(ErrorCode::usage, "the AOVs and the film are not of the same region");
    }
    const auto samples = static_cast<double>(film.sample_count());
    const Image variance = aovs_.contains(Aov::variance) ? film.variance() : Image{};
    const auto over_samples = [&](double sum) { return samples > 0.0 ? sum / samples : 0.0; };
    const auto of_surface = [&](std::size_t k, std::size_t i, std::size_t c) {
        const AovLayer& info = aov_layers[k];
        const double sum = surface_[k][i * info.channels.size() + c].value();
        if (info.mean == AovMean::of_rays) {
            return over_samples(sum);
        }
        return hits_[i] > 0 ? sum / static_cast<double>(hits_[i])
                            : static_cast<double>(info.without_hits);
    };
    const auto value = [&](std::size_t k, std::size_t i, std::size_t c) {
        switch (aov_layers[k].aov) {
            case Aov::alpha:
                return over_samples(static_cast<double>(hits_[i])) +
                       (needs_ground() ? shadow_opacity(i, samples) : 0.0);
            case Aov::shadow:
                return shadow_opacity(i, samples);
            case Aov::opacity:
                return over_samples(opacity_[i].value());
            case Aov::sample_count:
                return counts_.empty() ? samples : static_cast<double>(counts_[i]);
            case Aov::variance:
                return static_cast<double>(variance.pixels[i][static_cast<int>(c)]);
            default:
                return of_surface(k, i, c);
        }
    };
    std::vector<Layer> layers;
    for (std::size_t k = 0; k < aov_layers.size(); ++k) {
        const AovLayer& info = aov_layers[k];
        if (!aovs_.contains(info.aov) || info.channels.empty()) {
            continue;
        }
        Layer layer{.name = std::string(info.layer),
                    .channels = std::string(info.channels),
                    .width = region_.width(),
                    .height = region_.height(),
                    .values = {}};
        layer.values.reserve(region_.area() * info.channels.size());
        for (std::size_t i = 0; i < region_.area(); ++i) {
            for (std::size_t c = 0; c < info.channels.size(); ++c) {
                layer.values.push_back(static_cast<float>(value(k, i, c)));
            }
        }
        layers.push_back(std::move(layer));
    }
    return layers;
}

}  // namespace bdpt
