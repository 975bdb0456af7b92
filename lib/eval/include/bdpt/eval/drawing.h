#pragma once

/// @file
/// Draws errors as colours, the images of all strategies on one sheet, and labels.
///
/// @code{.cpp}
/// void write_errors(const bdpt::Image& image, const bdpt::Image& reference)
/// {
///     const bdpt::eval::ErrorMap map = bdpt::eval::flip(image, reference);
///     const bdpt::eval::FalseColorOptions options = {.scale = 0.5, .title = "flip"};
///     bdpt::io::write_png("errors.png", bdpt::eval::false_color(map, options), {});
/// }
/// @endcode
///
/// @code{.cpp}
/// void write_sheet(const bdpt::RenderResult& result)  // rendered with a strategy_depth
/// {
///     const float exposure = bdpt::io::automatic_exposure(result.image());
///     const auto sheet = bdpt::eval::contact_sheet(result.strategies, exposure);
///     bdpt::io::write_png("strategies.png", sheet, {});
/// }
/// @endcode

#include <bdpt/eval/metric.h>
#include <bdpt/export.h>
#include <bdpt/film/strategy_film.h>
#include <bdpt/image.h>
#include <bdpt/io/display.h>

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::eval {

/// sRGB-encoded red, green, blue.
using Color8 = std::array<std::uint8_t, 3>;

/// Returns 256 colours from black through violet, red and orange to pale yellow. Neighbours are
/// equally far apart in CIE L*a*b*, and lightness increases monotonically, so the order is visible
/// without colour vision.
[[nodiscard]] BDPT_EXPORT std::vector<Color8> heat_colors();

/// Options of false-colour images.
struct FalseColorOptions {
    double scale = 1.0;  ///< error of the last colour, > 0; greater errors have that colour, too
    std::string title;   ///< text under the colour bar: lower-case letters, digits and "_+-. "
};

/// Draws the errors in `heat_colors` from 0 to `scale`, above a colour bar with its values. The
/// map's pixels are the top left corner, one to one. A map narrower than the bar is padded with
/// grey.
[[nodiscard]] BDPT_EXPORT io::DisplayImage false_color(const ErrorMap& map,
                                                       const FalseColorOptions& options);

// A font of 5 x 7 dots with the characters of labels: digits, small letters, and signs of numbers.
// It is compiled in, so labels look the same on every machine.

constexpr int glyph_height = 7;   ///< height of a line [dots]
constexpr int glyph_advance = 6;  ///< distance from one letter to the next [dots]

/// Tests whether there is a glyph for `letter`. Others are drawn as spaces.
[[nodiscard]] BDPT_EXPORT bool has_glyph(char letter);

/// Position and size of a text.
struct TextPlace {
    int x = 0;  ///< top left corner [pixels]
    int y = 0;
    int dot = 1;  ///< side of a dot [pixels]
};

/// Draws `text` on `image` in light grey, clipped to the image.
[[nodiscard]] BDPT_EXPORT io::DisplayImage with_text(io::DisplayImage image, std::string_view text,
                                                     const TextPlace& place);

/// Averages squares of `factor` x `factor` pixels; those at the right and lower border may be
/// smaller.
[[nodiscard]] BDPT_EXPORT Image shrunk(const Image& image, int factor);

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
