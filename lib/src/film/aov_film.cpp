#include <bdpt/error.h>
#include <bdpt/film/aov_film.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace bdpt {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

void add(std::array<ExactSum, 3>& sums, Vec3 value)
{
    for (int c = 0; c < 3; ++c) {
        sums[static_cast<std::size_t>(c)].add(value[c]);
    }
}

/// Clamps a value to the range of sums.
Vec3 limited(Vec3 value)
{
    for (int c = 0; c < 3; ++c) {
        value[c] = std::clamp(value[c], -ExactSum::max_value, ExactSum::max_value);
    }
    return value;
}

void merge_sums(std::vector<std::array<ExactSum, 3>>& to,
                const std::vector<std::array<ExactSum, 3>>& from)
{
    for (std::size_t i = 0; i < to.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            to[i][c].add(from[i][c]);
        }
    }
}

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
    const std::size_t pixels =
        static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height());
    const auto room = [&](Aov aov) { return aovs.contains(aov) ? pixels : 0; };
    albedo_.resize(room(Aov::albedo));
    normal_.resize(room(Aov::normal));
    position_.resize(room(Aov::position));
    depth_.resize(room(Aov::depth));
    hits_.resize(std::max({room(Aov::albedo), room(Aov::normal), room(Aov::position),
                           room(Aov::depth), room(Aov::alpha)}));
    counts_.resize(counts == PixelCounts::own ? room(Aov::sample_count) : 0);
    opacity_.resize(room(Aov::opacity));
    unshadowed_.resize(room(Aov::shadow));
    shadowed_.resize(room(Aov::shadow));
    ground_hits_.resize(room(Aov::shadow));
}

std::size_t AovFilm::index(int x, int y) const
{
    return static_cast<std::size_t>(y - region_.y0) * static_cast<std::size_t>(region_.width()) +
           static_cast<std::size_t>(x - region_.x0);
}

void AovFilm::add(int x, int y, const PrimaryHit& hit) noexcept
{
    const std::size_t i = index(x, y);
    if (!hits_.empty()) {
        ++hits_[i];
    }
    if (!albedo_.empty()) {
        bdpt::add(albedo_[i], hit.albedo);
    }
    if (!normal_.empty()) {
        bdpt::add(normal_[i], hit.normal);
    }
    if (!position_.empty()) {
        bdpt::add(position_[i], limited(hit.position));
    }
    if (!depth_.empty()) {
        depth_[i].add(std::min(hit.depth, ExactSum::max_value));
    }
}

void AovFilm::add_ground(int x, int y, const GroundLight& light) noexcept
{
    const std::size_t i = index(x, y);
    ++ground_hits_[i];
    unshadowed_[i].add(std::min(light.unshadowed, ExactSum::max_value));
    shadowed_[i].add(std::min(light.shadowed, ExactSum::max_value));
}

void AovFilm::add_opacity(int x, int y, float opacity) noexcept
{
    opacity_[index(x, y)].add(opacity);
}

void AovFilm::count_samples(int x, int y, std::int64_t count) noexcept
{
    counts_[index(x, y)] += static_cast<std::uint64_t>(count);
}

void AovFilm::merge(const AovFilm& other)
{
    if (region_ != other.region_ || aovs_ != other.aovs_ || pixel_counts_ != other.pixel_counts_) {
        throw Error(ErrorCode::usage, "AOVs to merge differ in their region or in what they hold");
    }
    merge_sums(albedo_, other.albedo_);
    merge_sums(normal_, other.normal_);
    merge_sums(position_, other.position_);
    merge_sums(depth_, other.depth_);
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
    const auto add_color = [&](const char* name, const char* channels,
                               std::vector<Sum3> AovFilm::*sums) {
        for (std::size_t c = 0; c < 3 && !(this->*sums).empty(); ++c) {
            result.push_back(
                {.name = std::string(name) + "." + channels[c], .color = sums, .channel = c});
        }
    };
    add_color("albedo", "RGB", &AovFilm::albedo_);
    add_color("normal", "XYZ", &AovFilm::normal_);
    add_color("position", "XYZ", &AovFilm::position_);
    if (!depth_.empty()) {
        result.push_back({.name = "depth.Z", .single = &AovFilm::depth_});
    }
    if (!hits_.empty()) {
        result.push_back({.name = "hits", .count = &AovFilm::hits_});
    }
    if (!counts_.empty()) {
        result.push_back({.name = "counts", .count = &AovFilm::counts_});
    }
    if (needs_opacity()) {
        result.push_back({.name = "opacity", .single = &AovFilm::opacity_});
    }
    if (needs_ground()) {
        result.push_back({.name = "ground.unshadowed", .single = &AovFilm::unshadowed_});
        result.push_back({.name = "ground.shadowed", .single = &AovFilm::shadowed_});
        result.push_back({.name = "ground.hits", .count = &AovFilm::ground_hits_});
    }
    return result;
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
    const std::size_t first =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(region_.width());
    for (std::size_t x = 0; x < words.size(); ++x) {
        words[x] = which.color ? (this->*which.color)[first + x][which.channel].words()
                   : which.single
                       ? (this->*which.single)[first + x].words()
                       : ExactSum::Words{.low = (this->*which.count)[first + x], .high = 0};
    }
}

