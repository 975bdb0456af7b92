#pragma once

/// @file
/// Counts the objects, materials and instances that camera rays meet, for Cryptomatte and masks.
///
/// @code{.cpp}
/// void write_cryptomatte(const bdpt::RenderResult& result)  // rendered with Aov::object
/// {
///     const std::vector<bdpt::Layer> layers = result.ids.develop(result.film);
///     bdpt::io::ExrOptions options;
///     options.manifests = result.ids.manifests();
///     bdpt::io::write_exr("ids.exr", result.image(), layers, options);
/// }
/// @endcode

#include <bdpt/aov.h>
#include <bdpt/export.h>
#include <bdpt/film/exact_sum.h>
#include <bdpt/film/film.h>
#include <bdpt/film/id_counts.h>
#include <bdpt/film/name_id.h>
#include <bdpt/image.h>
#include <bdpt/pixel_rect.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace bdpt {

/// The kinds of things that have ids.
enum class IdKind : std::uint8_t { object, material, instance };

/// All kinds; arrays with one element per kind use this order.
inline constexpr std::array id_kinds{IdKind::object, IdKind::material, IdKind::instance};

/// The AOV of each kind.
inline constexpr std::array id_aovs{Aov::object, Aov::material, Aov::instance};

/// For each kind, the names that rays may hit, sorted by their bytes, without duplicates.
using IdNames = std::array<std::vector<NamedId>, id_kinds.size()>;

/// For each kind, the largest number of ids in any pixel.
using IdRanks = std::array<std::size_t, id_kinds.size()>;

/// The names behind the ids of a group of layers.
struct IdManifest {
    std::string layer;  ///< "CryptoObject"; the layers append a number to it
    std::vector<NamedId> names;
};

/// Counts of the objects, materials and instances that camera rays hit first. The counts are exact,
/// independent of order, and unlimited in the number of ids per pixel.
class BDPT_EXPORT IdFilm {
public:
    IdFilm() = default;
    /// Counts the kinds that `aovs` request.
    IdFilm(const PixelRect& region, AovSet aovs, IdNames names);

    /// Number of ids per pixel that the layers store: those with the most hits.
    static constexpr std::size_t levels = 6;

    [[nodiscard]] const PixelRect& region() const { return region_; }
    [[nodiscard]] const IdNames& names() const { return names_; }
    /// Tests whether there is anything to count.
    [[nodiscard]] bool needs_hits() const;

    /// Adds rays of pixel (x, y) in the region: `met` holds the ids of those that hit a surface;
    /// its order changes. Safe from any thread, as long as one thread at a time adds to a pixel.
    void add(int x, int y, std::span<SurfaceIds> met);

    /// Adds the rays of other samples. Throws `Error` (usage) if regions or names differ.
    void merge(const IdFilm& other);

    /// Returns the Cryptomatte layers of the requested kinds [Cryptomatte specification 1.2.0]:
    /// CryptoObject00 to 02, CryptoMaterial00 to 02, CryptoInstance00 to 02, each with two ids
    /// (r, b) and the fractions of all samples that hit them (g, a). Ids are sorted by descending
    /// fraction, ties by ascending id. `film` must hold the same samples; throws `Error` (usage) if
    /// its region differs.
    [[nodiscard]] std::vector<Layer> develop(const Film& film) const;
    /// Returns the manifests of these layers. They include names that no ray has hit.
    [[nodiscard]] std::vector<IdManifest> manifests() const;

    /// Returns an integer for each pixel of the region, row by row: n if most of its rays hit the
    /// n-th name of that kind in `names()`, counted from 1, and 0 if most hit nothing; ties go to
    /// the smaller integer. Empty if the kind was not requested. `film` must hold the same samples;
    /// throws `Error` (usage) if its region differs.
    [[nodiscard]] std::vector<std::uint32_t> mask(IdKind kind, const Film& film) const;

    // Access for files: each rank of a kind is a plane that holds the rank-th id (high) of every
    // pixel, in the order of ids, and its count (low); zeros where the pixel has fewer ids.
    [[nodiscard]] IdRanks ranks() const;
    void read_row(IdKind kind, std::size_t rank, int row, std::span<ExactSum::Words> words) const;
    /// Adds a row. `planes` holds that row of one rank after the other; the counts of a pixel add
    /// up to at most `samples`. Throws `Error` (invalid_input) for values that no film can have.
    void add_row(IdKind kind, int row, std::span<const ExactSum::Words> planes,
                 std::int64_t samples);

    /// Tests for bit equality.
    [[nodiscard]] bool operator==(const IdFilm& other) const = default;

private:
    [[nodiscard]] std::size_t row_begin(int row) const;

    PixelRect region_;
    IdNames names_;
    std::array<std::vector<NameId>, id_kinds.size()> known_;     // sorted ids of the names
    std::array<std::vector<IdCounts>, id_kinds.size()> pixels_;  // empty if not requested
};

}  // namespace bdpt
