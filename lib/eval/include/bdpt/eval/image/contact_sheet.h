#pragma once

/// @file
/// Shows the images of all strategies on one sheet.
///
/// @code{.cpp}
/// void write_sheet(const bdpt::RenderResult& result)  // rendered with a strategy_depth
/// {
///     const float exposure = bdpt::io::automatic_exposure(result.image());
///     const auto sheet = bdpt::eval::contact_sheet(result.strategies, exposure);
///     bdpt::io::write_png("strategies.png", sheet, {});
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/film/strategy_film.h>
#include <bdpt/io/tone_map.h>

#include <span>

namespace bdpt::eval {

/// Top left corner of an item on a sheet [pixels].
struct SheetPlace {
    int x = 0;
    int y = 0;
    [[nodiscard]] bool operator==(const SheetPlace&) const = default;
};

/// Size of a cell or a sheet [pixels].
struct SheetSize {
    int width = 0;
    int height = 0;
};

/// The pyramid in which strategies are shown [Veach 1997, fig. 10.3]: one row per path length, with
/// s growing from left to right and t from right to left. Rows are centred, so cells are offset by
/// half a cell from those of the row above.
class BDPT_EXPORT PyramidLayout {
public:
    /// Lays out the strategies, at least one, in equal cells.
    PyramidLayout(std::span<const Strategy> strategies, SheetSize cell);

    [[nodiscard]] SheetSize size() const { return size_; }
    /// Returns the top left corner of the strategy's cell.
    [[nodiscard]] SheetPlace place(Strategy strategy) const;

private:
    SheetSize cell_;
    int leftmost_;  // minimum of s - t
    int shortest_;  // minimum of s + t
    SheetSize size_;
};

/// Returns the exposure [EV] of a strategy's images relative to that of the whole image: one stop
/// for each edge after the first, so that the faint light of long paths is visible [Veach 1997,
/// fig. 10.3].
[[nodiscard]] BDPT_EXPORT float extra_exposure(Strategy strategy);

/// Draws the weighted images of all strategies, and below them the unweighted ones, each group as a
/// pyramid of labelled cells; large images are shrunk. Both groups have the exposure [EV] of the
/// image plus `extra_exposure`. `film` is not empty.
[[nodiscard]] BDPT_EXPORT io::DisplayImage contact_sheet(const StrategyFilm& film, float exposure);

}  // namespace bdpt::eval
