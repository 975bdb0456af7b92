#include <bdpt/error.h>
#include <bdpt/film/strategy_film.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace bdpt {
namespace {

constexpr std::size_t planes_of_strategy = 6;  // three channels, weighted and unweighted

void add_finite(std::array<ExactSum, 3>& sums, Rgb value) noexcept
{
    const auto sound = [](float x) { return x >= 0.0f && x <= std::numeric_limits<float>::max(); };
    if (!sound(value.r) || !sound(value.g) || !sound(value.b)) {
        return;
    }
    for (int c = 0; c < 3; ++c) {
        sums[static_cast<std::size_t>(c)].add(std::min(value[c], ExactSum::max_value));
    }
}

void add_sums(std::array<ExactSum, 3>& sums, const std::array<ExactSum, 3>& others) noexcept
{
    for (std::size_t c = 0; c < 3; ++c) {
        sums[c].add(others[c]);
    }
}

std::string two_digits(int number)
{
    std::string text(number < 10 ? 1 : 0, '0');
    return text += std::to_string(number);
}

Layer to_layer(const Image& image, std::string name)
{
    Layer layer{.name = std::move(name),
                .channels = "RGB",
                .width = image.width,
                .height = image.height,
                .values = {}};
    layer.values.reserve(3 * image.pixels.size());
    for (const Rgb& pixel : image.pixels) {
        layer.values.insert(layer.values.end(), {pixel.r, pixel.g, pixel.b});
    }
    return layer;
}

}  // namespace

std::string strategy_name(Strategy strategy)
{
    return "s" + two_digits(strategy.s) + "t" + two_digits(strategy.t);
}

StrategyFilm::StrategyFilm(const PixelRect& region, std::span<const Strategy> strategies)
    : region_(region), strategies_(strategies.begin(), strategies.end())
{
    for (const auto [s, t] : strategies_) {
        stride_ = std::max({stride_, s + 1, t + 1});
    }
    const std::size_t size = strategies_.size() * region_.area();
    pixels_.resize(size);
    begins_.assign(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(stride_), size);
    std::size_t begin = 0;
    for (const auto [s, t] : strategies_) {
        begins_[static_cast<std::size_t>(s * stride_ + t)] = begin;
        begin += region_.area();
    }
}

std::size_t StrategyFilm::find_begin(Strategy strategy) const noexcept
{
    const auto [s, t] = strategy;
    return s < stride_ && t < stride_ ? begins_[static_cast<std::size_t>(s * stride_ + t)]
                                      : pixels_.size();
}

void StrategyFilm::add(Strategy strategy, Vec2 raster, const StrategyShare& share) noexcept
{
    const std::size_t begin = find_begin(strategy);
    const bool inside =
        raster.x >= static_cast<float>(region_.x0) && raster.x < static_cast<float>(region_.x1) &&
        raster.y >= static_cast<float>(region_.y0) && raster.y < static_cast<float>(region_.y1);
    if (begin == pixels_.size() || !inside) {
        return;
    }
    Pixel& pixel =
        pixels_[begin + region_.index(static_cast<int>(raster.x), static_cast<int>(raster.y))];
    add_finite(pixel.weighted, share.weighted);
    add_finite(pixel.unweighted, share.unweighted);
}

void StrategyFilm::merge(const StrategyFilm& other)
{
    if (region_ != other.region_ || strategies_ != other.strategies_) {
        throw Error(ErrorCode::usage,
                    "images of strategies to merge differ in their region or in the strategies");
    }
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        add_sums(pixels_[i].weighted, other.pixels_[i].weighted);
        add_sums(pixels_[i].unweighted, other.pixels_[i].unweighted);
    }
    samples_ += other.samples_;
}

std::vector<std::string> StrategyFilm::plane_names() const
{
    std::vector<std::string> names;
    for (const Strategy& strategy : strategies_) {
        for (const char* kind : {"", ".unweighted"}) {
            for (const char* channel : {".R", ".G", ".B"}) {
                names.push_back(strategy_name(strategy) + kind + channel);
            }
        }
    }
    return names;
}

StrategyFilm::PlaneRow StrategyFilm::plane_row(std::size_t plane, int row) const
{
    const std::size_t image = plane / planes_of_strategy * region_.area();
    const std::size_t channel = plane % planes_of_strategy;
    return {.first_pixel = image + region_.index(region_.x0, region_.y0 + row),
            .sums = channel < 3 ? &Pixel::weighted : &Pixel::unweighted,
            .channel = channel % 3};
}

void StrategyFilm::read_row(std::size_t plane, int row, std::span<ExactSum::Words> words) const
{
    const PlaneRow place = plane_row(plane, row);
    for (std::size_t x = 0; x < words.size(); ++x) {
        words[x] = (pixels_[place.first_pixel + x].*place.sums)[place.channel].words();
    }
}

void StrategyFilm::add_row(std::size_t plane, int row, std::span<const ExactSum::Words> words)
{
    const PlaneRow place = plane_row(plane, row);
    for (std::size_t x = 0; x < words.size(); ++x) {
        (pixels_[place.first_pixel + x].*place.sums)[place.channel].add(words[x]);
    }
}

Image StrategyFilm::develop(Strategy strategy, Sum3 Pixel::*sums) const
{
    const std::size_t begin = find_begin(strategy);
    if (begin == pixels_.size()) {
        throw Error(ErrorCode::usage, "no images of strategy " + strategy_name(strategy));
    }
    Image image{region_.width(), region_.height(), std::vector<Rgb>(region_.area(), Rgb(0.0f))};
    for (std::size_t i = 0; samples_ > 0 && i < image.pixels.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            image.pixels[i][static_cast<int>(c)] = static_cast<float>(
                (pixels_[begin + i].*sums)[c].value() / static_cast<double>(samples_));
        }
    }
    return image;
}

Image StrategyFilm::unweighted(Strategy strategy) const
{
    return develop(strategy, &Pixel::unweighted);
}

Image StrategyFilm::weighted(Strategy strategy) const
{
    return develop(strategy, &Pixel::weighted);
}

std::vector<Layer> StrategyFilm::develop() const
{
    std::vector<Layer> layers;
    layers.reserve(2 * strategies_.size());
    for (const Strategy& strategy : strategies_) {
        const std::string name = strategy_name(strategy);
        layers.push_back(to_layer(weighted(strategy), name));
        layers.push_back(to_layer(unweighted(strategy), name + ".unweighted"));
    }
    return layers;
}

}  // namespace bdpt