void AovFilm::add_row(std::size_t plane, int row, std::span<const ExactSum::Words> words)
{
    const Plane which = planes()[plane];
    const std::size_t first =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(region_.width());
    for (std::size_t x = 0; x < words.size(); ++x) {
        if (which.color) {
            (this->*which.color)[first + x][which.channel].add(words[x]);
        } else if (which.single) {
            (this->*which.single)[first + x].add(words[x]);
        } else {
            (this->*which.count)[first + x] += words[x].low;
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
    return share * (1.0 - shadowed_[pixel].value() / unshadowed);
}

std::vector<Layer> AovFilm::develop(const Film& film) const
{
    if (film.region() != region_) {
        throw Error(ErrorCode::usage, "the AOVs and the film are not of the same region");
    }
    const auto samples = static_cast<double>(film.sample_count());
    std::vector<Layer> layers;
    const auto layer = [&](Aov aov, const char* name, const char* channels, const auto& pixel) {
        if (!aovs_.contains(aov)) {
            return;
        }
        Layer result{.name = name,
                     .channels = channels,
                     .width = region_.width(),
                     .height = region_.height(),
                     .values = {}};
        const std::size_t pixels =
            static_cast<std::size_t>(result.width) * static_cast<std::size_t>(result.height);
        result.values.reserve(pixels * result.channels.size());
        for (std::size_t i = 0; i < pixels; ++i) {
            for (std::size_t c = 0; c < result.channels.size(); ++c) {
                result.values.push_back(static_cast<float>(pixel(i, c)));
            }
        }
        layers.push_back(std::move(result));
    };
    const auto over_samples = [&](double sum) { return samples > 0.0 ? sum / samples : 0.0; };
    const auto over_hits = [&](double sum, std::size_t i, double without) {
        return hits_[i] > 0 ? sum / static_cast<double>(hits_[i]) : without;
    };
    using Index = std::size_t;
    const auto shadow = [&](Index i, Index) { return shadow_opacity(i, samples); };
    layer(Aov::alpha, "", "A", [&](Index i, Index) {
        return over_samples(static_cast<double>(hits_[i])) + (needs_ground() ? shadow(i, 0) : 0.0);
    });
    layer(Aov::shadow, "shadow", "A", shadow);
    layer(Aov::opacity, "opacity", "A",
          [&](Index i, Index) { return over_samples(opacity_[i].value()); });
    layer(Aov::albedo, "albedo", "RGB",
          [&](Index i, Index c) { return over_samples(albedo_[i][c].value()); });
    layer(Aov::normal, "normal", "XYZ",
          [&](Index i, Index c) { return over_samples(normal_[i][c].value()); });
    layer(Aov::depth, "depth", "Z",
          [&](Index i, Index) { return over_hits(depth_[i].value(), i, infinity); });
    layer(Aov::position, "position", "XYZ",
          [&](Index i, Index c) { return over_hits(position_[i][c].value(), i, 0.0); });
    layer(Aov::sample_count, "sampleCount", "Y", [&](Index i, Index) {
        return counts_.empty() ? samples : static_cast<double>(counts_[i]);
    });
    const Image variance = aovs_.contains(Aov::variance) ? film.variance() : Image{};
    layer(Aov::variance, "variance", "RGB",
          [&](Index i, Index c) { return variance.pixels[i][static_cast<int>(c)]; });
    return layers;
}

}  // namespace bdpt
