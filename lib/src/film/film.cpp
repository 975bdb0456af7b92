#include <bdpt/error.h>
#include <bdpt/film/film.h>
#include <bdpt/memory/huge_pages.h>

#include <glm/common.hpp>

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

namespace bdpt {
namespace {

std::size_t find_half(std::int64_t sample_index)
{
    return static_cast<std::size_t>(sample_index & 1);
}

/// Encodes a sample of a pixel such that earlier samples have lower numbers.
std::uint64_t place_code(const FilmLayout& layout, int x, int y, std::int64_t sample_index)
{
    const auto pixel = static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(layout.width) +
                       static_cast<std::uint64_t>(x);
    return static_cast<std::uint64_t>(sample_index) << 32U | pixel;
}

std::string text(const FilmLayout& layout)
{
    const PixelRect& r = layout.region;
    return "[" + std::to_string(r.x0) + ", " + std::to_string(r.x1) + ") x [" +
           std::to_string(r.y0) + ", " + std::to_string(r.y1) + ") of " +
           std::to_string(layout.width) + "x" + std::to_string(layout.height) +
           (layout.splats == SplatImage::absent ? " without splats" : " with splats");
}

}  // namespace

void Film::Pixel::add(Rgb value) noexcept
{
    rgb[0].add(value.r);
    rgb[1].add(value.g);
    rgb[2].add(value.b);
}

void Film::Pixel::add_alone(Rgb value) noexcept
{
    rgb[0].add_alone(value.r);
    rgb[1].add_alone(value.g);
    rgb[2].add_alone(value.b);
}

void Film::Pixel::add(const Pixel& other) noexcept
{
    for (std::size_t c = 0; c < rgb.size(); ++c) {
        rgb[c].add(other.rgb[c]);
    }
}

Film::Film(const FilmLayout& layout) : layout_(layout)
{
    const std::size_t pixels = region().area();
    const bool apart = layout.splats == SplatImage::apart;
    for (std::size_t half = 0; half < 2; ++half) {
        resize_in_huge_pages(samples_[half], pixels);
        resize_in_huge_pages(splats_[half], apart ? pixels : 0);
    }
    const bool clamps = layout.clamp != std::numeric_limits<float>::infinity();
    losses_.resize(clamps ? static_cast<std::size_t>(height()) : 0);
}

Film::Film(Film&& other) noexcept
{
    *this = std::move(other);
}

Film& Film::operator=(Film&& other) noexcept
{
    layout_ = std::exchange(other.layout_, {});
    counts_ = std::exchange(other.counts_, {});
    samples_ = std::exchange(other.samples_, {});
    splats_ = std::exchange(other.splats_, {});
    losses_ = std::exchange(other.losses_, {});
    invalid_ = other.invalid_.exchange(0);
    saturated_ = other.saturated_.exchange(0);
    first_invalid_ = other.first_invalid_.exchange(~std::uint64_t{0});
    return *this;
}

bool Film::accept(Rgb& value, int x, int y, std::int64_t sample_index, float scale) noexcept
{
    bool saturated = false;
    for (int c = 0; c < 3; ++c) {
        if (!(value[c] >= 0.0f && value[c] <= std::numeric_limits<float>::max())) {
            invalid_.fetch_add(1, std::memory_order_relaxed);
            const std::uint64_t place = place_code(layout_, x, y, sample_index);
            std::uint64_t first = first_invalid_.load(std::memory_order_relaxed);
            while (place < first && !first_invalid_.compare_exchange_weak(first, place)) {
            }
            return false;
        }
        if (value[c] > ExactSum::max_value) {
            value[c] = ExactSum::max_value;
            saturated = true;
        }
    }
    if (saturated) {
        saturated_.fetch_add(1, std::memory_order_relaxed);
    }
    // Scaled after clamping, or pixels with few samples would lose less than others.
    value = glm::min(scale * clamp(value, y, scale), Rgb(ExactSum::max_value));
    return true;
}

/// Returns `value`, scaled to the limit while preserving its hue.
Rgb Film::clamp(Rgb value, int y, float scale) noexcept
{
    const float greatest = std::max({value.r, value.g, value.b});
    if (!(greatest > layout_.clamp)) {
        return value;
    }
    const Rgb clamped = value * (layout_.clamp / greatest);
    RowLoss& loss = losses_[static_cast<std::size_t>(y - region().y0)];
    loss.light.add(glm::min(scale * (value - clamped), Rgb(ExactSum::max_value)));
    loss.contributions.add(1.0f);
    return clamped;
}

void Film::add_sample(int x, int y, std::int64_t sample_index, Rgb radiance, float scale) noexcept
{
    if (accept(radiance, x, y, sample_index, scale)) {
        Pixel& pixel = samples_[find_half(sample_index)][region().index(x, y)];
        if (layout_.splats == SplatImage::present) {
            pixel.add(radiance);  // other threads may splat into it
        } else {
            pixel.add_alone(radiance);
        }
    }
}

bool Film::takes_splat(Vec2 raster) const noexcept
{
    return layout_.splats != SplatImage::absent && raster.x >= static_cast<float>(region().x0) &&
           raster.x < static_cast<float>(region().x1) &&
           raster.y >= static_cast<float>(region().y0) &&
           raster.y < static_cast<float>(region().y1);
}

Film::Pixel& Film::splats_at(Vec2 raster, std::int64_t sample_index) noexcept
{
    auto& sums = layout_.splats == SplatImage::apart ? splats_ : samples_;
    return sums[find_half(sample_index)]
               [region().index(static_cast<int>(raster.x), static_cast<int>(raster.y))];
}

void Film::prefetch_splat(Vec2 raster, std::int64_t sample_index) noexcept
{
    if (!takes_splat(raster)) {
        return;
    }
    const Pixel& pixel = splats_at(raster, sample_index);
    constexpr int for_writing = 1;
    __builtin_prefetch(&pixel.rgb.front(), for_writing);
    __builtin_prefetch(&pixel.rgb.back(), for_writing);
}

void Film::add_splat(Vec2 raster, std::int64_t sample_index, Rgb radiance, float scale) noexcept
{
    if (!takes_splat(raster)) {
        return;
    }
    if (accept(radiance, static_cast<int>(raster.x), static_cast<int>(raster.y), sample_index,
               scale)) {
        splats_at(raster, sample_index).add(radiance);
    }
}

void Film::count_samples(std::int64_t begin, std::int64_t end)
{
    const std::int64_t even = (end + 1) / 2 - (begin + 1) / 2;
    counts_[0] += even;
    counts_[1] += end - begin - even;
}

void Film::merge(const Film& other)
{
    if (layout_ != other.layout_) {
        throw Error(ErrorCode::usage,
                    "films to merge differ: " + text(layout_) + " and " + text(other.layout_));
    }
    const auto add = [](std::vector<Pixel>& to, const std::vector<Pixel>& from) {
        for (std::size_t i = 0; i < to.size(); ++i) {
            to[i].add(from[i]);
        }
    };
    for (std::size_t half = 0; half < 2; ++half) {
        add(samples_[half], other.samples_[half]);
        add(splats_[half], other.splats_[half]);
        counts_[half] += other.counts_[half];
    }
    for (std::size_t row = 0; row < losses_.size(); ++row) {
        losses_[row].light.add(other.losses_[row].light);
        losses_[row].contributions.add(other.losses_[row].contributions);
    }
    invalid_ += other.invalid_;
    saturated_ += other.saturated_;
    first_invalid_ = std::min(first_invalid_.load(), other.first_invalid_.load());
}

ExactSum::Words Film::sum(std::size_t half, std::size_t pixel, std::size_t channel) const noexcept
{
    ExactSum::Words result = samples_[half][pixel].rgb[channel].words();
    if (!splats_[half].empty()) {
        result += splats_[half][pixel].rgb[channel].words();
    }
    return result;
}

Image Film::develop(std::span<const std::size_t> halves) const
{
    std::int64_t count = 0;
    for (const std::size_t half : halves) {
        count += counts_[half];
    }
    Image image{width(), height(), std::vector<Rgb>(samples_[0].size(), Rgb(0.0f))};
    if (count == 0) {
        return image;
    }
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            // Rounded once, so that it does not matter how the samples were split.
            ExactSum::Words total;
            for (const std::size_t half : halves) {
                total += sum(half, i, c);
            }
            image.pixels[i][static_cast<int>(c)] =
                static_cast<float>(total.value() / static_cast<double>(count));
        }
    }
    return image;
}

