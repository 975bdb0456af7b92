#pragma once

/// @file
/// Shows the images of all strategies on one sheet.
///
/// @code{.cpp}
/// void write_sheet(const bdpt::RenderResult& result)  // rendered with a strategy_depth
/// {
///     const float exposure = bdpt::io::automatic_exposure(result.film.develop());
///     const auto sheet = bdpt::eval::contact_sheet(result.strategies, exposure);
///     bdpt::io::write_png("strategies.png", sheet, {});
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/film/strategy_film.h>
#include <bdpt/io/tone_map.h>

#include <span>

namespace bdpt::eval {

/// A corner of something on a sheet [pixels].
struct SheetPlace {
    int x = 0;
    int y = 0;
    [[nodiscard]] bool operator==(const SheetPlace&) const = default;
};

/// The size of a cell or a sheet [pixels].
struct SheetSize {
    int width = 0;
    int height = 0;
};

/// The pyramid in which strategies are shown [Veach 1997, fig. 10.3]: a row for each length of
/// paths, in it s grows from left to right and t from right to left. Rows are centred, so each cell
/// is half a cell beside those of the row above.
class BDPT_EXPORT PyramidLayout {
public:
    /// Room for these, at least one, with equal cells.
    PyramidLayout(std::span<const Strategy> strategies, SheetSize cell);

    [[nodiscard]] SheetSize size() const { return size_; }
    /// Top left corner of the strategy's cell.
    [[nodiscard]] SheetPlace place(Strategy strategy) const;

private:
    SheetSize cell_;
    int leftmost_;  // s - t
    int shortest_;  // s + t
    SheetSize size_;
};

/// Exposure [EV] of a strategy's images beyond that of the whole image: one stop for each edge
/// after the first, so that the faint light of long paths can be seen [Veach 1997, fig. 10.3].
[[nodiscard]] BDPT_EXPORT float extra_exposure(Strategy strategy);

/// The weighted images of all strategies, below them the unweighted ones, each group as a pyramid
/// of labelled cells; large images are shrunk. Both have the exposure [EV] of the image and
/// `extra_exposure`. `film` is not empty.
[[nodiscard]] BDPT_EXPORT io::DisplayImage contact_sheet(const StrategyFilm& film, float exposure);

}  // namespace bdpt::eval
