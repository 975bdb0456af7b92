#include <bdpt/eval/drawing.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace bdpt::eval {

Image shrunk(const Image& image, int factor)
{
    Image result{(image.width + factor - 1) / factor, (image.height + factor - 1) / factor, {}};
    for (int y0 = 0; y0 < image.height; y0 += factor) {
        for (int x0 = 0; x0 < image.width; x0 += factor) {
            const int x1 = std::min(x0 + factor, image.width);
            const int y1 = std::min(y0 + factor, image.height);
            Rgb sum(0.0f);
            for (int y = y0; y < y1; ++y) {
                for (int x = x0; x < x1; ++x) {
                    sum += image.at(x, y);
                }
            }
            result.pixels.push_back(sum / static_cast<float>((x1 - x0) * (y1 - y0)));
        }
    }
    return result;
}

namespace {

constexpr int longest_side = 160;  // maximum side of an image on the sheet [pixels]
constexpr int gap = 4;             // between cells [pixels]
constexpr std::uint8_t background = 40;

/// Dimensions of all cells.
struct CellShape {
    int shrink_factor;
    int dot;  // size of a dot of labels
    SheetSize cell;
    [[nodiscard]] int label_height() const { return (glyph_height + 4) * dot; }
};

std::string label(Strategy strategy)
{
    return "s" + std::to_string(strategy.s) + " t" + std::to_string(strategy.t);
}

CellShape compute_shape(const StrategyFilm& film)
{
    const int width = film.region().width();
    const int height = film.region().height();
    const int factor = (std::max(width, height) + longest_side - 1) / longest_side;
    const int shown_width = (width + factor - 1) / factor;
    const int shown_height = (height + factor - 1) / factor;
    std::size_t letters = 0;
    for (const Strategy& strategy : film.strategies()) {
        letters = std::max(letters, label(strategy).size());
    }
    const int label_width = glyph_advance * static_cast<int>(letters);
    CellShape shape{factor, shown_width >= 2 * label_width ? 2 : 1, {}};
    shape.cell = {.width = std::max(shown_width, label_width * shape.dot) + gap,
                  .height = shown_height + shape.label_height() + gap};
    return shape;
}

void paste(io::DisplayImage& sheet, const io::DisplayImage& image, SheetPlace place)
{
    for (int y = 0; y < image.height; ++y) {
        const auto from = image.rgb.begin() + std::ptrdiff_t{3} * image.width * y;
        std::copy_n(
            from, std::ptrdiff_t{3} * image.width,
            sheet.rgb.begin() + 3 * (std::ptrdiff_t{sheet.width} * (place.y + y) + place.x));
    }
}

}  // namespace

PyramidLayout::PyramidLayout(std::span<const Strategy> strategies, SheetSize cell)
    : cell_(cell),
      leftmost_(strategies.front().s - strategies.front().t),
      shortest_(strategies.front().s + strategies.front().t)
{
    int rightmost = leftmost_;
    int longest = shortest_;
    for (const auto [s, t] : strategies) {
        leftmost_ = std::min(leftmost_, s - t);
        rightmost = std::max(rightmost, s - t);
        shortest_ = std::min(shortest_, s + t);
        longest = std::max(longest, s + t);
    }
    size_ = {.width = (rightmost - leftmost_) * cell.width / 2 + cell.width,
             .height = (longest - shortest_ + 1) * cell.height};
}

SheetPlace PyramidLayout::place(Strategy strategy) const
{
    return {.x = (strategy.s - strategy.t - leftmost_) * cell_.width / 2,
            .y = (strategy.s + strategy.t - shortest_) * cell_.height};
}

float extra_exposure(Strategy strategy)
{
    return static_cast<float>(strategy.s + strategy.t - 2);
}

io::DisplayImage contact_sheet(const StrategyFilm& film, float exposure)
{
    const CellShape shape = compute_shape(film);
    const PyramidLayout layout(film.strategies(), shape.cell);
    constexpr std::string_view titles[]{"weighted, +1 stop a row", "unweighted, +1 stop a row"};
    const int title_width = glyph_advance * shape.dot * static_cast<int>(titles[1].size());
    const int title_height = shape.label_height() + gap;
    const int group_height = title_height + layout.size().height;
    io::DisplayImage sheet{
        std::max(layout.size().width, title_width) + gap, 2 * group_height + gap, {}};
    sheet.rgb.assign(std::size_t{3} * static_cast<std::size_t>(sheet.width) *
                         static_cast<std::size_t>(sheet.height),
                     background);
    for (int group = 0; group < 2; ++group) {
        const int top = gap + group * group_height;
        sheet = with_text(std::move(sheet), titles[group],
                          {.x = gap, .y = top + 2 * shape.dot, .dot = shape.dot});
        for (const Strategy& strategy : film.strategies()) {
            const SheetPlace place = layout.place(strategy);
            const int x = gap + place.x;
            const int y = top + title_height + place.y;
            sheet = with_text(std::move(sheet), label(strategy),
                              {.x = x, .y = y + 2 * shape.dot, .dot = shape.dot});
            const Image image = group == 0 ? film.weighted(strategy) : film.unweighted(strategy);
            paste(sheet,
                  io::tone_map(shrunk(image, shape.shrink_factor),
                               exposure + extra_exposure(strategy)),
                  {.x = x, .y = y + shape.label_height()});
        }
    }
    return sheet;
}

}  // namespace bdpt::eval