Image Film::develop() const
{
    return develop(std::array<std::size_t, 2>{0, 1});
}

Image Film::develop_half(int half) const
{
    return develop(std::array<std::size_t, 1>{static_cast<std::size_t>(half)});
}

Image Film::develop_camera() const
{
    Image image{width(), height(), std::vector<Rgb>(samples_[0].size(), Rgb(0.0f))};
    const auto count = static_cast<double>(sample_count());
    for (std::size_t i = 0; i < image.pixels.size() && count > 0.0; ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            ExactSum::Words total = samples_[0][i].rgb[c].words();
            total += samples_[1][i].rgb[c].words();
            image.pixels[i][static_cast<int>(c)] = static_cast<float>(total.value() / count);
        }
    }
    return image;
}

Image Film::variance() const
{
    if (counts_[0] == 0 || counts_[1] == 0) {
        const Rgb unknown(std::numeric_limits<float>::infinity());
        return {width(), height(), std::vector<Rgb>(samples_[0].size(), unknown)};
    }
    // With a variance v per sample the expected squared difference of the halves is v (1/n0 +
    // 1/n1), and the variance of the whole is v / (n0 + n1).
    const auto n0 = static_cast<double>(counts_[0]);
    const auto n1 = static_cast<double>(counts_[1]);
    const auto factor = static_cast<float>(n0 * n1 / ((n0 + n1) * (n0 + n1)));
    Image image = develop_half(0);
    const Image odd = develop_half(1);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const Rgb difference = image.pixels[i] - odd.pixels[i];
        image.pixels[i] = factor * difference * difference;
    }
    return image;
}

ClampLoss Film::clamp_loss() const
{
    const FilmTotals sum = totals();
    ClampLoss result{.contributions = static_cast<std::uint64_t>(sum.clamped_contributions.value()),
                     .radiance = Rgb(0.0f)};
    const double samples = static_cast<double>(sample_count()) * width() * height();
    for (int c = 0; c < 3 && samples > 0.0; ++c) {
        result.radiance[c] =
            static_cast<float>(sum.clamped[static_cast<std::size_t>(c)].value() / samples);
    }
    return result;
}

FilmDefects Film::defects() const
{
    FilmDefects defects{.invalid = invalid_, .saturated = saturated_, .first_invalid = {}};
    if (const std::uint64_t first = first_invalid_; first != ~std::uint64_t{0}) {
        const std::uint64_t pixel = first & 0xffffffffU;
        const auto width = static_cast<std::uint64_t>(layout_.width);
        defects.first_invalid =
            FilmDefects::Place{.x = static_cast<int>(pixel % width),
                               .y = static_cast<int>(pixel / width),
                               .sample_index = static_cast<std::int64_t>(first >> 32U)};
    }
    return defects;
}

std::vector<std::string> Film::plane_names()
{
    return {"half0.R", "half0.G", "half0.B", "half1.R", "half1.G", "half1.B"};
}

void Film::read_row(std::size_t plane, int row, std::span<ExactSum::Words> words) const
{
    const std::size_t first = region().index(region().x0, region().y0 + row);
    for (std::size_t x = 0; x < words.size(); ++x) {
        words[x] = sum(plane / 3, first + x, plane % 3);
    }
}

void Film::add_row(std::size_t plane, int row, std::span<const ExactSum::Words> words)
{
    const std::size_t first = region().index(region().x0, region().y0 + row);
    for (std::size_t x = 0; x < words.size(); ++x) {
        samples_[plane / 3][first + x].rgb[plane % 3].add(words[x]);
    }
}

FilmTotals Film::totals() const
{
    RowLoss sum;
    for (const RowLoss& loss : losses_) {
        sum.light.add(loss.light);
        sum.contributions.add(loss.contributions);
    }
    return {
        .defects = defects(),
        .clamped = {sum.light.rgb[0].words(), sum.light.rgb[1].words(), sum.light.rgb[2].words()},
        .clamped_contributions = sum.contributions.words()};
}

void Film::add_totals(const FilmTotals& totals)
{
    invalid_ += totals.defects.invalid;
    saturated_ += totals.defects.saturated;
    if (const auto& place = totals.defects.first_invalid) {
        first_invalid_ = std::min(first_invalid_.load(),
                                  place_code(layout_, place->x, place->y, place->sample_index));
    }
    if (losses_.empty()) {
        return;
    }
    for (std::size_t c = 0; c < 3; ++c) {
        losses_.front().light.rgb[c].add(totals.clamped[c]);
    }
    losses_.front().contributions.add(totals.clamped_contributions);
}

bool Film::operator==(const Film& other) const
{
    return layout_ == other.layout_ && counts_ == other.counts_ && samples_ == other.samples_ &&
           splats_ == other.splats_ && losses_ == other.losses_ && invalid_ == other.invalid_ &&
           saturated_ == other.saturated_ && first_invalid_ == other.first_invalid_;
}

}  // namespace bdpt
